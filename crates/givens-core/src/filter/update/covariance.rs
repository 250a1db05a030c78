//! The update in covariance form: P = P⁻ − W P_zz Wᵀ (2009 eq 43–51; 2011 Table 1).

use super::joint::pivots;
use super::separate::cross;
use super::{InnovationMut, Sensed};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::memory::take;
use crate::filter::predict::lanes;
use crate::kernels::{add_outer, cholesky_scaled, divide_lower_transposed, solve_lower, square};
use crate::scalar::Real;

/// Scalars of scratch of [`update`].
pub(super) const fn covariance_scratch(n: usize, d: usize) -> usize {
    d * d + n * d + 2 * n * n + if n > d { n } else { d }
}

/// P_zz = Cov[h] + R, K = P_xz / S_zzᵀ, P = P⁻ − K Kᵀ, m = m⁻ + K S_zz⁻¹ ν.
#[inline(always)]
pub(super) fn update<T: Real>(
    sensed: &Sensed<T>,
    belief: &mut Belief<T>,
    innovation: &mut InnovationMut<T>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let (n, d, lost) = (belief.mean.len(), sensed.d, sensed.lost);
    let p_zz = take(&mut scratch, d * d);
    let gain = take(&mut scratch, n * d);
    let scale = take(&mut scratch, n.max(d));
    let cov = take(&mut scratch, n * n);
    let factor = take(&mut scratch, n * n);
    square(p_zz, d, sensed.dev, sensed.stride, sensed.stride);
    for i in 0..d {
        scale[i] = p_zz[i * d + i];
    }
    add_outer(p_zz, d, d, sensed.minus, lost, sensed.minus, lost, lost, -1.0);
    let mut sick = lanes(cholesky_scaled(p_zz, d, scale), Matrix::Innovation)?;
    sick = sick | pivots(p_zz, d, d)?;

    cross(gain, belief.factor, sensed, n);
    divide_lower_transposed(gain, n, d, p_zz, d);
    for i in 0..n {
        scale[i] = belief.cov[i * n + i];
    }
    cov.copy_from_slice(belief.cov);
    add_outer(cov, n, n, gain, d, gain, d, d, -1.0);
    factor.copy_from_slice(cov);
    sick = sick | lanes(cholesky_scaled(factor, n, scale), Matrix::Posterior)?;
    belief.cov.copy_from_slice(cov);
    belief.factor.copy_from_slice(factor);

    innovation.factor[..d * d].copy_from_slice(p_zz);
    innovation.white[..d].copy_from_slice(&innovation.nu[..d]);
    solve_lower(p_zz, d, &mut innovation.white[..d]);
    for (m, k) in belief.mean.iter_mut().zip(gain.chunks_exact(d)) {
        *m = k.iter().zip(&innovation.white[..d]).fold(*m, |m, (&k, &e)| k.mul_add(e, m));
    }
    Ok(sick)
}
