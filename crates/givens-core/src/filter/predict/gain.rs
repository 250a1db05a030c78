//! What a time update leaves for the smoother.

use super::lanes;
use crate::filter::error::{Fault, Matrix};
use crate::filter::memory::{put_columns, take};
use crate::kernels::{Health, copy_lower, divide_lower, divide_lower_transposed, downdate, tria};
use crate::scalar::Real;

/// What a time update leaves for the way back.
///
/// In square-root form it is told in the coordinates of the roots: x_k = m_k + S_k u and x_{k+1} = m⁻ + S⁻ a with u and a
/// standard normal, and u given a is N(Ω a, Γ Γᵀ). Both are parts of a rotation: nothing is divided, and nothing grows.
#[derive(Debug)]
pub struct Backward<'a, T> {
    /// Square-root form: Ω, n × n. Covariance form: G = Cov[x_k, x_{k+1}] (P⁻)⁻¹.
    pub gain: &'a mut [T],
    /// Square-root form: Γ, lower triangular n × n. Empty in covariance form.
    pub conditional: &'a mut [T],
}

/// Scalars of scratch of [`rotation`], for `stride` columns of D, E and noise.
pub(super) const fn rotation_scratch(n: usize, stride: usize) -> usize {
    2 * n * wide(n, stride) + 2 * n
}

/// Columns that the triangle of two blocks and its source need.
const fn wide(n: usize, stride: usize) -> usize {
    if stride > 2 * n { stride } else { 2 * n }
}

/// [S⁻ 0; Ω Γ] = Tria([D E S_Q; I 0 0]) (2011 Table 3 in the coordinates of the roots; `docs/algorithms.md` S2). The upper
/// left block, S⁻, goes to `next`: to the bit the one that a prediction without a way back finds.
#[inline(always)]
pub(super) fn rotation<T: Real>(
    dev: &[T],
    stride: usize,
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
    let mut sick = split(tria(block, 2 * n, stride, wide), n, Matrix::Predicted, Matrix::Conditional)?;
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
            *g = s.iter().zip(d).fold(T::zero(), |sum, (&x, &y)| x.mul_add(y, sum));
        }
    }
    divide_lower_transposed(back.gain, n, n, next, n);
    divide_lower(back.gain, n, n, next, n);
}

/// Scalars of scratch of [`accumulate`].
pub(crate) const fn accumulate_scratch(n: usize) -> usize {
    3 * n * n
}

/// Chains a later step onto an earlier one (docs/algorithms.md S3): Γ ← Tria([Γ  Ω Γ']), Ω ← Ω Ω'; or G ← G G'.
///
/// Both hold n × n matrices; the conditional roots are empty in covariance form. `scratch` holds 3 n² scalars.
#[inline(always)]
pub fn accumulate<T: Real>(
    n: usize,
    total: &mut Backward<T>,
    later: &Backward<T>,
    mut scratch: &mut [T],
) -> Health<T> {
    let product = take(&mut scratch, n * n);
    let wide = take(&mut scratch, 2 * n * n);
    let mut health = Health::good();
    if !later.conditional.is_empty() {
        multiply(product, n, total.gain, later.conditional);
        put_columns(wide, 2 * n, 0, total.conditional, n);
        put_columns(wide, 2 * n, n, product, n);
        health = tria(wide, n, 2 * n, 2 * n);
        copy_lower(total.conditional, n, wide, 2 * n);
    }
    multiply(product, n, total.gain, later.gain);
    total.gain.copy_from_slice(product);
    health
}

/// C = A B, all n × n.
#[inline(always)]
pub(crate) fn multiply<T: Real>(c: &mut [T], n: usize, a: &[T], b: &[T]) {
    for (to, row) in c.chunks_exact_mut(n).zip(a.chunks_exact(n)) {
        to.fill(T::zero());
        for (&x, from) in row.iter().zip(b.chunks_exact(n)) {
            for (sum, &y) in to.iter_mut().zip(from) {
                *sum = x.mul_add(y, *sum);
            }
        }
    }
}
