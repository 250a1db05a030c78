//! One step back in covariance form: from the smoothed belief at k + 1 to that at k (2011 Table 2).

use crate::filter::backward::multiply;
use crate::filter::{Belief, Fault, Matrix};
use crate::kernels::{add_outer, cholesky_scaled, outlined};
use crate::scalar::Real;

use crate::filter::lanes::lanes;
use crate::filter::memory::{take, vectors_and_matrices};

/// What was recorded of the time update from k to k + 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage<'a, T> {
    /// m_k, filtered.
    pub mean: &'a [T],
    /// P_k, filtered.
    pub cov: &'a [T],
    /// P⁻_k, from which measurements made P_k and whose rounding P_k has; empty if unknown.
    pub before: &'a [T],
    /// m⁻_{k+1}.
    pub predicted_mean: &'a [T],
    /// P⁻_{k+1}.
    pub predicted_cov: &'a [T],
    /// G_k, n × n.
    pub gain: &'a [T],
}

impl<'a, T> Passage<'a, T> {
    /// The arrays of one record; `before` is the predicted covariance of the one before it.
    #[inline(always)]
    pub fn of(record: &'a [T], before: &'a [T], n: usize) -> Self {
        let (mean, rest) = record.split_at(n);
        let (cov, rest) = rest.split_at(n * n);
        let (predicted_mean, rest) = rest.split_at(n);
        let (predicted_cov, gain) = rest.split_at(n * n);
        Passage { mean, cov, before, predicted_mean, predicted_cov, gain }
    }
}

/// Scalars of scratch of [`step_back`].
pub(super) const fn back_scratch(n: usize) -> usize {
    vectors_and_matrices(n, 2, 4)
}

/// mˢ_k = m_k + G_k (mˢ_{k+1} − m⁻_{k+1}): the mean-only backward pass (2011 §7, remark ii).
#[inline(always)]
pub(super) fn mean_back<T: Real>(passage: &Passage<T>, smoothed: &mut [T], scratch: &mut [T]) {
    let n = smoothed.len();
    let change = &mut scratch[..n];
    for (c, (&s, &m)) in change.iter_mut().zip(smoothed.iter().zip(passage.predicted_mean)) {
        *c = s - m;
    }
    for (i, s) in smoothed.iter_mut().enumerate() {
        let row = &passage.gain[i * n..(i + 1) * n];
        *s = row.iter().zip(&*change).fold(passage.mean[i], |sum, (&g, &c)| g.mul_add(c, sum));
    }
}

outlined! {
    /// Takes `smoothed` from k + 1 to k: Pˢ_k = P_k + G_k (Pˢ_{k+1} − P⁻_{k+1}) G_kᵀ, its root, and the mean.
    ///
    /// # Errors
    /// A smoothed covariance that is not positive semidefinite.
    pub(super) fn step_back(
        passage: &Passage<'_, T>,
        smoothed: &mut Belief<'_, T>,
        scratch: &mut [T]
    ) -> Result<T::Mask, Fault> = stepped_back
}

#[inline(always)]
fn stepped_back<T: Real>(
    passage: &Passage<T>,
    smoothed: &mut Belief<T>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let n = smoothed.mean.len();
    mean_back(passage, smoothed.mean, scratch);
    let product = take(&mut scratch, n * n);
    let scale = take(&mut scratch, n);
    // the rounding of P_k is that of P⁻_k, and that of G (Pˢ − P⁻) Gᵀ is its terms'; both may be far above P_k
    for (i, s) in scale.iter_mut().enumerate() {
        let gain = passage.gain[i * n..(i + 1) * n].iter().enumerate();
        let sigma = gain
            .fold(T::zero(), |sum, (j, &g)| g.abs().mul_add(passage.predicted_cov[j * n + j].sqrt(), sum));
        let own = passage.before.get(i * n + i).unwrap_or(&passage.cov[i * n + i]);
        *s = own.max(sigma * sigma);
    }
    for (s, &p) in smoothed.cov.iter_mut().zip(passage.predicted_cov) {
        *s -= p;
    }
    multiply(product, n, passage.gain, smoothed.cov);
    smoothed.cov.copy_from_slice(passage.cov);
    add_outer(smoothed.cov, n, n, product, n, passage.gain, n, n, 1.0);
    symmetrise(smoothed.cov, n);
    smoothed.factor.copy_from_slice(smoothed.cov);
    lanes(cholesky_scaled(smoothed.factor, n, scale), Matrix::Smoothed)
}

/// The mean of a matrix and its transpose: what rounding had made of a symmetric one.
#[inline(always)]
pub(super) fn symmetrise<T: Real>(p: &mut [T], n: usize) {
    for i in 0..n {
        for j in 0..i {
            let mean = T::of(0.5) * (p[i * n + j] + p[j * n + i]);
            p[i * n + j] = mean;
            p[j * n + i] = mean;
        }
    }
}
