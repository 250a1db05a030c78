//! One triangularisation: [T11 0; T21 T22] = Tria([Z S_R; X 0]) (2010 eq 36; 2011 eq 27).

use super::posterior::{Posterior, Rows};
use super::{InnovationMut, Sensed};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::memory::{larger, put_columns, put_identity, take};
use crate::filter::predict::split;
use crate::kernels::{copy_lower, dot, downdate, product_lower, sweep, tria};
use crate::scalar::{Mask, Real};

/// Scalars of scratch of [`update`], for `rest` columns of E and noise.
pub(super) const fn joint_scratch(n: usize, d: usize, rest: usize, smoothing: bool) -> usize {
    let wide = larger(rest, d);
    let rows = if smoothing { d + 2 * n } else { d + n };
    d * wide + rows * (d + n) + (d + n) + n * n + 3 * n
}

/// W = T21/T11, m = m⁻ + W ν, S = T22. Since X = [S 0], only the rest of Z and S_R need a full triangularisation;
/// a sweep of rotations absorbs D. What a smoother needs, [A B], are the same rotations of I; with negative columns
/// they are taken first and T21 = S A, T22 = S B, so that a downdate meets no pivot that is zero for want of variance.
#[inline(always)]
pub(super) fn update<'a, T: Real>(
    sensed: &Sensed<T>,
    belief: &Belief<T>,
    innovation: &mut InnovationMut<T>,
    learning: bool,
    mut scratch: &'a mut [T],
) -> Result<(Posterior<'a, T>, T::Mask), Fault> {
    let (n, d, stride) = (belief.mean.len(), sensed.d, sensed.stride);
    let (rest, size) = (stride - n, d + n);
    let wide = rest.max(d);
    let downdated = sensed.lost > 0;
    let stacked = if learning && !downdated { 2 } else { 1 };
    let noise = take(&mut scratch, d * wide);
    let block = take(&mut scratch, (d + stacked * n) * size);
    let column = take(&mut scratch, size);
    let factor = take(&mut scratch, if downdated { n * n } else { 0 });
    let mean = take(&mut scratch, n);
    let moved = take(&mut scratch, n);
    for (to, from) in noise.chunks_exact_mut(wide).zip(sensed.dev.chunks_exact(stride)) {
        to[..rest].copy_from_slice(&from[n..]);
    }
    let mut sick = tria(noise, d, rest, wide).sick;
    block.fill(T::zero());
    for i in 0..d {
        block[i * size..][..d].copy_from_slice(&noise[i * wide..][..d]);
        block[i * size + d..][..n].copy_from_slice(&sensed.dev[i * stride..][..n]);
    }
    if !downdated {
        put_columns(&mut block[d * size..], size, d, belief.factor, n);
    }
    if downdated || learning {
        let last = block.len() - n * size;
        put_identity(&mut block[last..], size, d, n);
    }
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

    let block = &*block;
    let top = Rows { of: &block[d * size..], stride: size };
    let turn = Rows { of: &block[block.len() - n * size..], stride: size };
    let (a, b) =
        (|rows: Rows<T>, i| dot(rows.row(i, d), innovation.white), Rows { of: &turn.of[d..], ..turn });
    if downdated || learning {
        moved.iter_mut().enumerate().for_each(|(i, x)| *x = a(turn, i));
    }
    let posterior = if downdated {
        belief.advanced(moved, mean);
        factor.copy_from_slice(belief.factor);
        product_lower(factor, n, n, b.of, size);
        Rows { of: factor, stride: n }
    } else {
        for (i, (to, &m)) in mean.iter_mut().zip(&*belief.mean).enumerate() {
            *to = m + a(top, i);
        }
        Rows { of: &top.of[d..], stride: size }
    };
    let learnt = if learning { Some((&*moved, b)) } else { None };
    Ok((Posterior { mean, factor: posterior, cov: &[], learnt }, sick))
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
