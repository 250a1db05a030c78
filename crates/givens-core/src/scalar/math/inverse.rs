//! Inverse circular functions.

use super::format::Format;
use super::two::Two;
use super::{Lanes, polynomial};

/// atan(y / x) by the ratio of the smaller to the larger, or from 0.55 on that of their difference and sum, so that
/// one division leads into [−0.3, 0.55]. (From there on the result is above a half, and the difference is exact.)
#[inline(always)]
pub(in crate::scalar) fn atan2<T: Lanes>(y: T, x: T) -> T {
    let (across, along) = (y.unsigned(), x.unsigned());
    let steep = along.lt(across);
    let (large, small) = (T::select(steep, across, along), T::select(steep, along, across));
    // the sum must not overflow
    let scale = T::select(T::of(T::Element::HUGE).lt(large), T::of(0.25), T::one());
    let (large, small) = (large * scale, small * scale);
    let between = large.le(small * T::of(1.0 / 0.55)) & T::zero().lt(large);
    let top = T::select(between, small - large, small);
    let bottom = T::select(between, small + large, large);
    // equal: also 0/0 and ∞/∞
    let u = T::select(small.same(large), T::zero(), top / bottom);
    let z = u * u;
    let a = (u * z).mul_add(polynomial(T::Element::ATAN, z), u);
    let a = T::select(steep, a.turned(), a);
    let (pi, pi_rest) = T::Element::PI;
    let (zero, quarter, half) = (T::zero(), T::of(pi * 0.25), T::of(pi * 0.5));
    let (quarter_rest, half_rest) = (T::of(pi_rest * 0.25), T::of(pi_rest * 0.5));
    let base = T::select(between, quarter, T::select(steep, half, zero));
    let base_rest = T::select(between, quarter_rest, T::select(steep, half_rest, zero));
    let first = base + (a + base_rest);
    let behind = T::of(pi) - (first - T::of(pi_rest));
    T::select(x.negative(), behind, first).signed_as(y)
}

#[inline(always)]
pub(in crate::scalar) fn atan<T: Lanes>(x: T) -> T {
    atan2(x, T::one())
}

/// asin(s) = s + rest of s = |x|, or of s = √((1 − |x|)/2) where |x| > 1/2.
#[inline(always)]
fn arc<T: Lanes>(x: T) -> (T::Mask, T, T) {
    let size = x.unsigned();
    let half = T::of(0.5);
    let outer = half.lt(size);
    let z = T::select(outer, (T::one() - size) * half, size * size);
    let s = T::select(outer, z.sqrt(), size);
    let square = Two::product(s, s);
    let short = ((z - square.hi) - square.lo) * half / s;
    let short = T::select(outer & T::zero().lt(s), short, T::zero());
    (outer, s, (s * z).mul_add(polynomial(T::Element::ASIN, z), short))
}

#[inline(always)]
pub(in crate::scalar) fn asin<T: Lanes>(x: T) -> T {
    let (outer, s, rest) = arc(x);
    let (pi, pi_rest) = T::Element::PI;
    let from_top = Two::ordered_sum(T::of(pi * 0.5), -(s + s));
    let from_top = from_top.hi + ((from_top.lo - (rest + rest)) + T::of(pi_rest * 0.5));
    T::select(outer, from_top, s + rest).signed_as(x)
}

#[inline(always)]
pub(in crate::scalar) fn acos<T: Lanes>(x: T) -> T {
    let (outer, s, rest) = arc(x);
    let (pi, pi_rest) = T::Element::PI;
    let signed = |v: T| v.xor(x.and(T::sign_bit()));
    let inner = T::of(pi * 0.5) - (signed(s) + (signed(rest) - T::of(pi_rest * 0.5)));
    let twice = (s + s) + (rest + rest);
    let behind = T::of(pi) - (twice - T::of(pi_rest));
    T::select(outer, T::select(x.negative(), behind, twice), inner)
}
