//! From the health of a kernel to a fault.

use super::error::{Fault, Matrix};
use super::quantity::Quantity;
use crate::kernels::{Health, plus_dot};
use crate::scalar::{Mask, Real};

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

/// The lanes in which a mean, or a variance of the lower triangular root in rows of length `stride`, is not finite: squares
/// overflow where none of the numbers does. The fault at the first component that is so in every lane.
#[inline(always)]
pub(crate) fn endless<T: Real>(mean: &[T], root: &[T], stride: usize) -> Result<T::Mask, Fault> {
    let mut sum = T::zero();
    for i in 0..mean.len() {
        sum += size(mean, root, stride, i);
    }
    let mut sick = T::Mask::splat(false);
    if sum.finite().all() {
        return Ok(sick);
    }
    for component in 0..mean.len() {
        let lost = !size(mean, root, stride, component).finite();
        if lost.all() {
            return Err(Fault::NotFinite { quantity: Quantity::Estimate, component });
        }
        sick = sick | lost;
    }
    Ok(sick)
}

/// |mᵢ| and the variance of component i.
#[inline(always)]
fn size<T: Real>(mean: &[T], root: &[T], stride: usize, i: usize) -> T {
    let row = &root[i * stride..][..=i];
    plus_dot(mean[i].abs(), row, row)
}
