//! A chosen method over a whole trajectory.

use super::choice::Choice;
use super::dispatch::{Computing, Job};
use crate::filter::{Fault, Gaussian, StepError};
use crate::model::{AnyObservation, AnySde, AnyTransition, Observation, Sde, Transition};
use crate::run::{Goal, Outcome};
use crate::{Row, run_at};

impl Choice {
    /// Runs a discrete method over a trajectory, `at` these times besides; see [`run_at`](crate::run_at). A continuous one fails at the first row.
    pub fn run<'a, M: Transition + Sync, H: Observation + Sync>(
        &self,
        model: &M,
        sensors: &H,
        rows: impl Iterator<Item = Row<'a>>,
        t0: f64,
        prior: &Gaussian,
        goal: Goal,
        at: &[f64],
    ) -> Outcome {
        let rows: Vec<Row> = rows.collect();
        let (model, sensors) = (&AnyTransition::new(model), &AnyObservation::new(sensors));
        self.run_any(Span { model, sensors, rows: &rows, t0, prior, goal, at })
    }

    /// Runs a continuous method over a trajectory, `at` these times besides; see [`run_at`](crate::run_at). A discrete one fails at the first row.
    pub fn run_continuous<'a, M: Sde + Sync, H: Observation + Sync>(
        &self,
        model: &M,
        sensors: &H,
        rows: impl Iterator<Item = Row<'a>>,
        t0: f64,
        prior: &Gaussian,
        goal: Goal,
        at: &[f64],
    ) -> Outcome {
        let rows: Vec<Row> = rows.collect();
        let (model, sensors) = (&AnySde::new(model), &AnyObservation::new(sensors));
        self.run_any_continuous(Span { model, sensors, rows: &rows, t0, prior, goal, at })
    }

    // not generic: every filter of run time is compiled here, once

    fn run_any(&self, span: Span<AnyTransition>) -> Outcome {
        let refused = span.refused();
        self.discrete(span).unwrap_or_else(refused)
    }

    fn run_any_continuous(&self, span: Span<AnySde>) -> Outcome {
        let refused = span.refused();
        self.continuous(span).unwrap_or_else(refused)
    }
}

/// What a method is run over.
struct Span<'s, M> {
    model: &'s M,
    sensors: &'s AnyObservation<'s>,
    rows: &'s [Row<'s>],
    t0: f64,
    prior: &'s Gaussian,
    goal: Goal,
    at: &'s [f64],
}

impl<M> Span<'_, M> {
    /// The outcome of a method that is not for this model.
    fn refused(&self) -> impl FnOnce(Fault) -> Outcome + use<M> {
        let (n, d, goal, time) = (self.prior.mean().len(), self.sensors.measures(), self.goal, self.t0);
        move |fault| {
            let mut outcome = Outcome::new(n, d, goal);
            outcome.failure = Some((0, StepError { fault, time, step: 0 }));
            outcome
        }
    }
}

impl<M> Job<M> for Span<'_, M> {
    type Done = Outcome;
    fn with<X: Computing<M>>(self, method: X) -> Outcome {
        let Span { model, sensors, rows, t0, prior, goal, at } = self;
        run_at(method, model, sensors, rows.iter().copied(), t0, prior, goal, at)
    }
}
