//! Triangularisation by Householder reflections of the columns, in echelon form.

use super::faint::unit_row;
use super::product::long_dot as dot;
use super::tria_wide::tria_in_packs;
use super::{Health, outlined};
use crate::scalar::{Mask, Real};

outlined! {
    /// Tria(A): the lower-triangular S with S Sᵀ = A Aᵀ and diagonal ≥ 0, in place (docs/algorithms.md §2).
    ///
    /// `a` holds `rows` × `columns` in rows of length `stride` ≥ max(rows, columns); S ends in its first `rows`
    /// columns, zeros behind it to the end of each row. What is left of a row after the earlier reflections and is at most
    /// `columns` ε of the row counts as zero: that column of S is zero and uses up no reflection, so that the factor of a
    /// deficient A can be divided by. A pack whose lanes disagree on that reports those with the zero as sick; so are lanes
    /// with a row whose squares overflow. Where its products with others do, S is not finite.
    ///
    /// ```
    /// use givens_core::kernels::tria;
    /// let mut a = [3.0_f64, 4.0, 0.0,
    ///              0.0, 5.0, 1.0];
    /// let _ = tria(&mut a, 2, 3, 3);
    /// assert!((a[0] - 5.0).abs() < 1e-15 && (a[3] - 4.0).abs() < 1e-15 && (a[4] - 10f64.sqrt()).abs() < 1e-15);
    /// ```
    pub fn tria(a: &mut [T], rows: usize, columns: usize, stride: usize) -> Health<T> = triangularised
}

#[inline(always)]
fn triangularised<T: Real>(a: &mut [T], rows: usize, columns: usize, stride: usize) -> Health<T> {
    debug_assert!(stride >= rows.max(columns) && a.len() >= rows * stride);
    let mut health = Health::good();
    for i in tria_in_packs(a, rows, columns, stride)..rows {
        // the number of reflections is that of the rows, which lets the compiler know it, until one has nothing left
        if !reflect(a, i, i, [rows, columns, stride], &mut health) {
            echelon(a, i, [rows, columns, stride], &mut health);
            break;
        }
    }
    health
}

/// The rest from row i on, of which nothing is left.
#[inline(never)]
fn echelon<T: Real>(a: &mut [T], i: usize, sizes: [usize; 3], health: &mut Health<T>) {
    let [rows, _, stride] = sizes;
    let mut used = i;
    for i in i..rows {
        used += usize::from(reflect(a, i, used, sizes, health));
    }
    spread_columns(a, rows, stride);
}

/// Reflects what is left of row i, from column `used` on, into that column, and the rows below with it. False if nothing is.
#[inline(always)]
fn reflect<T: Real>(
    a: &mut [T],
    i: usize,
    used: usize,
    [rows, columns, stride]: [usize; 3],
    health: &mut Health<T>,
) -> bool {
    let (above, below) = a.split_at_mut((i + 1) * stride);
    let row = &mut above[i * stride..];
    let settled = sum_of_squares(&row[..used]);
    let rest = sum_of_squares(&row[used.min(columns)..columns]);
    let bound = T::of(columns as f64 * T::EPSILON);
    let whole = settled + rest;
    // what overflows is not nothing
    let mut nothing = rest.le(bound * bound * whole) & whole.finite();
    let (mut norm, mut pivot) = (rest.sqrt(), rest.sqrt());
    let faint = rest.lt(T::of(T::FAINT * T::FAINT));
    if used < columns && faint.any() {
        let (none, length) = unit_row(row, used, columns, bound, faint);
        nothing = (faint & none) | (!faint & nothing);
        (norm, pivot) = (T::select(faint, T::one(), norm), T::select(faint, length, pivot));
    }
    if used >= columns || nothing.all() {
        row[used..].fill(T::zero());
        return false;
    }
    health.note(nothing | (!whole.finite() & whole.same(whole)), i);
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
    row[used] = pivot;
    row[used + 1..].fill(T::zero());
    true
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
