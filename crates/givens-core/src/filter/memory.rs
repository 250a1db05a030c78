//! Carving a caller's slice into the arrays of a step.

use crate::scalar::{LANES, Real};

/// The larger of two lengths.
pub(crate) const fn larger(a: usize, b: usize) -> usize {
    if a > b { a } else { b }
}

/// So many vectors of length n, and matrices n × n; the largest number where there are not so many scalars.
pub(crate) const fn vectors_and_matrices(n: usize, vectors: usize, matrices: usize) -> usize {
    n.saturating_mul(vectors.saturating_add(n.saturating_mul(matrices)))
}

/// The length of a row of that many columns with which it fills whole packs.
pub(crate) const fn whole_packs(columns: usize) -> usize {
    columns.saturating_add(LANES - 1) / LANES * LANES
}

/// The next `len` scalars of `memory`.
#[inline(always)]
pub(crate) fn take<'a, T>(memory: &mut &'a mut [T], len: usize) -> &'a mut [T] {
    let (head, tail) = core::mem::take(memory).split_at_mut(len);
    *memory = tail;
    head
}

/// Writes `block` (rows of length `width`) into columns `at`… of `to` (rows of length `stride`).
#[inline(always)]
pub(crate) fn put_columns<T: Copy>(to: &mut [T], stride: usize, at: usize, block: &[T], width: usize) {
    if width == 0 {
        return;
    }
    let (mut from, mut first) = (0, at);
    while from + width <= block.len() {
        to[first..][..width].copy_from_slice(&block[from..][..width]);
        from += width;
        first += stride;
    }
}

/// Writes the identity into columns `at`… of the n rows of `to`, of length `stride`, which are zero there.
#[inline(always)]
pub(crate) fn put_identity<T: Real>(to: &mut [T], stride: usize, at: usize, n: usize) {
    for (i, row) in to.chunks_exact_mut(stride).take(n).enumerate() {
        row[at + i] = T::one();
    }
}
