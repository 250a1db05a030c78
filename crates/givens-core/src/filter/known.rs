//! What a filter knows, read out of its memory.

use super::error::{Fault, StepError};
use super::form::Form;
use super::layout::Layout;
use super::methods::Method;
use super::sizes::Sizes;
use super::stepper::Filter;
use super::update::Innovation;
use crate::ode::Work;
use crate::rule::Shape;
use crate::scalar::Real;

impl<X: Method, M, T: Real, B: AsRef<[T]>> Filter<'_, X, M, T, B> {
    /// Where an array that stands `skip` scalars behind the belief's beginning stands.
    #[inline(always)]
    fn array(&self, skip: usize, len: usize) -> &[T] {
        let Layout { shape, sizes, .. } = self.layout;
        let before = self.layout.moved_len()
            + self.layout.kept
            + shape.table
            + sizes.controls
            + sizes.parameters
            + 3 * sizes.states;
        let at = before + skip;
        &self.memory.as_ref()[at..at + len]
    }

    /// A failure at the present time.
    pub(crate) fn fail(&self, fault: Fault) -> StepError {
        StepError { fault, time: self.time, step: self.step }
    }

    /// What the solvers of its predictions have done so far: calls of the drift's moments, steps accepted and rejected.
    pub fn work(&self) -> Work {
        self.work
    }

    /// The time at which the belief holds.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Number of controls.
    pub fn controls(&self) -> usize {
        self.layout.sizes.controls
    }

    /// The state estimate, length n.
    #[inline(always)]
    pub fn mean(&self) -> &[T] {
        self.array(0, self.layout.sizes.states)
    }

    /// S with P = S Sᵀ, lower triangular n × n, diagonal ≥ 0.
    #[inline(always)]
    pub fn factor(&self) -> &[T] {
        let n = self.layout.sizes.states;
        self.array(n, n * n)
    }

    /// Writes P, n × n: the filter's own in covariance form, S Sᵀ in square-root form.
    #[inline(always)]
    pub fn write_cov(&self, cov: &mut [T]) {
        let n = self.layout.sizes.states;
        if X::Form::SQUARE_ROOT {
            crate::kernels::square_lower(cov, n, self.factor());
        } else {
            cov[..n * n].copy_from_slice(self.own_cov());
        }
    }

    /// P itself, n × n, in covariance form; empty in square-root form.
    #[inline(always)]
    pub(super) fn own_cov(&self) -> &[T] {
        let n = self.layout.sizes.states;
        self.array(n + n * n, if X::Form::SQUARE_ROOT { 0 } else { n * n })
    }

    /// P, n × n, in memory of its own.
    #[cfg(feature = "alloc")]
    pub fn cov(&self) -> alloc::vec::Vec<T> {
        let mut cov = alloc::vec![T::zero(); self.layout.sizes.states.pow(2)];
        self.write_cov(&mut cov);
        cov
    }

    /// Scalars of Ω or G, and of Γ.
    #[inline(always)]
    fn back_len(&self) -> (usize, usize) {
        let n = self.layout.sizes.states;
        let square = if self.layout.smoothing { n * n } else { 0 };
        (square, if X::Form::SQUARE_ROOT { square } else { 0 })
    }

    /// Of the last prediction, what a smoother needs, over all steps of its gap, both n × n: Ω and Γ in square-root form,
    /// the gain G alone in covariance form (see [`Backward`](super::Backward)). Empty unless the filter was started for
    /// smoothing.
    #[inline(always)]
    pub fn backward(&self) -> (&[T], &[T]) {
        let (n, (square, root)) = (self.layout.sizes.states, self.back_len());
        let belief = if X::Form::SQUARE_ROOT { n + n * n } else { n + 2 * n * n };
        (self.array(belief, square), self.array(belief + square, root))
    }

    /// Of the updates since the last prediction, what a smoother needs: shift, of length n, and turn, n × n (see
    /// [`Learnt`](super::Learnt)). Empty in covariance form, and unless the filter was started for smoothing.
    #[inline(always)]
    pub fn learnt(&self) -> (&[T], &[T]) {
        let (n, (square, root)) = (self.layout.sizes.states, self.back_len());
        let at = if X::Form::SQUARE_ROOT { n + n * n } else { n + 2 * n * n } + 2 * (square + root);
        let shift = if root > 0 { n } else { 0 };
        (self.array(at, shift), self.array(at + shift, root))
    }

    /// What the last measurement said; empty before the first and after an error.
    #[inline(always)]
    pub fn innovation(&self) -> Innovation<'_, T> {
        let Sizes { states: n, measures: d, .. } = self.layout.sizes;
        let (square, root) = self.back_len();
        let belief = if X::Form::SQUARE_ROOT { n + n * n } else { n + 2 * n * n };
        let learnt = if root > 0 { n + root } else { 0 };
        let at = belief + 2 * (square + root) + learnt + d;
        let of = |skip: usize, len: usize| self.array(at + skip, len);
        let k = self.present;
        let scores = of(3 * d + d * d, 2);
        Innovation {
            predicted: of(0, k),
            nu: of(d, k),
            factor: of(2 * d, k * k),
            white: of(2 * d + d * d, k),
            nis: scores[0],
            log_likelihood: scores[1],
        }
    }

    /// How often it was predicted, or a smoother has taken what it has learnt, and its time.
    pub(crate) fn moves(&self) -> (usize, f64) {
        (self.moves, self.time)
    }

    /// The shape of the filter's rule, for [`Sizes::with_sensor`].
    pub fn shape(&self) -> Shape {
        self.layout.shape
    }
}
