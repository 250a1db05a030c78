//! What is believed after a measurement, before the belief takes it over.

use super::Learnt;
use crate::filter::form::Belief;
use crate::kernels::copy_lower;
use crate::scalar::Real;

/// Rows of a matrix, each `stride` from the one before.
#[derive(Clone, Copy)]
pub(crate) struct Rows<'a, T> {
    pub of: &'a [T],
    pub stride: usize,
}

impl<'a, T> Rows<'a, T> {
    /// The first `len` scalars of row `i`.
    #[inline(always)]
    pub fn row(&self, i: usize, len: usize) -> &'a [T] {
        &self.of[i * self.stride..][..len]
    }
}

/// m, S and P after an update, and x = m⁻ + S⁻ a with a = `moved` + `turn` u.
pub(crate) struct Posterior<'a, T> {
    /// Length n.
    pub mean: &'a [T],
    /// Lower triangular, n × n.
    pub factor: Rows<'a, T>,
    /// n × n in covariance form; otherwise empty.
    pub cov: &'a [T],
    /// A e of length n and B, lower triangular n × n, for a smoother.
    pub learnt: Option<(&'a [T], Rows<'a, T>)>,
}

impl<T: Real> Posterior<'_, T> {
    /// Makes it the belief.
    #[inline(always)]
    pub fn settle(&self, belief: &mut Belief<T>, learnt: &mut Learnt<T>) {
        belief.mean.copy_from_slice(self.mean);
        copy_lower(belief.factor, self.mean.len(), self.factor.of, self.factor.stride);
        belief.cov.copy_from_slice(self.cov);
        if let Some((moved, turn)) = self.learnt {
            learnt.add(moved, turn);
        }
    }
}
