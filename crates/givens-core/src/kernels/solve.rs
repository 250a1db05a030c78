//! Substitution with triangular factors; a zero pivot gives a zero (docs/algorithms.md §2: the generalised inverse).

use super::less_dot;
use crate::scalar::Real;

#[inline(always)]
pub(super) fn inverse_or_zero<T: Real>(pivot: T) -> T {
    T::select(pivot.same(T::zero()), T::zero(), pivot.recip())
}

/// L⁻¹ b in place, L lower triangular n × n in rows of length `stride`.
#[inline(always)]
pub fn solve_lower<T: Real>(l: &[T], stride: usize, b: &mut [T]) {
    for i in 0..b.len() {
        let row = &l[i * stride..];
        let rest = less_dot(b[i], &row[..i], b);
        b[i] = rest * inverse_or_zero(row[i]);
    }
}

/// L⁻¹ B in place, B of rows of length `columns`, L lower triangular in rows of length `stride`.
#[inline(always)]
pub fn solve_lower_rows<T: Real>(l: &[T], stride: usize, b: &mut [T], columns: usize) {
    if columns == 0 {
        return;
    }
    for i in 0..b.len() / columns {
        let (above, row) = b.split_at_mut(i * columns);
        let row = &mut row[..columns];
        let l = &l[i * stride..];
        for (&x, above) in l.iter().zip(above.chunks_exact(columns)) {
            for (y, &z) in row.iter_mut().zip(above) {
                *y = (-x).mul_add(z, *y);
            }
        }
        let inverse = inverse_or_zero(l[i]);
        for y in row {
            *y *= inverse;
        }
    }
}

/// B / Lᵀ = B L⁻ᵀ in place, B `rows` × n, L lower triangular n × n in rows of length `stride`.
#[inline(always)]
pub fn divide_lower_transposed<T: Real>(b: &mut [T], rows: usize, n: usize, l: &[T], stride: usize) {
    for row in b.chunks_exact_mut(n.max(1)).take(rows) {
        solve_lower(l, stride, row);
    }
}

/// B / L = B L⁻¹ in place, B `rows` × n, L lower triangular n × n in rows of length `stride`.
#[inline(always)]
pub fn divide_lower<T: Real>(b: &mut [T], rows: usize, n: usize, l: &[T], stride: usize) {
    for row in b.chunks_exact_mut(n.max(1)).take(rows) {
        for j in (0..n).rev() {
            let g = row[j] * inverse_or_zero(l[j * stride + j]);
            row[j] = g;
            for (x, &y) in row[..j].iter_mut().zip(&l[j * stride..]) {
                *x = (-g).mul_add(y, *x);
            }
        }
    }
}
