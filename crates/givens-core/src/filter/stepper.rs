//! A filter in motion: its memory, its start, and what it knows.

use super::backward::Backward;
use super::error::{Fault, StepError};
use super::fits::fits;
use super::form::{Belief, Form};
use super::layout::Layout;
use super::memory::take;
use super::methods::Over;
use super::predict::TimeUpdate;
use super::quantity::Quantity;
use super::sizes::{Sizes, countable};
use super::update::Learnt;
use crate::ode::Work;
use crate::rule::Rule;
use crate::scalar::Real;
use core::marker::PhantomData;

/// A filter in motion: the belief about the state at one time, moved by predictions and taught by measurements.
///
/// ```
/// use givens_core::filter::{Gaussian, Method, SrCkf};
/// use givens_core::model::zoo::{CoordinatedTurn, RangeBearing};
///
/// let (model, radar) = (CoordinatedTurn::default(), RangeBearing::published());
/// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
/// let mut f = SrCkf::default().start(&model, 0.0, prior)?;
/// f.predict(1.0)?;
/// f.update(&radar, &[1640.0, 0.65])?;
/// assert!((f.mean()[0] - 1300.0).abs() < 20.0 && f.innovation().nis < 9.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Filter<'m, X, M, T, B> {
    pub(super) method: X,
    pub(super) model: &'m M,
    pub(super) layout: Layout,
    pub(super) time: f64,
    pub(super) step: usize,
    /// Components of the last measurement that were there.
    pub(super) present: usize,
    /// Whether the controls are known: there are none, or they were set.
    pub(super) controlled: bool,
    pub(super) work: Work,
    /// The last step was a prediction that left a root of its own for the update.
    pub(super) moved: bool,
    /// How often it was predicted, or what it has learnt was taken: a smoother that has missed one must not go on.
    pub(super) moves: usize,
    pub(super) memory: B,
    pub(super) scalar: PhantomData<T>,
}

impl<X: Clone, M, T, B: Clone> Clone for Filter<'_, X, M, T, B> {
    fn clone(&self) -> Self {
        Self { method: self.method.clone(), memory: self.memory.clone(), ..*self }
    }
}

/// The arrays of a filter.
pub(super) struct Parts<'a, T> {
    /// What predictions leave for the next one.
    pub kept: &'a mut [T],
    pub table: &'a mut [T],
    pub u: &'a mut [T],
    pub p: &'a mut [T],
    /// What of each standard deviation may be rounding that an update without noise has left, length n.
    pub floor: &'a mut [T],
    /// Means and standard deviations before an update, length 2 n.
    pub before: &'a mut [T],
    pub belief: Belief<'a, T>,
    pub total: Backward<'a, T>,
    pub later: Backward<'a, T>,
    pub learnt: Learnt<'a, T>,
    pub measured: &'a mut [T],
    pub predicted: &'a mut [T],
    pub nu: &'a mut [T],
    pub factor: &'a mut [T],
    pub white: &'a mut [T],
    pub scores: &'a mut [T],
    pub scratch: &'a mut [T],
}

/// Carves the memory. The arrays that depend on the measurement's length stand last, so that the others stay where
/// they are when the memory grows for a longer one.
#[inline(always)]
pub(super) fn parts<'a, T, F: Form>(layout: &Layout, mut memory: &'a mut [T]) -> Parts<'a, T> {
    let Sizes { states: n, measures: d, .. } = layout.sizes;
    let m = &mut memory;
    let square = if layout.smoothing { n * n } else { 0 };
    let root = if F::SQUARE_ROOT { square } else { 0 };
    let moved = take(m, layout.moved_len());
    Parts {
        kept: take(m, layout.kept),
        table: take(m, layout.shape.table),
        u: take(m, layout.sizes.controls),
        p: take(m, layout.sizes.parameters),
        floor: take(m, n),
        before: take(m, 2 * n),
        belief: Belief {
            mean: take(m, n),
            factor: take(m, n * n),
            cov: take(m, if F::SQUARE_ROOT { 0 } else { n * n }),
            moved,
        },
        total: Backward { gain: take(m, square), conditional: take(m, root) },
        later: Backward { gain: take(m, square), conditional: take(m, root) },
        learnt: Learnt { shift: take(m, if root > 0 { n } else { 0 }), turn: take(m, root) },
        measured: take(m, d),
        predicted: take(m, d),
        nu: take(m, d),
        factor: take(m, d * d),
        white: take(m, d),
        scores: take(m, 2),
        scratch: core::mem::take(m),
    }
}

