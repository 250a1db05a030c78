//! Cholesky factorisation of a positive semidefinite matrix.

use super::less_dot;
use super::rest::{errors_above, norm};
use super::{Health, outlined};
use crate::scalar::{Mask, Real};

outlined! {
    /// The lower-triangular S with P = S Sᵀ and diagonal ≥ 0, in place; the strict upper triangle is cleared.
    ///
    /// Only the lower triangle of `a` (n × n) is read. A pivot is zero if it is within the rounding that errors of
    /// 64 n ε in the elements (relative to the standard deviations) leave in it, and so is its column then; health names
    /// the first pivot that is negative, not finite, or a zero with a column that is not. Those lanes end in NaN.
    ///
    /// ```
    /// use givens_core::kernels::cholesky;
    /// let mut p = [4.0, 2.0, 2.0, 3.0];
    /// assert!(cholesky(&mut p, 2).failed().is_none());
    /// assert_eq!((p[0], p[1], p[2]), (2.0, 0.0, 1.0));
    /// let mut indefinite = [1.0, 2.0, 2.0, 1.0];
    /// assert_eq!(cholesky(&mut indefinite, 2).failed(), Some(1));
    /// ```
    pub fn cholesky(a: &mut [T], n: usize) -> Health<T> = factorised
}

#[inline(always)]
fn factorised<T: Real>(a: &mut [T], n: usize) -> Health<T> {
    factorise(a, n, 64.0, |_, own| own)
}

outlined! {
    /// [`cholesky`] of a computed difference of matrices: the errors are 8 n ε of `scale`, the diagonal before the
    /// subtraction (length n), since that is the size of its rounding.
    pub fn cholesky_scaled(a: &mut [T], n: usize, scale: &[T]) -> Health<T> = factorised_by_scale
}

#[inline(always)]
fn factorised_by_scale<T: Real>(a: &mut [T], n: usize, scale: &[T]) -> Health<T> {
    factorise(a, n, 8.0, |i, own| T::select(scale[i].lt(own), own, scale[i]))
}

#[inline(always)]
fn factorise<T: Real>(a: &mut [T], n: usize, rounding: f64, scale: impl Fn(usize, T) -> T) -> Health<T> {
    let mut health = Health::<T>::good();
    let zero = T::zero();
    let tolerance = T::of(rounding * n as f64 * T::EPSILON);
    for j in 0..n {
        let own = a[j * n + j];
        let mut rounding = tolerance * scale(j, own);
        let pivot = less_dot(own, &a[j * n..j * n + j], &a[j * n..j * n + j]);
        let cancels = pivot.lt(T::of(1e-3) * own);
        if cancels.any() {
            let above = errors_above(a, n, j, |k, row| {
                let own = norm(row);
                scale(k, own * own).abs().sqrt()
            });
            let sigma = scale(j, own).abs().sqrt() + above;
            rounding = T::select(cancels, tolerance * sigma * sigma, rounding);
        }
        let (head, tail) = a.split_at_mut((j + 1) * n);
        let row = &mut head[j * n..];
        // what overflows is not nothing
        let nothing = pivot.abs().le(rounding) & pivot.finite();
        health.note(!nothing & !(zero.lt(pivot) & pivot.finite()), j);
        let root = T::select(nothing, zero, pivot.sqrt());
        let inverse = T::select(nothing, zero, root.recip());
        let vanishes = nothing.any();
        for (i, below) in tail.chunks_exact_mut(n).take(n - j - 1).enumerate() {
            let rest = less_dot(below[j], &row[..j], below);
            if vanishes {
                // |P_ij|² ≤ P_ii P_jj: a zero pivot forces a zero column, to its own rounding and the size of the other
                let own = below[j + 1 + i];
                let bound = (rounding.abs() * (own.abs() + scale(j + 1 + i, own).abs())).sqrt();
                health.note(nothing & !rest.abs().le(bound), j);
            }
            below[j] = rest * inverse;
        }
        row[j] = root;
        row[j + 1..].fill(zero);
    }
    if health.sick.any() {
        a[0] = T::select(health.sick, T::of(f64::NAN), a[0]);
    }
    health
}
