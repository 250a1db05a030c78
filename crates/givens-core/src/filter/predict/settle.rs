//! The end of a step whose image and noise stand in one matrix [D E N]: P⁻ = D Dᵀ + E J Eᵀ + N Nᵀ.

use super::gain::{gain_of_covariance, rotation, rotation_scratch};
use crate::filter::backward::Backward;
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::{Belief, Form};
use crate::filter::lanes::{endless, lanes};
use crate::filter::memory::take;
use crate::kernels::{add_outer, cholesky_scaled, copy_lower, downdate, square, tria};
use crate::scalar::{Mask, Real};

/// What is known of the state after a step, before it is triangularised.
#[derive(Debug)]
pub(super) struct Moved<'a, T> {
    /// m⁻, length n.
    pub mean: &'a [T],
    /// [D E N], n rows of length `stride`.
    pub dev: &'a mut [T],
    /// Columns of `dev`, at least n.
    pub columns: usize,
    /// Length of a row of `dev`.
    pub stride: usize,
    /// The columns of E of negative weight, n rows of this many.
    pub minus: &'a [T],
    /// Their number.
    pub lost: usize,
}

/// Scalars of scratch of [`settle`].
pub(super) const fn settle_scratch(n: usize, stride: usize, smoothing: bool) -> usize {
    n + 2 * n * n + if smoothing { rotation_scratch(n, stride) } else { 0 }
}

/// Moves `belief`; with `back`, also what a smoother needs to come back. After a fault the belief is as before.
#[inline(always)]
pub(super) fn settle<T: Real, F: Form>(
    moved: Moved<T>,
    belief: &mut Belief<T>,
    back: Option<&mut Backward<T>>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let n = belief.mean.len();
    let Moved { mean, dev, columns, stride, minus, lost } = moved;
    let scale = take(&mut scratch, n);
    let mut sick = T::Mask::splat(false);
    if F::SQUARE_ROOT {
        if let Some(back) = back {
            let next = take(&mut scratch, n * n);
            sick = sick | rotation(dev, [columns, stride], minus, lost, next, back, scratch)?;
            sick = sick | endless(mean, next, n)?;
            belief.factor.copy_from_slice(next);
        } else {
            sick = sick | lanes(tria(dev, n, columns, stride), Matrix::Predicted)?;
            for column in 0..lost {
                for (v, row) in scale.iter_mut().zip(minus.chunks_exact(lost)) {
                    *v = row[column];
                }
                sick = sick | lanes(downdate(dev, n, stride, scale), Matrix::Predicted)?;
            }
            sick = sick | endless(mean, dev, stride)?;
            copy_lower(belief.factor, n, dev, stride);
        }
    } else {
        let cov = take(&mut scratch, n * n);
        let next = take(&mut scratch, n * n);
        square(cov, n, dev, stride, columns);
        for i in 0..n {
            scale[i] = cov[i * n + i];
        }
        add_outer(cov, n, n, minus, lost, minus, lost, lost, -1.0);
        next.copy_from_slice(cov);
        sick = sick | lanes(cholesky_scaled(next, n, scale), Matrix::Predicted)?;
        if let Some(back) = back {
            gain_of_covariance(dev, stride, belief.factor, next, back);
        }
        belief.cov.copy_from_slice(cov);
        belief.factor.copy_from_slice(next);
    }
    belief.mean.copy_from_slice(mean);
    Ok(sick)
}
