//! The predicted measurement in the coordinates of the innovation's root.

use super::Sensed;
use crate::filter::memory::take;
use crate::kernels::solve_lower_rows;
use crate::scalar::Real;

/// S_zz⁻¹ [D E S_R] and S_zz⁻¹ E₋, laid out as in [`Sensed`]; no row is longer than one.
pub(super) struct Whitened<'a, T> {
    /// d rows of length `stride`.
    pub dev: &'a [T],
    /// d rows of length `lost`.
    pub minus: &'a [T],
}

impl<'a, T: Real> Whitened<'a, T> {
    /// By the root S_zz in rows of length `wide`; memory for dev and minus is taken from `scratch`.
    #[inline(always)]
    pub fn of(sensed: &Sensed<T>, s_zz: &[T], wide: usize, mut scratch: &'a mut [T]) -> Self {
        let (d, stride, lost) = (sensed.d, sensed.stride, sensed.lost);
        let dev = take(&mut scratch, d * stride);
        let minus = take(&mut scratch, d * lost);
        dev.copy_from_slice(&sensed.dev[..d * stride]);
        minus.copy_from_slice(&sensed.minus[..d * lost]);
        solve_lower_rows(s_zz, wide, dev, stride);
        solve_lower_rows(s_zz, wide, minus, lost);
        Self { dev, minus }
    }
}

/// A ← A − G Z: what the gain leaves of the deviations A, rows of length `stride`, n of A and d of Z; G is n × d.
#[inline(always)]
pub(super) fn leftover<T: Real>(left: &mut [T], gain: &[T], z: &[T], d: usize, stride: usize) {
    for (row, gain) in left.chunks_exact_mut(stride).zip(gain.chunks_exact(d)) {
        for (&g, z) in gain.iter().zip(z.chunks_exact(stride)) {
            for (x, &y) in row.iter_mut().zip(z) {
                *x = (-g).mul_add(y, *x);
            }
        }
    }
}
