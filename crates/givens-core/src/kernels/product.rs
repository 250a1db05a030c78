//! Products of small matrices, and the sums that all kernels are made of.
//!
//! The sums are loops, not folds, and the short ones go over indices: what the compiler does not inline, a zip in a large
//! function among it, is compiled without the instructions of a pack.

use super::outlined;
use crate::scalar::{Mask, Real};

/// From this length on sums are taken four at a time.
const LONG: usize = 64;

/// Σ aᵢ bᵢ over the shorter of both.
#[inline(always)]
pub fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    plus_dot(T::zero(), a, b)
}

/// start + Σ aᵢ bᵢ over the shorter of both.
#[inline(always)]
pub fn plus_dot<T: Real>(start: T, a: &[T], b: &[T]) -> T {
    let mut sum = start;
    for i in 0..a.len().min(b.len()) {
        sum = a[i].mul_add(b[i], sum);
    }
    sum
}

/// start − Σ aᵢ bᵢ over the shorter of both.
#[inline(always)]
pub fn less_dot<T: Real>(start: T, a: &[T], b: &[T]) -> T {
    let mut rest = start;
    for i in 0..a.len().min(b.len()) {
        rest = (-a[i]).mul_add(b[i], rest);
    }
    rest
}

/// start + Σ |xᵢ|: a bound of every xᵢ, and not finite if one of them is not.
#[inline(always)]
pub fn plus_magnitudes<T: Real>(start: T, row: &[T]) -> T {
    if row.len() >= 16 {
        // in four sums: the additions need not wait for each other
        let (quads, rest) = row.as_chunks::<4>();
        let mut sums = [start, T::zero(), T::zero(), T::zero()];
        for quad in quads {
            for k in 0..4 {
                sums[k] += quad[k].abs();
            }
        }
        return plus_magnitudes_of_few((sums[0] + sums[1]) + (sums[2] + sums[3]), rest);
    }
    plus_magnitudes_of_few(start, row)
}

#[inline(always)]
fn plus_magnitudes_of_few<T: Real>(start: T, row: &[T]) -> T {
    let mut sum = start;
    for &x in row {
        sum += x.abs();
    }
    sum
}

/// The first row, of those of length `stride`, that has a number which is finite in no lane.
#[inline(always)]
pub fn wild_row<T: Real>(rows: &[T], stride: usize) -> Option<usize> {
    for (i, row) in rows.chunks_exact(stride.max(1)).enumerate() {
        let mut wild = T::Mask::splat(false);
        for &x in row {
            wild = wild | !x.finite();
        }
        if wild.all() {
            return Some(i);
        }
    }
    None
}

/// The same in four sums side by side: the additions of a long one need not wait for each other.
#[inline(always)]
pub(super) fn long_dot<T: Real>(a: &[T], b: &[T]) -> T {
    let mut sums = [T::zero(); 4];
    let ((a, rest_a), (b, rest_b)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    for (x, y) in a.iter().zip(b) {
        for k in 0..4 {
            sums[k] = x[k].mul_add(y[k], sums[k]);
        }
    }
    for (k, (&x, &y)) in rest_a.iter().zip(rest_b).enumerate() {
        sums[k] = x.mul_add(y, sums[k]);
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

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
            c[i * columns + j] += T::of(sign) * dot(x, y);
        }
    }
}

/// P = A Aᵀ, n × n and symmetric to the bit, from A of n rows of length `stride`, of which `k` columns count.
#[inline(always)]
pub fn square<T: Real>(p: &mut [T], n: usize, a: &[T], stride: usize, k: usize) {
    for i in 0..n {
        for j in 0..=i {
            let (x, y) = (&a[i * stride..i * stride + k], &a[j * stride..j * stride + k]);
            let product = if k < LONG { dot(x, y) } else { long_dot(x, y) };
            (p[i * n + j], p[j * n + i]) = (product, product);
        }
    }
}

outlined! {
    /// P = S Sᵀ, n × n and symmetric to the bit, from the lower-triangular S in rows of length n.
    pub fn square_lower(p: &mut [T], n: usize, s: &[T]) -> () = squared
}

#[inline(always)]
fn squared<T: Real>(p: &mut [T], n: usize, s: &[T]) {
    for i in 0..n {
        for j in 0..=i {
            let (x, y) = (&s[i * n..=i * n + j], &s[j * n..=j * n + j]);
            let product = if j < LONG { dot(x, y) } else { long_dot(x, y) };
            (p[i * n + j], p[j * n + i]) = (product, product);
        }
    }
}

/// A S in place, A `rows` × n in rows of length n, S lower triangular n × n in rows of length `stride`.
#[inline(always)]
pub fn product_lower<T: Real>(a: &mut [T], rows: usize, n: usize, s: &[T], stride: usize) {
    for row in a.chunks_exact_mut(n.max(1)).take(rows) {
        for j in 0..n {
            let mut sum = T::zero();
            for k in j..n {
                sum = row[k].mul_add(s[k * stride + j], sum);
            }
            row[j] = sum;
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
