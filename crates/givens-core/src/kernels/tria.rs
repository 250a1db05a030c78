//! Triangularisation by Householder reflections of the columns, in echelon form.

use super::Health;
use super::product::long_dot as dot;
use crate::scalar::{Mask, Real};

/// Tria(A): the lower-triangular S with S Sᵀ = A Aᵀ and diagonal ≥ 0, in place (docs/algorithms.md §2).
///
/// `a` holds `rows` × `columns` in rows of length `stride` ≥ max(rows, columns); S ends in its first `rows`
/// columns, zeros behind it. What is left of a row after the earlier reflections and is at most
/// `columns` ε of the row counts as zero: that column of S is zero and uses up no reflection, so that the factor
/// of a deficient A can be divided by. A pack whose lanes disagree on that reports those with the zero as sick.
///
/// ```
/// use givens_core::kernels::tria;
/// let mut a = [3.0_f64, 4.0, 0.0,
///              0.0, 5.0, 1.0];
/// let _ = tria(&mut a, 2, 3, 3);
/// assert!((a[0] - 5.0).abs() < 1e-15 && (a[3] - 4.0).abs() < 1e-15 && (a[4] - 10f64.sqrt()).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn tria<T: Real>(a: &mut [T], rows: usize, columns: usize, stride: usize) -> Health<T> {
    debug_assert!(stride >= rows.max(columns) && a.len() >= rows * stride);
    let mut health = Health::good();
    let mut used = 0;
    for i in 0..rows {
        let (above, below) = a.split_at_mut((i + 1) * stride);
        let row = &mut above[i * stride..];
        let settled = sum_of_squares(&row[..used]);
        let rest = sum_of_squares(&row[used..columns]);
        let bound = T::of(columns as f64 * T::EPSILON);
        let nothing = rest.le(bound * bound * (settled + rest));
        if nothing.all() {
            row[used..].fill(T::zero());
            continue;
        }
        health.note(nothing, i);
        let norm = rest.sqrt();
        // v = rest of the row with its head moved away from zero; H = I − v vᵀ / (norm · |v head|)
        let head = row[used];
        let toward = norm.copysign(head);
        let scale = (norm * (norm + head.abs())).recip();
        row[used] = head + toward;
        let flip = -T::one().copysign(head);
        for lower in below.chunks_exact_mut(stride).take(rows - i - 1) {
            let dot = dot(&row[used..columns], &lower[used..columns]) * scale;
            for (l, &v) in lower[used..columns].iter_mut().zip(&row[used..columns]) {
                *l = (-dot).mul_add(v, *l);
            }
            lower[used] *= flip;
        }
        row[used] = norm;
        row[used + 1..].fill(T::zero());
        used += 1;
    }
    if used < rows {
        spread_columns(a, rows, stride);
    }
    health
}

/// Moves the columns of an echelon form under their pivots and puts a zero column where a row had none.
#[inline(never)]
fn spread_columns<T: Real>(a: &mut [T], rows: usize, stride: usize) {
    for i in 0..rows {
        if a[i * stride + i].same(T::zero()).all() {
            for row in a.chunks_exact_mut(stride).take(rows).skip(i + 1) {
                row[i..rows].rotate_right(1);
            }
        }
    }
}

#[inline(always)]
fn sum_of_squares<T: Real>(row: &[T]) -> T {
    dot(row, row)
}
