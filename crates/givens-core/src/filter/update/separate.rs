//! Two triangularisations: S_zz = Tria([Z S_R]), then the posterior's root of what is left (2009 Appendix B).

use super::Sensed;
use crate::filter::memory::{larger, put_columns, put_identity, take};
use crate::kernels::tria;
use crate::scalar::Real;

/// Scalars of scratch of [`separate`], for `rest` columns of E and noise.
pub(super) const fn separate_scratch(n: usize, d: usize, rest: usize) -> usize {
    (d + n) * (n + larger(rest, d))
}

/// Writes the block [S_zz 0; A B] of d + n rows of that length.
///
/// In print the gain is W = (P_xz / S_zzᵀ) / S_zz and what is left X − W Z, −W S_R: with two measures that nearly repeat
/// each other, the mean would lose the square of their likeness. Both are what the first triangularisation's own
/// reflections leave of X = S [I 0], without a division: W S_zz = S A, and a turn of [X − W Z  −W S_R] is S V.
#[inline(always)]
pub(super) fn separate<T: Real>(block: &mut [T], sensed: &Sensed<T>, mut scratch: &mut [T]) -> T::Mask {
    let (d, stride) = (sensed.d, sensed.stride);
    let size = block.len().isqrt();
    let n = size - d;
    let wide = larger(stride, size);
    let all = take(&mut scratch, size * wide);
    all.fill(T::zero());
    put_columns(all, wide, 0, &sensed.dev[..d * stride], stride);
    put_identity(&mut all[d * wide..], wide, 0, n);
    // the first d rows are S_zz, and those after them [A V]; the rest of the rows make B of V
    let sick = tria(all, size, stride, wide).sick;
    for (to, from) in block.chunks_exact_mut(size).zip(all.chunks_exact(wide)) {
        to.copy_from_slice(&from[..size]);
    }
    sick
}
