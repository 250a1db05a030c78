//! Lower triangles without the zeros above them: the state of a solver holds no number twice.

use crate::scalar::Real;

/// Scalars of the lower triangle of n × n.
pub(super) const fn packed_len(n: usize) -> usize {
    n * (n + 1) / 2
}

/// The lower triangle of `full`, row by row.
#[inline(always)]
pub(super) fn pack<T: Real>(n: usize, full: &[T], packed: &mut [T]) {
    let mut rest = packed;
    for i in 0..n {
        let (row, tail) = rest.split_at_mut(i + 1);
        row.copy_from_slice(&full[i * n..=i * n + i]);
        rest = tail;
    }
}

/// The lower triangular matrix of `packed`.
#[inline(always)]
pub(super) fn unpack<T: Real>(n: usize, packed: &[T], full: &mut [T]) {
    let mut rest = packed;
    for i in 0..n {
        let (row, tail) = rest.split_at(i + 1);
        full[i * n..=i * n + i].copy_from_slice(row);
        full[i * n + i + 1..(i + 1) * n].fill(T::zero());
        rest = tail;
    }
}

/// The symmetric matrix of `packed`.
#[inline(always)]
pub(super) fn unpack_symmetric<T: Real>(n: usize, packed: &[T], full: &mut [T]) {
    unpack(n, packed, full);
    for i in 0..n {
        for j in i + 1..n {
            full[i * n + j] = full[j * n + i];
        }
    }
}
