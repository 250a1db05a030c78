//! Exponential and hyperbolic functions.

use super::format::Format;
use super::two::Two;
use super::{Lanes, nearest, polynomial, power_of_two, scaled};
use core::f64::consts::LOG2_E;

/// e^(x + rest) = 2^k (1 + r + p), |r| ≤ ln 2 / 2; x where the result is 0 or ∞ is moved to where it just is.
#[inline(always)]
fn parts<T: Lanes>(x: T, rest: T) -> (T, T, T) {
    let (least, most) = T::Element::EXP_RANGE;
    let x = T::select(x.lt(T::of(least)), T::of(least), x);
    let x = T::select(T::of(most).lt(x), T::of(most), x);
    let (k, _) = nearest(x, LOG2_E);
    let (ln_2, ln_2_rest) = T::Element::LN_2;
    let r = (-k).mul_add(T::of(ln_2), x) + ((-k).mul_add(T::of(ln_2_rest), rest));
    (k, r, (r * r) * polynomial(T::Element::EXP, r))
}

/// e^(x + rest).
#[inline(always)]
pub(super) fn exp_of<T: Lanes>(x: T, rest: T) -> T {
    let (k, r, p) = parts(x, rest);
    scaled(T::one() + (r + p), k)
}

#[inline(always)]
pub(in crate::scalar) fn exp<T: Lanes>(x: T) -> T {
    exp_of(x, T::zero())
}

/// With e^|x| = 2^k (1 + r + p): an eighth of 2^k and of 2^-k, r and p.
#[inline(always)]
fn eighths<T: Lanes>(x: T) -> (T, T, T, T) {
    let (k, r, p) = parts(x.unsigned(), T::zero());
    let eighth = T::of(0.125);
    // k up to 1025: one power of two alone would overflow
    (scaled(eighth, k), scaled(eighth, -k), r, p)
}

/// With p for r + p: a (1 + p) − b / (1 + p) without its cancellation, (a − b) + a p + b p / (1 + p).
#[inline(always)]
pub(in crate::scalar) fn sinh<T: Lanes>(x: T) -> T {
    let (a, b, r, p) = eighths(x);
    let large = Two::sum(a - b, a * r);
    let both = r + p;
    let value = large.hi + (large.lo + a.mul_add(p, b * (both / (T::one() + both))));
    let s = (value * T::of(4.0)).signed_as(x);
    T::select(x.unsigned().lt(T::of(T::Element::TINY)), x, s)
}

#[inline(always)]
pub(in crate::scalar) fn cosh<T: Lanes>(x: T) -> T {
    let (a, b, r, p) = eighths(x);
    let p = r + p;
    (a + a.mul_add(p, b / (T::one() + p))) * T::of(4.0)
}

/// (e^2x − 1) / (e^2x + 1).
#[inline(always)]
pub(in crate::scalar) fn tanh<T: Lanes>(x: T) -> T {
    let size = x.unsigned();
    // beyond, the result is 1
    let most = T::of(22.0);
    let size = T::select(most.lt(size), most, size);
    let (k, r, p) = parts(size + size, T::zero());
    let power = power_of_two(k);
    let top = Two::sum(power - T::one(), power * r);
    let top = Two::ordered_sum(top.hi, power.mul_add(p, top.lo));
    let bottom = Two::sum(T::of(2.0), top.hi);
    let bottom = Two { hi: bottom.hi, lo: bottom.lo + top.lo };
    let t = top.over(bottom).value().signed_as(x);
    T::select(x.unsigned().lt(T::of(T::Element::TINY)), x, t)
}