/// The layout of a method's memory.
pub(super) fn layout<X: Over<M>, M>(method: &X, sizes: Sizes, smoothing: bool) -> Layout {
    let shape = method.rule().shape(sizes.states);
    let predict =
        if countable(sizes, shape) { method.time_update().scratch(sizes, shape, smoothing) } else { 0 };
    let layout = Layout::new(sizes, shape, smoothing, predict);
    let layout = layout.keeping(method.time_update().kept(sizes));
    if method.time_update().moves_root() { layout.with_moved_root() } else { layout }
}

impl<X: Over<M>, M, T: Real, B: AsMut<[T]>> Filter<'_, X, M, T, B> {
    /// Scalars of memory that a filter of these sizes needs; `memory` of a method's type is the same as a constant.
    #[must_use]
    pub fn memory_len(method: &X, sizes: Sizes, smoothing: bool) -> usize {
        layout::<X, M>(method, sizes, smoothing).len
    }

    #[inline(always)]
    pub(super) fn parts(&mut self) -> Parts<'_, T> {
        parts::<T, X::Form>(&self.layout, self.memory.as_mut())
    }

    /// The same arrays for a step, their lengths from the types of method and model: where these tell them as constants,
    /// the compiler unrolls what is done with them, and no bound is left to be checked.
    ///
    /// # Errors
    /// A model that has changed its length.
    #[inline(always)]
    pub(super) fn known_parts(&mut self) -> Result<Parts<'_, T>, Fault> {
        let (of, expected) = ("the model's state", self.layout.sizes.states);
        let n = self.method.time_update().states(self.model);
        let shape = self.method.rule().shape(n);
        if n != expected || shape != self.layout.shape {
            return Err(Fault::Length { of, expected, found: n });
        }
        let sizes = Sizes { states: n, ..self.layout.sizes };
        let (moved, kept) = (self.method.time_update().moves_root(), self.method.time_update().kept(sizes));
        Ok(parts::<T, X::Form>(&Layout { sizes, shape, moved, kept, ..self.layout }, self.memory.as_mut()))
    }

    /// Sets the controls, which hold until they are set again. A model that has some neither predicts nor is measured by
    /// them before.
    ///
    /// # Errors
    /// A wrong number of them, or one that is not finite, or beyond the range of `T`.
    pub fn set_controls(&mut self, u: &[f64]) -> Result<(), StepError> {
        let (time, step) = (self.time, self.step);
        set(self.parts().u, u, "controls", Quantity::Control).map_err(|fault| StepError {
            fault,
            time,
            step,
        })?;
        self.controlled = true;
        Ok(())
    }

    /// Sets the parameters, in place of the model's own.
    ///
    /// # Errors
    /// A wrong number of them, or one that is not finite, or beyond the range of `T`.
    pub fn set_parameters(&mut self, p: &[f64]) -> Result<(), StepError> {
        let (time, step) = (self.time, self.step);
        set(self.parts().p, p, "parameters", Quantity::Parameter).map_err(|fault| StepError {
            fault,
            time,
            step,
        })
    }
}

pub(super) fn set<T: Real>(
    to: &mut [T],
    from: &[f64],
    of: &'static str,
    quantity: Quantity,
) -> Result<(), Fault> {
    if to.len() != from.len() {
        return Err(Fault::Length { of, expected: to.len(), found: from.len() });
    }
    if let Some(component) = from.iter().position(|x| !x.is_finite()) {
        return Err(Fault::NotFinite { quantity, component });
    }
    fits::<T>(from, quantity)?;
    to.iter_mut().zip(from).for_each(|(to, &x)| *to = T::of(x));
    Ok(())
}
