//! One triangularisation: [T11 0; T21 T22] = Tria([Z S_R; X 0]) (2010 eq 36; 2011 eq 27).

use super::{InnovationMut, Sensed};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::memory::{put_columns, take};
use crate::filter::predict::split;
use crate::kernels::{copy_lower, downdate, sweep, tria};
use crate::scalar::{Mask, Real};

/// Scalars of scratch of [`update`], for `rest` columns of E and noise.
pub(super) const fn joint_scratch(n: usize, d: usize, rest: usize) -> usize {
    let wide = if rest > d { rest } else { d };
    d * wide + (d + n) * (d + n) + (d + n) + n
}

/// W = T21/T11, m = m⁻ + W ν, S = T22. Since X = [S 0], only the rest of Z and S_R need a full triangularisation;
/// a sweep of rotations absorbs D.
#[inline(always)]
pub(super) fn update<T: Real>(
    sensed: &Sensed<T>,
    belief: &mut Belief<T>,
    innovation: &mut InnovationMut<T>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let (n, d, stride) = (belief.mean.len(), sensed.d, sensed.stride);
    let (rest, size) = (stride - n, d + n);
    let wide = rest.max(d);
    let noise = take(&mut scratch, d * wide);
    let block = take(&mut scratch, size * size);
    let column = take(&mut scratch, size);
    for (to, from) in noise.chunks_exact_mut(wide).zip(sensed.dev.chunks_exact(stride)) {
        to[..rest].copy_from_slice(&from[n..]);
    }
    let mut sick = tria(noise, d, rest, wide).sick;
    block.fill(T::zero());
    for i in 0..d {
        block[i * size..][..d].copy_from_slice(&noise[i * wide..][..d]);
        block[i * size + d..][..n].copy_from_slice(&sensed.dev[i * stride..][..n]);
    }
    put_columns(&mut block[d * size..], size, d, belief.factor, n);
    sick = sick | sweep(block, d, n, scratch).sick;
    for k in 0..sensed.lost {
        column.fill(T::zero());
        for (v, row) in column.iter_mut().zip(sensed.minus.chunks_exact(sensed.lost)).take(d) {
            *v = row[k];
        }
        sick = sick | split(downdate(block, size, size, column), d, Matrix::Innovation, Matrix::Posterior)?;
    }
    sick = sick | pivots(block, size, &innovation.predicted[..d])?;
    copy_lower(innovation.factor, d, block, size);
    innovation.whiten(block, size, d)?;
    for i in 0..n {
        let row = &block[(d + i) * size..(d + i + 1) * size];
        let shift = row.iter().zip(&innovation.white[..d]).fold(T::zero(), |sum, (&w, &e)| w.mul_add(e, sum));
        belief.mean[i] += shift;
        belief.factor[i * n..(i + 1) * n].copy_from_slice(&row[d..]);
    }
    Ok(sick)
}

/// The innovation covariance must have every pivot: it is divided by. One below the spacing of numbers at the predicted
/// measure is none.
#[inline(always)]
pub(super) fn pivots<T: Real>(root: &[T], stride: usize, predicted: &[T]) -> Result<T::Mask, Fault> {
    let mut sick = T::Mask::splat(false);
    for (i, z) in predicted.iter().enumerate() {
        let zero = !(T::of(T::EPSILON) * z.abs()).lt(root[i * stride + i]);
        if zero.all() {
            return Err(Fault::SingularInnovation { measure: i });
        }
        sick = sick | zero;
    }
    Ok(sick)
}
