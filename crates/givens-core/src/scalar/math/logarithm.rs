//! Logarithms.

use super::format::Format;
use super::two::Two;
use super::{Lanes, polynomial};

/// x = 2^k m with m in [√½, √2), for positive x; subnormal ones too.
#[inline(always)]
fn parts<T: Lanes>(x: T) -> (T, T) {
    let small = x.lt(T::of(T::Element::LEAST_NORMAL));
    let lifted = T::select(small, x * T::of(T::Element::LIFT.0), x);
    let lift = T::select(small, T::of(T::Element::LIFT.1), T::zero());
    // from √2 on, what is added carries into the exponent
    let pattern = |x: f64| T::Element::of_f64(x).pattern();
    let (one, root) = (pattern(1.0), pattern(core::f64::consts::FRAC_1_SQRT_2));
    let moved = lifted.plus(T::pattern(one - root));
    // the exponent as the lowest bits of 2^mantissa, which is a whole number of floats
    let whole = T::of(T::Element::MAGIC / 1.5);
    let exponent = moved.shifted_down(T::Element::MANTISSA).or(whole)
        - T::of(T::Element::MAGIC / 1.5 + T::Element::BIAS);
    let m = moved.and(T::pattern((1 << T::Element::MANTISSA) - 1)).plus(T::pattern(root));
    (exponent - lift, m)
}

/// Puts in ln 0 = −∞, ln ∞ = ∞, and NaN of what is negative or none.
#[inline(always)]
fn at_the_ends<T: Lanes>(x: T, value: T) -> T {
    let infinity = T::of(f64::INFINITY);
    let value = T::select(x.lt(infinity), value, x);
    let value = T::select(x.same(T::zero()), -infinity, value);
    T::select(x.lt(T::zero()), T::of(f64::NAN), value)
}

/// ln m = f − (f²/2 − s (f²/2 + R)) with f = m − 1, s = f / (2 + f) and R the rest of the series in s².
#[inline(always)]
pub(in crate::scalar) fn ln<T: Lanes>(x: T) -> T {
    let (k, m) = parts(x);
    let f = m - T::one();
    let s = f / (f + T::of(2.0));
    let z = s * s;
    let h = f * f * T::of(0.5);
    let rest = z * polynomial(T::Element::LOG, z);
    let (ln_2, ln_2_rest) = T::Element::LN_2;
    let correction = s.mul_add(h + rest, k * T::of(ln_2_rest));
    let value = k.mul_add(T::of(ln_2), f - (h - correction));
    at_the_ends(x, value)
}

/// ln x of a positive finite x, in twice the digits.
#[inline(always)]
pub(super) fn ln_twice<T: Lanes>(x: T) -> Two<T> {
    let (k, m) = parts(x);
    let numerator = Two { hi: m - T::one(), lo: T::zero() };
    let s = numerator.over(Two::sum(m, T::one()));
    let z = s.times(s);
    // 2 s + s z (2/3 + z (2/5 + …)): only the last bracket in single precision
    let inner = Two::constant(T::Element::TWO_THIRDS);
    let outer = Two::ordered_sum(inner.hi, z.hi * polynomial(T::Element::LOG_FIFTH, z.hi));
    let series = z.times(Two { hi: outer.hi, lo: outer.lo + inner.lo }).times(s);
    let (twice, twice_rest) = (s.hi + s.hi, s.lo + s.lo);
    let of_m = Two::ordered_sum(twice, series.hi);
    let of_m = Two { hi: of_m.hi, lo: of_m.lo + (series.lo + twice_rest) };
    let (ln_2, ln_2_rest) = T::Element::LN_2;
    let whole = Two::sum(k * T::of(ln_2), of_m.hi);
    Two::ordered_sum(whole.hi, whole.lo + k.mul_add(T::of(ln_2_rest), of_m.lo))
}

#[inline(always)]
pub(in crate::scalar) fn log10<T: Lanes>(x: T) -> T {
    at_the_ends(x, ln_twice(x).times(Two::constant(T::Element::LOG10_E)).value())
}
