//! Powers and the length of a vector.

use super::Lanes;
use super::exponential::exp_of;
use super::format::Format;
use super::logarithm::ln_twice;
use super::two::Two;
use crate::scalar::Real;

/// e^(y ln |x|), the logarithm in twice the digits; its sign and the special cases are those of C's `pow`.
#[inline(always)]
pub(in crate::scalar) fn pow<T: Lanes>(x: T, y: T) -> T {
    let (zero, one, infinity) = (T::zero(), T::one(), T::of(f64::INFINITY));
    let size = x.unsigned();
    let ln = ln_twice(size);
    let ordinary = zero.lt(size) & size.lt(infinity);
    let end = T::select(size.same(zero), -infinity, size);
    let hi = T::select(ordinary, ln.hi, end);
    let exponent = y * hi;
    let exact = Two::product(y, hi);
    let rest = y.mul_add(ln.lo, exact.lo);
    let within = ordinary & !hi.same(zero) & exponent.unsigned().lt(T::of(T::Element::EXP_RANGE.1 * 2.0));
    let value = exp_of(exponent, T::select(within, rest, zero));

    let whole = y.floor().same(y);
    let half = y * T::of(0.5);
    let odd = whole & !half.floor().same(half);
    let value = T::select(odd, value.signed_as(x), value);
    let none = x.lt(zero) & ordinary & !whole;
    let value = T::select(none, T::of(f64::NAN), value);
    let unit = x.same(one) | y.same(zero) | (size.same(one) & y.unsigned().same(infinity));
    T::select(unit, one, value)
}

/// By repeated squaring, as for a scalar: equal to that bit by bit.
#[inline(always)]
pub(in crate::scalar) fn powi<T: Real>(x: T, e: i32) -> T {
    let (mut base, mut left, mut product) = (x, e.unsigned_abs(), T::one());
    while left > 0 {
        if left & 1 == 1 {
            product *= base;
        }
        base *= base;
        left >>= 1;
    }
    if e < 0 { product.recip() } else { product }
}

/// √(x² + y²), both moved by a power of two to where no square over- or underflows.
#[inline(always)]
pub(in crate::scalar) fn hypot<T: Lanes>(x: T, y: T) -> T {
    let (x, y) = (x.unsigned(), y.unsigned());
    let less = x.lt(y);
    let (large, small) = (T::select(less, y, x), T::select(less, x, y));
    let [(above, shrink), (below, grow)] = T::Element::HYPOT_SCALES;
    let (far, near) = (T::of(above).lt(large), large.lt(T::of(below)));
    let pick = |a: f64, b: f64| T::select(far, T::of(a), T::select(near, T::of(b), T::one()));
    let (scale, back) = (pick(shrink, grow), pick(1.0 / shrink, 1.0 / grow));
    let (a, b) = (large * scale, small * scale);
    let length = a.mul_add(a, b * b).sqrt() * back;
    // infinite even beside what is not a number
    let infinity = T::of(f64::INFINITY);
    T::select(x.same(infinity) | y.same(infinity), infinity, length)
}
