//! A system with everything it is evaluated with.

use super::{System, Why};
use crate::model::At;
use crate::scalar::{Inside, Mask, Real};

/// f as a function of t and y alone.
pub(super) struct Field<'a, S, T> {
    pub system: &'a S,
    pub u: &'a [T],
    pub p: &'a [T],
    pub table: &'a [T],
    /// The system's.
    pub scratch: &'a mut [T],
    /// Evaluations so far.
    pub calls: usize,
}

impl<S: System, T: Real> Field<'_, S, T> {
    /// f(t, y) to `dy`, a finite number in every component.
    #[inline(always)]
    pub fn slope(&mut self, t: T, y: &[T], dy: &mut [T]) -> Result<(), Failed<S::Fault>> {
        self.calls += 1;
        T::within(Slope { field: self, t, y, dy })
    }
}

/// The largest piece of an integration, asked for in many places and compiled once.
struct Slope<'s, 'f, S, T> {
    field: &'s mut Field<'f, S, T>,
    t: T,
    y: &'s [T],
    dy: &'s mut [T],
}

impl<S: System, T: Real> Slope<'_, '_, S, T> {
    #[inline(always)]
    fn evaluate(self) -> Result<(), Failed<S::Fault>> {
        let Field { system, u, p, table, scratch, .. } = self.field;
        let at = At { t: self.t, dt: T::zero(), u, p };
        system.derivative(&at, table, self.y, self.dy, scratch).map_err(Failed::System)?;
        finite(self.dy)
    }
}

impl<S: System, T: Real> Inside for Slope<'_, '_, S, T> {
    type Output = Result<(), Failed<S::Fault>>;
    #[inline(always)]
    fn go(self) -> Self::Output {
        self.evaluate()
    }
}

/// One step of a solver, and what it remembers of it. Slopes at the start and at the end of a step are kept apart, so
/// that the last of one step is the first of the next.
pub(super) trait Method<T: Real, S: System> {
    /// The power of the step at which the error estimate falls: one more than the order of the lesser formula.
    const ERROR_ORDER: i32;

    /// f at the start of the first step.
    fn start(&mut self, field: &mut Field<S, T>, t: T, y: &[T]) -> Result<(), Failed<S::Fault>>;
    /// The state after a step of `h` from (t, y) to `end`.
    fn step(
        &mut self,
        field: &mut Field<S, T>,
        t: T,
        h: T,
        y: &[T],
        end: &mut [T],
    ) -> Result<(), Failed<S::Fault>>;
    /// f at the end of a step.
    fn finish(&mut self, field: &mut Field<S, T>, t: T, end: &[T]) -> Result<(), Failed<S::Fault>>;
    /// The slopes at the start and at the end of the step.
    fn slopes(&self) -> (&[T], &[T]);
    /// The estimated error of the step; wants the slope at the end.
    fn error(&self, h: T, error: &mut [T]);
    /// The three vectors of [`Segment`](super::Segment); `ended`: the slope at the end exists.
    fn curve(&self, h: T, y: &[T], end: &[T], ended: bool, curve: &mut [T]);
    /// The end becomes the start of the next step.
    fn accept(&mut self);
}

/// Why a step gave nothing.
#[derive(Clone, Copy, Debug)]
pub(super) enum Failed<F> {
    /// The system's reason.
    System(F),
    /// A component that is no finite number.
    NotFinite(usize),
    /// A linear system without a solution at this length of step.
    Singular,
}

impl<F> From<Failed<F>> for Why<F> {
    fn from(failed: Failed<F>) -> Self {
        match failed {
            Failed::System(fault) => Why::System(fault),
            Failed::NotFinite(component) => Why::NotFinite { component },
            Failed::Singular => Why::StepTooSmall,
        }
    }
}

/// Refuses what is not finite in any lane.
#[inline(always)]
pub(super) fn finite<T: Real, F>(values: &[T]) -> Result<(), Failed<F>> {
    let wrong = values.iter().position(|value| (!value.finite()).all());
    wrong.map_or(Ok(()), |component| Err(Failed::NotFinite(component)))
}
