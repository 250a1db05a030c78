//! What a time update leaves for the smoother.

use crate::filter::backward::Backward;
use crate::filter::error::{Fault, Matrix};
use crate::filter::lanes::split;
use crate::filter::memory::{put_columns, take, whole_packs};
use crate::kernels::{divide_lower, divide_lower_transposed, dot, downdate, tria};
use crate::scalar::Real;

/// Scalars of scratch of [`rotation`], for rows of D, E and noise of that length.
pub(super) const fn rotation_scratch(n: usize, stride: usize) -> usize {
    2 * n * wide(n, stride) + 2 * n
}

/// Length of the rows that the triangle of two blocks and its source need.
const fn wide(n: usize, stride: usize) -> usize {
    whole_packs(if stride > 2 * n { stride } else { 2 * n })
}

/// [S⁻ 0; Ω Γ] = Tria([D E S_Q; I 0 0]) (2011 Table 3 in the coordinates of the roots; `docs/algorithms.md` S2). The upper
/// left block, S⁻, goes to `next`: to the bit the one that a prediction without a way back finds.
#[inline(always)]
pub(super) fn rotation<T: Real>(
    dev: &[T],
    [columns, stride]: [usize; 2],
    minus: &[T],
    lost: usize,
    next: &mut [T],
    back: &mut Backward<T>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let n = next.len().isqrt();
    let wide = wide(n, stride);
    let block = take(&mut scratch, 2 * n * wide);
    let column = take(&mut scratch, 2 * n);
    block.fill(T::zero());
    put_columns(block, wide, 0, dev, stride);
    for i in 0..n {
        block[(n + i) * wide + i] = T::one();
    }
    let mut sick = split(tria(block, 2 * n, columns, wide), n, Matrix::Predicted, Matrix::Conditional)?;
    for k in 0..lost {
        column.fill(T::zero());
        for (v, row) in column.iter_mut().zip(minus.chunks_exact(lost)) {
            *v = row[k];
        }
        sick = sick | split(downdate(block, 2 * n, wide, column), n, Matrix::Predicted, Matrix::Conditional)?;
    }
    for i in 0..n {
        let row = &block[(n + i) * wide..(n + i + 1) * wide];
        next[i * n..(i + 1) * n].copy_from_slice(&block[i * wide..][..n]);
        back.gain[i * n..(i + 1) * n].copy_from_slice(&row[..n]);
        back.conditional[i * n..(i + 1) * n].copy_from_slice(&row[n..2 * n]);
    }
    Ok(sick)
}

/// G = S Dᵀ (P⁻)⁻¹ by the root `next` of P⁻ (2011 Table 2).
#[inline(always)]
pub(super) fn gain_of_covariance<T: Real>(
    dev: &[T],
    stride: usize,
    factor: &[T],
    next: &[T],
    back: &mut Backward<T>,
) {
    let n = factor.len().isqrt();
    for (to, s) in back.gain.chunks_exact_mut(n).zip(factor.chunks_exact(n)) {
        for (g, d) in to.iter_mut().zip(dev.chunks_exact(stride)) {
            *g = dot(s, d);
        }
    }
    divide_lower_transposed(back.gain, n, n, next, n);
    divide_lower(back.gain, n, n, next, n);
}
