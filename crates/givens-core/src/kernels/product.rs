//! Products of small matrices.

use crate::scalar::Real;

/// C + A Bᵀ (or C − A Bᵀ) for `sign` = ±1: C `rows` × `columns`, A `rows` × k and B `columns` × k in rows of length
/// `stride_a`, `stride_b`.
#[inline(always)]
pub fn add_outer<T: Real>(
    c: &mut [T],
    rows: usize,
    columns: usize,
    a: &[T],
    stride_a: usize,
    b: &[T],
    stride_b: usize,
    k: usize,
    sign: f64,
) {
    for i in 0..rows {
        let x = &a[i * stride_a..i * stride_a + k];
        for j in 0..columns {
            let y = &b[j * stride_b..j * stride_b + k];
            let dot = x.iter().zip(y).fold(T::zero(), |sum, (&x, &y)| x.mul_add(y, sum));
            c[i * columns + j] += T::of(sign) * dot;
        }
    }
}

/// P = A Aᵀ, n × n and symmetric to the bit, from A of n rows of length `stride`, of which `k` columns count.
#[inline(always)]
pub fn square<T: Real>(p: &mut [T], n: usize, a: &[T], stride: usize, k: usize) {
    for i in 0..n {
        for j in 0..=i {
            let (x, y) = (&a[i * stride..i * stride + k], &a[j * stride..j * stride + k]);
            let dot = x.iter().zip(y).fold(T::zero(), |sum, (&x, &y)| x.mul_add(y, sum));
            p[i * n + j] = dot;
            p[j * n + i] = dot;
        }
    }
}

/// A S in place, A `rows` × n in rows of length n, S lower triangular n × n.
#[inline(always)]
pub fn product_lower<T: Real>(a: &mut [T], rows: usize, n: usize, s: &[T]) {
    for row in a.chunks_exact_mut(n.max(1)).take(rows) {
        for j in 0..n {
            row[j] = (j..n).fold(T::zero(), |sum, k| row[k].mul_add(s[k * n + j], sum));
        }
    }
}

/// Copies the leading n × n of `from` (rows of length `stride`) to `to` (rows of length n).
#[inline(always)]
pub fn copy_lower<T: Real>(to: &mut [T], n: usize, from: &[T], stride: usize) {
    for i in 0..n {
        to[i * n..(i + 1) * n].copy_from_slice(&from[i * stride..i * stride + n]);
    }
}
