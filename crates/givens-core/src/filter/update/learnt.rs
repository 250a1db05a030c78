//! What the measurement updates since the last prediction leave for the way back.

use super::posterior::Rows;
use crate::kernels::{plus_dot, product_lower};
use crate::scalar::Real;

/// x = m⁻ + S⁻ a before the updates and x = m + S u after them: a = shift + turn u (docs/algorithms.md S4). Empty in
/// covariance form, and in a filter that was not started for smoothing.
#[derive(Debug)]
pub struct Learnt<'a, T> {
    /// Length n.
    pub shift: &'a mut [T],
    /// n × n.
    pub turn: &'a mut [T],
}

impl<T: Real> Learnt<'_, T> {
    /// Nothing learnt: a = u.
    #[inline(always)]
    pub fn reset(&mut self, n: usize) {
        self.shift.fill(T::zero());
        for (i, x) in self.turn.iter_mut().enumerate() {
            *x = if i % (n + 1) == 0 { T::one() } else { T::zero() };
        }
    }

    /// Adds an update, after which a = `moved` + B u, B lower triangular: shift ← shift + turn `moved`, turn ← turn B.
    #[inline(always)]
    pub(super) fn add(&mut self, moved: &[T], b: Rows<T>) {
        let n = self.shift.len();
        for (shift, row) in self.shift.iter_mut().zip(self.turn.chunks_exact(n)) {
            *shift = plus_dot(*shift, row, moved);
        }
        product_lower(self.turn, n, n, b.of, b.stride);
    }
}
