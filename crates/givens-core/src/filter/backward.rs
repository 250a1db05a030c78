//! What a time update leaves for the smoother, and how the steps of one gap are chained.

use super::memory::{put_columns, take};
use crate::kernels::{Health, copy_lower, tria};
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

/// C = A B, all n × n, A lower triangular.
#[inline(always)]
pub(crate) fn multiply_lower<T: Real>(c: &mut [T], n: usize, a: &[T], b: &[T]) {
    for (i, (to, row)) in c.chunks_exact_mut(n).zip(a.chunks_exact(n)).enumerate() {
        to.fill(T::zero());
        for (&x, from) in row[..=i].iter().zip(b.chunks_exact(n)) {
            for (sum, &y) in to.iter_mut().zip(from) {
                *sum = x.mul_add(y, *sum);
            }
        }
    }
}
