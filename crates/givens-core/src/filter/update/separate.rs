//! Two triangularisations (2009 Appendix B): S_zz = Tria([Z S_R]), then S = Tria([X − W Z  W S_R]).

use super::joint::pivots;
use super::posterior::{Posterior, Rows};
use super::whitened::{Whitened, leftover};
use super::{InnovationMut, Sensed};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::memory::{larger, put_identity, take};
use crate::filter::predict::lanes;
use crate::kernels::{copy_lower, dot, downdate, product_lower, tria};
use crate::scalar::Real;

/// Scalars of scratch of [`update`], for `columns` columns of Z and noise and `lost` negative ones.
pub(super) const fn separate_scratch(n: usize, d: usize, columns: usize, lost: usize) -> usize {
    let wide = larger(columns, d);
    let longer = larger(n, d);
    2 * d * wide + d * lost + n * columns + n * d + longer + n + n * n
}

/// In the coordinates of the roots, where W is A = Cov[a, e] and S = S⁻ B: A = D̃ᵀ, B = Tria([I − A D̃  −A Ẽ  −A S̃_R]),
/// the tilde for S_zz⁻¹. So nothing is divided by S_zz twice, and a smoother has its A and B.
#[inline(always)]
pub(super) fn update<'a, T: Real>(
    sensed: &Sensed<T>,
    belief: &Belief<T>,
    innovation: &mut InnovationMut<T>,
    learning: bool,
    mut scratch: &'a mut [T],
) -> Result<(Posterior<'a, T>, T::Mask), Fault> {
    let (n, d, stride) = (belief.mean.len(), sensed.d, sensed.stride);
    let wide = stride.max(d);
    let s_zz = take(&mut scratch, d * wide);
    let left = take(&mut scratch, n * stride);
    let gain = take(&mut scratch, n * d);
    let column = take(&mut scratch, n.max(d));
    let mean = take(&mut scratch, n);
    let factor = take(&mut scratch, n * n);

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
    let z = Whitened::of(sensed, s_zz, wide, scratch);
    innovation.whiten(s_zz, wide, d)?;

    left.fill(T::zero());
    put_identity(left, stride, 0, n);
    for (i, row) in gain.chunks_exact_mut(d).enumerate() {
        for (a, z) in row.iter_mut().zip(z.dev.chunks_exact(stride)) {
            *a = z[i];
        }
    }
    leftover(left, gain, z.dev, d, stride);
    sick = sick | tria(left, n, stride, stride).sick;
    for k in 0..sensed.lost {
        for (v, a) in column.iter_mut().zip(gain.chunks_exact(d)) {
            let minus = z.minus.iter().skip(k).step_by(sensed.lost);
            *v = a.iter().zip(minus).fold(T::zero(), |sum, (&a, &z)| a.mul_add(z, sum));
        }
        sick = sick | lanes(downdate(left, n, stride, &mut column[..n]), Matrix::Posterior)?;
    }
    copy_lower(innovation.factor, d, s_zz, wide);
    for (x, a) in column.iter_mut().zip(gain.chunks_exact(d)) {
        *x = dot(a, innovation.white);
    }
    let moved = &column[..n];
    belief.advanced(moved, mean);
    factor.copy_from_slice(belief.factor);
    product_lower(factor, n, n, left, stride);
    let learnt = if learning { Some((moved, Rows { of: left, stride })) } else { None };
    Ok((Posterior { mean, factor: Rows { of: factor, stride: n }, cov: &[], learnt }, sick))
}
