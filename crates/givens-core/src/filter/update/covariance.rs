//! The update in covariance form: P = P⁻ − W P_zz Wᵀ (2009 eq 43–51; 2011 Table 1).

use super::posterior::{Posterior, Rows};
use super::square_root::pivots;
use super::{InnovationMut, Sensed};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::lanes::lanes;
use crate::filter::memory::{larger, put_columns, take};
use crate::kernels::{add_outer, cholesky_scaled, dot, solve_lower_rows, square};
use crate::scalar::{Mask, Real};

/// A pivot of P_zz, squared, of less than this many ε of its diagonal is known too badly to be divided by: the mean may
/// be wrong by a thousandth of its standard deviation.
const LEAST: f64 = 1024.0;

/// Scalars of scratch of [`update`], for `columns` columns of Z and noise and `lost` negative ones.
pub(super) const fn covariance_scratch(n: usize, d: usize, columns: usize, lost: usize) -> usize {
    d * d + n * d + 2 * n * n + (n + d) * (columns + lost) + n + larger(n, d)
}

/// P_zz = Cov[h] + R = S_zz S_zzᵀ, m = m⁻ + W e, P = [X − W Z̃  −W S̃_R] [·]ᵀ with W = Cov[x, e], e = S_zz⁻¹ ν, Z̃ = S_zz⁻¹ Z.
///
/// That is P⁻ − W Wᵀ in the form of Joseph: of a prior that is much wider than what the measurement leaves, the
/// plain difference would be rounding.
#[inline(always)]
pub(super) fn update<'a, T: Real>(
    sensed: &Sensed<T>,
    belief: &Belief<T>,
    innovation: &mut InnovationMut<T>,
    mut scratch: &'a mut [T],
) -> Result<(Posterior<'a, T>, T::Mask), Fault> {
    let (n, d, lost, stride) = (belief.mean.len(), sensed.d, sensed.lost, sensed.stride);
    let p_zz = take(&mut scratch, d * d);
    let gain = take(&mut scratch, n * d);
    let scale = take(&mut scratch, n.max(d));
    let mean = take(&mut scratch, n);
    let cov = take(&mut scratch, n * n);
    let factor = take(&mut scratch, n * n);
    let left = take(&mut scratch, n * stride);
    let minus = take(&mut scratch, n * lost);
    let white = take(&mut scratch, d * stride);
    let white_minus = take(&mut scratch, d * lost);
    square(p_zz, d, sensed.dev, stride, stride);
    for i in 0..d {
        scale[i] = p_zz[i * d + i];
    }
    add_outer(p_zz, d, d, sensed.minus, lost, sensed.minus, lost, lost, -1.0);
    let mut sick = lanes(cholesky_scaled(p_zz, d, scale), Matrix::Innovation)?;
    sick = sick | pivots(p_zz, d, &innovation.predicted[..d])?;
    for i in 0..d {
        let pivot = p_zz[i * d + i];
        let lost = !(T::of(LEAST * T::EPSILON) * scale[i]).lt(pivot * pivot);
        if lost.all() {
            return Err(Fault::NotPositive { matrix: Matrix::Innovation, pivot: i });
        }
        sick = sick | lost;
    }

    white.copy_from_slice(&sensed.dev[..d * stride]);
    white_minus.copy_from_slice(&sensed.minus[..d * lost]);
    solve_lower_rows(p_zz, d, white, stride);
    solve_lower_rows(p_zz, d, white_minus, lost);
    for (to, s) in gain.chunks_exact_mut(d).zip(belief.factor.chunks_exact(n)) {
        for (w, z) in to.iter_mut().zip(white.chunks_exact(stride)) {
            *w = dot(s, z);
        }
    }
    left.fill(T::zero());
    put_columns(left, stride, 0, belief.factor, n);
    for (row, gain) in left.chunks_exact_mut(stride).zip(gain.chunks_exact(d)) {
        for (&w, z) in gain.iter().zip(white.chunks_exact(stride)) {
            for (x, &y) in row.iter_mut().zip(z) {
                *x = (-w).mul_add(y, *x);
            }
        }
    }
    square(cov, n, left, stride, stride);
    for i in 0..n {
        scale[i] = cov[i * n + i];
    }
    for (i, row) in minus.chunks_exact_mut(lost.max(1)).enumerate() {
        for (k, x) in row.iter_mut().enumerate() {
            *x = T::zero();
            for (&w, z) in gain[i * d..(i + 1) * d].iter().zip(white_minus.chunks_exact(lost)) {
                *x = w.mul_add(z[k], *x);
            }
        }
    }
    add_outer(cov, n, n, minus, lost, minus, lost, lost, -1.0);
    factor.copy_from_slice(cov);
    sick = sick | lanes(cholesky_scaled(factor, n, scale), Matrix::Posterior)?;
    innovation.whiten(p_zz, d, d)?;
    innovation.factor[..d * d].copy_from_slice(p_zz);
    for (i, (to, &m)) in mean.iter_mut().zip(&*belief.mean).enumerate() {
        *to = m + dot(&gain[i * d..(i + 1) * d], innovation.white);
    }
    Ok((Posterior { mean, factor: Rows { of: factor, stride: n }, cov, learnt: None }, sick))
}
