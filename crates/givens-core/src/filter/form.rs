//! The two forms of a filter: the covariance itself, or a root of it.

use crate::kernels::dot;
use crate::scalar::Real;

/// The form in which a filter carries its covariance.
pub trait Form: Copy + Default {
    /// Square-root form: the factor is computed by triangularisation and the covariance never formed.
    const SQUARE_ROOT: bool;
}

/// Covariance form: P is computed, and factorised where points are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Covariance;

impl Form for Covariance {
    const SQUARE_ROOT: bool = false;
}

/// Square-root form: S with P = S Sᵀ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SquareRoot;

impl Form for SquareRoot {
    const SQUARE_ROOT: bool = true;
}

/// N(mean, P) in borrowed memory.
#[derive(Debug)]
pub struct Belief<'a, T> {
    /// Length n.
    pub mean: &'a mut [T],
    /// S with P = S Sᵀ, lower triangular n × n, diagonal ≥ 0.
    pub factor: &'a mut [T],
    /// P itself, n × n, in covariance form; empty in square-root form.
    pub cov: &'a mut [T],
    /// Another root of P, n × n, that the measurement update is to draw its points from; empty: `factor`.
    pub moved: &'a mut [T],
}

impl<T: Real> Belief<'_, T> {
    /// `to` = m + S a.
    #[inline(always)]
    pub(crate) fn advanced(&self, a: &[T], to: &mut [T]) {
        let n = self.mean.len();
        for (i, (to, &m)) in to.iter_mut().zip(&*self.mean).enumerate() {
            *to = m + dot(&self.factor[i * n..=i * n + i], a);
        }
    }
}
