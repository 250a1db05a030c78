//! Elementary functions without branches, written once for the lanes of every pack.
//!
//! All of them reduce the argument to a short interval and evaluate a polynomial there; what one float cannot hold
//! is carried as the sum of two ([`two`]). Special values are put in by `select`. The one branch is over all lanes
//! at once: a sine of an argument beyond the reach of the fast reduction sends that lane to [`huge`]. The error function
//! alone is libm's ([`error`]). None errs by more than two units in the last place, but erfc by three (`tests/packs`),
//! with a fused multiply-add or without.

mod circular;
mod error;
mod exponential;
mod format;
mod huge;
mod inverse;
mod logarithm;
mod power;
mod two;

pub(super) use circular::{sin_cos, tan};
pub(super) use error::{erf, erfc};
pub(super) use exponential::{cosh, exp, sinh, tanh};
pub(super) use format::Format;
pub(super) use inverse::{acos, asin, atan, atan2};
pub(super) use logarithm::{ln, log10};
pub(super) use power::{hypot, pow, powi};

use super::pack::Pack;

/// What the functions need of a pack besides [`Real`](super::Real): its lanes as patterns of bits.
pub(super) trait Lanes: Pack<Element: Format> {
    /// Whether `mul_add` rounds once.
    const FUSED: bool;

    /// The same pattern in every lane; a lane of 32 bits takes the lower half.
    fn pattern(bits: u64) -> Self;
    /// Bitwise and.
    fn and(self, other: Self) -> Self;
    /// Bitwise or.
    fn or(self, other: Self) -> Self;
    /// Bitwise exclusive or.
    fn xor(self, other: Self) -> Self;
    /// Sum of the patterns as whole numbers, wrapping.
    fn plus(self, other: Self) -> Self;
    /// Patterns moved towards the sign bit.
    fn shifted_up(self, by: u32) -> Self;
    /// Patterns moved away from the sign bit, zeros behind.
    fn shifted_down(self, by: u32) -> Self;
    /// True in the lanes whose sign bit is set.
    fn negative(self) -> Self::Mask;

    /// The sign bit alone.
    #[inline(always)]
    fn sign_bit() -> Self {
        Self::pattern(1 << (Self::Element::BITS - 1))
    }
    /// −`self`, also of zeros and of what is not a number.
    #[inline(always)]
    fn turned(self) -> Self {
        self.xor(Self::sign_bit())
    }
    /// `self` without its sign.
    #[inline(always)]
    fn unsigned(self) -> Self {
        self.and(Self::pattern((1 << (Self::Element::BITS - 1)) - 1))
    }
    /// `self`, not negative, with the sign of `other`; a negative `self` stays so.
    #[inline(always)]
    fn signed_as(self, other: Self) -> Self {
        self.or(other.and(Self::sign_bit()))
    }
}

/// c₀ + c₁ x + c₂ x² + … A fold would not always be inlined.
#[inline(always)]
fn polynomial<T: Lanes>(coefficients: &[f64], x: T) -> T {
    let [rest @ .., last] = coefficients else { return T::zero() };
    let mut sum = T::of(*last);
    for &c in rest.iter().rev() {
        sum = sum.mul_add(x, T::of(c));
    }
    sum
}

/// The whole number next to x, and 1.5 · 2^mantissa more than it: there its lowest bits end the pattern.
#[inline(always)]
fn nearest<T: Lanes>(x: T, factor: f64) -> (T, T) {
    let magic = T::of(T::Element::MAGIC);
    let shifted = x.mul_add(T::of(factor), magic);
    (shifted - magic, shifted)
}

/// 2^k for a whole k of a normal number.
#[inline(always)]
fn power_of_two<T: Lanes>(k: T) -> T {
    (k + T::of(T::Element::MAGIC + T::Element::BIAS)).shifted_up(T::Element::MANTISSA)
}

/// x 2^k, in two steps so that the result may be subnormal or overflow.
#[inline(always)]
fn scaled<T: Lanes>(x: T, k: T) -> T {
    let (half, _) = nearest(k, 0.5);
    x * power_of_two(half) * power_of_two(k - half)
}
