//! Time updates: how a belief moves from one time to a later one.

mod columns;
mod continuous;
#[cfg(test)]
mod derivatives;
mod euler_maruyama;
mod front;
mod gain;
mod image;
mod integrate;
mod ito_taylor;
mod level_set;
mod moment_ode;
mod moments;
mod noise;
mod packed;
mod settle;
mod transition;
mod velocity;

pub use super::backward::{Backward, accumulate};
pub use euler_maruyama::EulerMaruyama;
pub use ito_taylor::{ItoTaylor, Variant};
pub use level_set::{Gauge, LevelSet, Root};
pub use moment_ode::MomentOde;
pub use transition::OneTransition;
pub use velocity::Velocity;

use super::error::Fault;
use super::form::{Belief, Form};
use super::sizes::Sizes;
use crate::model::At;
use crate::ode::Work;
use crate::rule::{Rule, Shape};
use crate::scalar::Real;

/// What a step of a time update works with.
#[derive(Debug)]
pub struct Given<'a, T, M, R> {
    /// The rule, and its table of nodes and weights.
    pub rule: &'a R,
    /// See [`Rule::tabulate`].
    pub table: &'a [T],
    /// The model.
    pub model: &'a M,
    /// Time at the start of the step, its length, controls and parameters.
    pub at: At<'a, T>,
    /// Whether the scratch is as the step before left it, one over the same gap: with the same controls and parameters.
    pub again: bool,
    /// [`TimeUpdate::kept`] scalars, as the step before has left them, or zero.
    pub kept: &'a mut [T],
}

/// A gap in time, divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Number of steps; the belief stays where the last successful one has left it.
    pub count: usize,
    /// Length of each.
    pub dt: f64,
}

/// A step that did not succeed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopped {
    /// The time it had reached, if it is not the start of the step.
    pub reached: Option<f64>,
    /// Why it went no further.
    pub fault: Fault,
}

impl From<Fault> for Stopped {
    fn from(fault: Fault) -> Self {
        Self { reached: None, fault }
    }
}

/// A time update, plain data: how a belief moves over models of type `M`.
pub trait TimeUpdate<M>: Copy {
    /// What of the options, or of the model, this time update cannot serve.
    ///
    /// # Errors
    /// An option out of its range, a model with a property that the method excludes.
    fn check(&self, model: &M) -> Result<(), Fault>;

    /// Whether numbers of this relative spacing can keep what the options ask for.
    ///
    /// # Errors
    /// The option that they cannot keep.
    fn resolves(&self, epsilon: f64) -> Result<(), Fault> {
        let _ = epsilon;
        Ok(())
    }

    /// Length n of the model's state.
    fn states(&self, model: &M) -> usize;

    /// The model's sizes, for a rule of that shape; no measures yet.
    fn sizes(&self, model: &M, shape: Shape) -> Sizes;

    /// What the model does at the initial belief that it says it does not; `scratch` is a step's.
    ///
    /// # Errors
    /// What it does.
    fn probe<T: Real>(&self, model: &M, at: &At<T>, mean: &[T], scratch: &mut [T]) -> Result<(), Fault> {
        let _ = (model, at, mean, scratch);
        Ok(())
    }

    /// The model's parameters.
    fn parameters<'m>(&self, model: &'m M) -> &'m [f64];

    /// Scalars of scratch that a step needs.
    fn scratch(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> usize;

    /// Scalars that stay as a step has left them, for what it need not work out again.
    fn kept(&self, sizes: Sizes) -> usize {
        let _ = sizes;
        0
    }

    /// Divides the gap between two times into steps.
    ///
    /// # Errors
    /// A gap that the model has no steps for.
    fn plan(&self, model: &M, from: f64, to: f64) -> Result<Plan, Fault>;

    /// Whether the lanes of a pack may go over a gap together: no step is chosen by the numbers of one of them. With
    /// `smoothing`, also back again.
    fn lockstep(&self, smoothing: bool) -> bool;

    /// Whether a step leaves a root of its own, [`Belief::moved`], for the measurement update.
    fn moves_root(&self) -> bool {
        false
    }

    /// Moves `belief` over one step; with `back`, also what a smoother needs to come back over it. After a fault the
    /// belief is as before.
    ///
    /// # Errors
    /// Why the step could not be done.
    fn step<T: Real, R: Rule, F: Form>(
        &self,
        given: &mut Given<T, M, R>,
        belief: &mut Belief<T>,
        back: Option<&mut Backward<T>>,
        work: &mut Work,
        scratch: &mut [T],
    ) -> Result<T::Mask, Stopped>;
}
