//! A chosen method over a whole trajectory.

use super::choice::Choice;
use super::dispatch::Job;
use crate::Row;
use crate::filter::{Fault, Gaussian, Over, StepError};
use crate::model::{Observation, Sde, Transition};
use crate::run::{Goal, Outcome, run_at};

impl Choice {
    /// Runs a discrete method over a trajectory, `at` these times besides; see [`run_at()`]. A continuous one fails at the first row.
    pub fn run<'a, M: Transition, H: Observation>(
        &self,
        model: &M,
        sensors: &H,
        rows: impl Iterator<Item = Row<'a>> + Clone,
        t0: f64,
        prior: &Gaussian,
        goal: Goal,
        at: &[f64],
    ) -> Outcome {
        let span = Span { model, sensors, rows, t0, prior, goal, at };
        let refused = span.refused();
        self.discrete(span).unwrap_or_else(refused)
    }

    /// Runs a continuous method over a trajectory, `at` these times besides; see [`run_at()`]. A discrete one fails at the first row.
    pub fn run_continuous<'a, M: Sde, H: Observation>(
        &self,
        model: &M,
        sensors: &H,
        rows: impl Iterator<Item = Row<'a>> + Clone,
        t0: f64,
        prior: &Gaussian,
        goal: Goal,
        at: &[f64],
    ) -> Outcome {
        let span = Span { model, sensors, rows, t0, prior, goal, at };
        let refused = span.refused();
        self.continuous(span).unwrap_or_else(refused)
    }
}

/// What a method is run over.
struct Span<'s, M, H, I> {
    model: &'s M,
    sensors: &'s H,
    rows: I,
    t0: f64,
    prior: &'s Gaussian,
    goal: Goal,
    at: &'s [f64],
}

impl<M, H: Observation, I> Span<'_, M, H, I> {
    /// The outcome of a method that is not for this model.
    fn refused(&self) -> impl FnOnce(Fault) -> Outcome + use<M, H, I> {
        let (n, d, goal, time) = (self.prior.mean().len(), self.sensors.measures(), self.goal, self.t0);
        move |fault| {
            let mut outcome = Outcome::new(n, d, goal);
            outcome.failure = Some((0, StepError { fault, time, step: 0 }));
            outcome
        }
    }
}

impl<'a, M, H: Observation, I: Iterator<Item = Row<'a>> + Clone> Job<M> for Span<'_, M, H, I> {
    type Done = Outcome;
    fn with<X: Over<M> + Send + Sync + 'static>(self, method: X) -> Outcome {
        run_at(method, self.model, self.sensors, self.rows, self.t0, self.prior, self.goal, self.at)
    }
}
