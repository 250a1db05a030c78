//! Two triangularisations (2009 Appendix B): S_zz = Tria([Z S_R]), then S = Tria([X − W Z  W S_R]).

use super::joint::pivots;
use super::{InnovationMut, Sensed};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::memory::take;
use crate::filter::predict::lanes;
use crate::kernels::{copy_lower, divide_lower, divide_lower_transposed, downdate, tria};
use crate::scalar::Real;

/// Scalars of scratch of [`update`], for `columns` columns of Z and noise.
pub(super) const fn separate_scratch(n: usize, d: usize, columns: usize) -> usize {
    let wide = if columns > d { columns } else { d };
    let longer = if n > d { n } else { d };
    d * wide + n * d + n * columns + longer
}

/// W = (P_xz / S_zzᵀ) / S_zz with P_xz = X Zᵀ, m = m⁻ + W ν.
#[inline(always)]
pub(super) fn update<T: Real>(
    sensed: &Sensed<T>,
    belief: &mut Belief<T>,
    innovation: &mut InnovationMut<T>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let (n, d, stride) = (belief.mean.len(), sensed.d, sensed.stride);
    let wide = stride.max(d);
    let s_zz = take(&mut scratch, d * wide);
    let gain = take(&mut scratch, n * d);
    let posterior = take(&mut scratch, n * stride);
    let column = take(&mut scratch, n.max(d));

    for (to, from) in s_zz.chunks_exact_mut(wide).zip(sensed.dev.chunks_exact(stride)).take(d) {
        to[..stride].copy_from_slice(from);
    }
    let mut sick = tria(s_zz, d, stride, wide).sick;
    for k in 0..sensed.lost {
        for (v, row) in column.iter_mut().zip(sensed.minus.chunks_exact(sensed.lost)).take(d) {
            *v = row[k];
        }
        sick = sick | lanes(downdate(s_zz, d, wide, &mut column[..d]), Matrix::Innovation)?;
    }
    sick = sick | pivots(s_zz, wide, &innovation.predicted[..d])?;

    cross(gain, belief.factor, sensed, n);
    divide_lower_transposed(gain, n, d, s_zz, wide);
    divide_lower(gain, n, d, s_zz, wide);

    leftover(posterior, gain, belief.factor, sensed, n);
    sick = sick | tria(posterior, n, stride, stride).sick;
    for k in 0..sensed.lost {
        for (v, w) in column.iter_mut().zip(gain.chunks_exact(d)) {
            let rows = sensed.minus.chunks_exact(sensed.lost);
            *v = w.iter().zip(rows).fold(T::zero(), |sum, (&w, row)| w.mul_add(row[k], sum));
        }
        sick = sick | lanes(downdate(posterior, n, stride, &mut column[..n]), Matrix::Posterior)?;
    }
    innovation.whiten(s_zz, wide, d)?;
    copy_lower(belief.factor, n, posterior, stride);
    copy_lower(innovation.factor, d, s_zz, wide);
    for (m, w) in belief.mean.iter_mut().zip(gain.chunks_exact(d)) {
        *m = w.iter().zip(&innovation.nu[..d]).fold(*m, |sum, (&w, &nu)| w.mul_add(nu, sum));
    }
    Ok(sick)
}

/// [X − W Z  −W S_R] with X = [S 0], n rows as long as those of Z: what the gain W leaves of the state's deviations.
#[inline(always)]
pub(super) fn leftover<T: Real>(to: &mut [T], gain: &[T], factor: &[T], sensed: &Sensed<T>, n: usize) {
    let (d, stride) = (sensed.d, sensed.stride);
    for i in 0..n {
        let row = &mut to[i * stride..(i + 1) * stride];
        row.fill(T::zero());
        row[..n].copy_from_slice(&factor[i * n..(i + 1) * n]);
        for (&w, z) in gain[i * d..(i + 1) * d].iter().zip(sensed.dev.chunks_exact(stride)) {
            for (x, &y) in row.iter_mut().zip(z) {
                *x = (-w).mul_add(y, *x);
            }
        }
    }
}

/// P_xz = Cov[x, z] = S Dᵀ, n × d.
#[inline(always)]
pub(super) fn cross<T: Real>(p_xz: &mut [T], factor: &[T], sensed: &Sensed<T>, n: usize) {
    for (to, s) in p_xz.chunks_exact_mut(sensed.d).zip(factor.chunks_exact(n)) {
        for (c, z) in to.iter_mut().zip(sensed.dev.chunks_exact(sensed.stride)) {
            *c = s.iter().zip(z).fold(T::zero(), |sum, (&x, &y)| x.mul_add(y, sum));
        }
    }
}
