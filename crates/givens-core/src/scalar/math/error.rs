//! The error function and its complement, by libm one lane after the other: their many ranges would cost a pack more.

use super::Lanes;
use crate::scalar::Real;
use crate::scalar::pack::MAX_WIDTH;

/// f of every lane.
#[inline(always)]
fn each<T: Lanes>(x: T, f: impl Fn(T::Element) -> T::Element) -> T {
    let mut lanes = [T::Element::zero(); MAX_WIDTH];
    x.store(&mut lanes);
    let own = lanes.get_mut(..T::WIDTH).unwrap_or_default();
    for lane in own.iter_mut() {
        *lane = f(*lane);
    }
    T::load(own)
}

#[inline(always)]
pub(in crate::scalar) fn erf<T: Lanes>(x: T) -> T {
    each(x, Real::erf)
}

#[inline(always)]
pub(in crate::scalar) fn erfc<T: Lanes>(x: T) -> T {
    each(x, Real::erfc)
}
