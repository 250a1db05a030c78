//! The update in covariance form: P = P⁻ − W P_zz Wᵀ (2009 eq 43–51; 2011 Table 1).

use super::joint::pivots;
use super::separate::{cross, leftover};
use super::{InnovationMut, Sensed};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::memory::take;
use crate::filter::predict::lanes;
use crate::kernels::{add_outer, cholesky_scaled, divide_lower, divide_lower_transposed, square};
use crate::scalar::Real;

/// Scalars of scratch of [`update`], for `columns` columns of Z and noise and `lost` negative ones.
pub(super) const fn covariance_scratch(n: usize, d: usize, columns: usize, lost: usize) -> usize {
    d * d + n * d + 2 * n * n + n * columns + n * lost + if n > d { n } else { d }
}

/// P_zz = Cov[h] + R, W = P_xz P_zz⁻¹, m = m⁻ + W ν, P = [X − W Z  −W S_R] [·]ᵀ.
///
/// That is P⁻ − W P_zz Wᵀ in the form of Joseph: of a prior that is much wider than what the measurement leaves, the
/// plain difference would be rounding.
#[inline(always)]
pub(super) fn update<T: Real>(
    sensed: &Sensed<T>,
    belief: &mut Belief<T>,
    innovation: &mut InnovationMut<T>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let (n, d, lost, stride) = (belief.mean.len(), sensed.d, sensed.lost, sensed.stride);
    let p_zz = take(&mut scratch, d * d);
    let gain = take(&mut scratch, n * d);
    let scale = take(&mut scratch, n.max(d));
    let cov = take(&mut scratch, n * n);
    let factor = take(&mut scratch, n * n);
    let left = take(&mut scratch, n * stride);
    let minus = take(&mut scratch, n * lost);
    square(p_zz, d, sensed.dev, stride, stride);
    for i in 0..d {
        scale[i] = p_zz[i * d + i];
    }
    add_outer(p_zz, d, d, sensed.minus, lost, sensed.minus, lost, lost, -1.0);
    let mut sick = lanes(cholesky_scaled(p_zz, d, scale), Matrix::Innovation)?;
    sick = sick | pivots(p_zz, d, &innovation.predicted[..d])?;

    cross(gain, belief.factor, sensed, n);
    divide_lower_transposed(gain, n, d, p_zz, d);
    divide_lower(gain, n, d, p_zz, d);
    leftover(left, gain, belief.factor, sensed, n);
    square(cov, n, left, stride, stride);
    for i in 0..n {
        scale[i] = cov[i * n + i];
    }
    for (i, row) in minus.chunks_exact_mut(lost.max(1)).enumerate() {
        for (k, x) in row.iter_mut().enumerate() {
            let w = gain[i * d..(i + 1) * d].iter();
            *x = w.zip(sensed.minus.chunks_exact(lost)).fold(T::zero(), |sum, (&w, z)| w.mul_add(z[k], sum));
        }
    }
    add_outer(cov, n, n, minus, lost, minus, lost, lost, -1.0);
    factor.copy_from_slice(cov);
    sick = sick | lanes(cholesky_scaled(factor, n, scale), Matrix::Posterior)?;
    innovation.whiten(p_zz, d, d)?;
    innovation.factor[..d * d].copy_from_slice(p_zz);
    belief.cov.copy_from_slice(cov);
    belief.factor.copy_from_slice(factor);
    for (m, w) in belief.mean.iter_mut().zip(gain.chunks_exact(d)) {
        *m = w.iter().zip(&innovation.nu[..d]).fold(*m, |m, (&w, &nu)| w.mul_add(nu, m));
    }
    Ok(sick)
}
