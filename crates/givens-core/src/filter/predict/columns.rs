//! Columns of small matrices.

use crate::scalar::Real;

/// Column `j` of a matrix of `columns` columns.
#[inline(always)]
pub(super) fn gather<T: Real>(a: &[T], columns: usize, j: usize, to: &mut [T]) {
    for (to, row) in to.iter_mut().zip(a.chunks_exact(columns.max(1))) {
        *to = row[j];
    }
}
