//! From the health of a kernel to a fault.

use super::error::{Fault, Matrix};
use crate::kernels::Health;
use crate::scalar::Real;

/// The sick lanes of a kernel, or the fault if all are.
#[inline(always)]
pub(crate) fn lanes<T: Real>(health: Health<T>, matrix: Matrix) -> Result<T::Mask, Fault> {
    match health.failed() {
        Some(pivot) => Err(Fault::NotPositive { matrix, pivot }),
        None => Ok(health.sick),
    }
}

/// NaN in the sick lanes, where nothing carries the mask on: they are told by what comes of it.
#[inline(always)]
pub(crate) fn spoil<T: Real>(sick: T::Mask, x: &mut T) {
    *x = T::select(sick, T::of(f64::NAN), *x);
}

/// The fault of a block of two: pivots from `first` on belong to the second matrix.
#[inline(always)]
pub(crate) fn split<T: Real>(
    health: Health<T>,
    first: usize,
    upper: Matrix,
    lower: Matrix,
) -> Result<T::Mask, Fault> {
    match health.failed() {
        Some(pivot) if pivot >= first => Err(Fault::NotPositive { matrix: lower, pivot: pivot - first }),
        _ => lanes(health, upper),
    }
}
