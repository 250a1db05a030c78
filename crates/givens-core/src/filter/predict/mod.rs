//! Time updates: how a belief moves from one time to a later one.

mod gain;
mod transition;

pub use gain::{Backward, accumulate};
pub(crate) use gain::{accumulate_scratch, multiply, split};
pub(crate) use transition::{predict, predict_scratch};

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
