//! What a time update leaves for the smoother: its gain, and the covariance of a state given the next one.

use super::lanes;
use crate::filter::error::{Fault, Matrix};
use crate::filter::memory::{put_columns, take};
use crate::kernels::{Health, copy_lower, divide_lower, divide_lower_transposed, downdate, sweep, tria};
use crate::scalar::Real;

/// What is recorded of a time update for the way back.
#[derive(Debug)]
pub struct Backward<'a, T> {
    /// G = Cov[x_k, x_{k+1}] (P⁻)⁻¹, n × n.
    pub gain: &'a mut [T],
    /// Square-root form: a root D of P_k − G P⁻ Gᵀ, the covariance of x_k given x_{k+1}, n × n.
    /// Empty in covariance form.
    pub conditional: &'a mut [T],
}

/// Scalars of scratch of [`gain_of_factor`], for `rest` columns of E and noise.
pub(super) const fn gain_scratch(n: usize, rest: usize) -> usize {
    let wide = if rest > n { rest } else { n };
    n * wide + 4 * n * n + 4 * n
}

/// [U11 0; U21 U22] = Tria([D E S_Q; S 0 0]), G = U21/U11, conditional root U22 (2011 Table 3; `docs/algorithms.md` S2).
///
/// `size(i)` is the magnitude of the numbers whose differences make row i of `dev`: their rounding bounds what may be
/// divided by.
#[inline(always)]
pub(super) fn gain_of_factor<T: Real>(
    dev: &[T],
    stride: usize,
    minus: &[T],
    factor: &[T],
    size: impl Fn(usize) -> T,
    back: &mut Backward<T>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let n = back_len(factor);
    let rest = stride - n;
    let wide = rest.max(n);
    let noise = take(&mut scratch, n * wide);
    let block = take(&mut scratch, 4 * n * n);
    let column = take(&mut scratch, 2 * n);
    let rounding = take(&mut scratch, n);
    for (i, (error, row)) in rounding.iter_mut().zip(dev.chunks_exact(stride)).enumerate() {
        let norm = row.iter().fold(T::zero(), |sum, &x| x.mul_add(x, sum)).sqrt();
        *error = T::of(8.0 * T::EPSILON) * T::of(n as f64).mul_add(norm, size(i));
    }
    for (to, from) in noise.chunks_exact_mut(wide).zip(dev.chunks_exact(stride)) {
        to[..rest].copy_from_slice(&from[n..]);
    }
    let mut sick = tria(noise, n, rest, wide).sick;
    block.fill(T::zero());
    for i in 0..n {
        block[i * 2 * n..][..n].copy_from_slice(&noise[i * wide..][..n]);
        block[i * 2 * n + n..][..n].copy_from_slice(&dev[i * stride..][..n]);
    }
    put_columns(&mut block[2 * n * n..], 2 * n, n, factor, n);
    sick = sick | sweep(block, n, n, rounding, scratch).sick;
    let columns = minus.len() / n;
    for k in 0..columns {
        column.fill(T::zero());
        for (v, row) in column.iter_mut().zip(minus.chunks_exact(columns)) {
            *v = row[k];
        }
        sick =
            sick | split(downdate(block, 2 * n, 2 * n, column), n, Matrix::Predicted, Matrix::Conditional)?;
    }
    for i in 0..n {
        let row = &block[(n + i) * 2 * n..(n + i + 1) * 2 * n];
        back.gain[i * n..(i + 1) * n].copy_from_slice(&row[..n]);
        back.conditional[i * n..(i + 1) * n].copy_from_slice(&row[n..]);
    }
    divide_lower(back.gain, n, n, block, 2 * n);
    Ok(sick)
}

/// n, from a matrix of n × n.
fn back_len<T>(square: &[T]) -> usize {
    square.len().isqrt()
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
    let n = back_len(factor);
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

/// Chains a later step onto an earlier one (docs/algorithms.md S3): D ← Tria([D  Γ D']), Γ ← Γ G'.
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
