//! A chosen method at work: each filter is compiled once for all rules of points and all time updates of a kind of model.

use super::choice::Choice;
use super::runtime::{AnyPoints, Parts};
use super::time::{AnyTime, LEVEL_SET_IN_COVARIANCE};
use super::words::{FormName, Kind, RuleName, TimeName};
use crate::Row;
use crate::filter::predict::{EulerMaruyama, ItoTaylor, LevelSet, MomentOde, OneTransition, TimeUpdate};
use crate::filter::{Covariance, Fault, Form, Gaussian, Over, SquareRoot, StepError};
use crate::model::{Observation, Sde, Transition};
use crate::rule::{Cubature3, Cubature5, Rule, RuleError, Taylor};
use crate::run::{Goal, Outcome, run_at};

impl Choice {
    /// What is wrong with the options for a model of `states` states, if anything.
    ///
    /// # Errors
    /// The option and its range.
    pub fn check(&self, states: usize) -> Result<(), RuleError> {
        if self.kind() == Kind::Continuous {
            self.integrator.check()?;
        }
        match self.rule {
            RuleName::CentralDifference => self.central_difference.check(states),
            RuleName::Taylor => Taylor.check(states),
            _ => Rule::check(&self.points(), states),
        }
    }

    /// Whether the time update serves this continuous model.
    ///
    /// # Errors
    /// What of the model, or of the options, it cannot serve.
    pub fn check_continuous<M: Sde>(&self, model: &M) -> Result<(), Fault> {
        match self.time() {
            None => Err(NOT_DISCRETE),
            Some(time) => time.check(model),
        }
    }

    fn points(&self) -> AnyPoints {
        match self.rule {
            RuleName::Cubature5 => AnyPoints::Cubature5(Cubature5),
            RuleName::Unscented => AnyPoints::Unscented(self.unscented),
            RuleName::GaussHermite => AnyPoints::GaussHermite(self.gauss_hermite),
            _ => AnyPoints::Cubature3(Cubature3),
        }
    }

    /// The time update of a continuous method.
    fn time(&self) -> Option<AnyTime> {
        let steps = self.integrator.steps;
        match self.time_update {
            TimeName::Transition => None,
            TimeName::ItoTaylor => Some(AnyTime::ItoTaylor(ItoTaylor { variant: self.variant, steps })),
            TimeName::EulerMaruyama => Some(AnyTime::EulerMaruyama(EulerMaruyama { steps })),
            TimeName::MomentOde => Some(AnyTime::MomentOde(MomentOde { integrator: self.integrator })),
            TimeName::LevelSet => Some(AnyTime::LevelSet(LevelSet {
                velocity: self.velocity,
                gauge: self.gauge,
                root: self.root,
                integrator: self.integrator,
            })),
        }
    }

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
        match self.time_update {
            TimeName::Transition => self.over(OneTransition, span),
            _ => span.refused(NOT_CONTINUOUS),
        }
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
        match self.time() {
            None => span.refused(NOT_DISCRETE),
            Some(AnyTime::LevelSet(_)) if self.form == FormName::Covariance => {
                span.refused(LEVEL_SET_IN_COVARIANCE)
            }
            Some(time) => self.over(time, span),
        }
    }

    /// By the rule and the form: each filter is compiled once for all rules of points.
    fn over<'a, U: TimeUpdate<M>, M, H, I>(&self, time: U, span: Span<M, H, I>) -> Outcome
    where
        H: Observation,
        I: Iterator<Item = Row<'a>> + Clone,
    {
        let form = self.form;
        match self.rule {
            RuleName::CentralDifference => self.with(self.central_difference, form, time, span),
            RuleName::Taylor => self.with(Taylor, form, time, span),
            _ => self.with(self.points(), form, time, span),
        }
    }

    fn with<'a, R: Rule, U: TimeUpdate<M>, M, H, I>(
        &self,
        rule: R,
        form: FormName,
        time: U,
        span: Span<M, H, I>,
    ) -> Outcome
    where
        H: Observation,
        I: Iterator<Item = Row<'a>> + Clone,
    {
        match form {
            FormName::Covariance => span.run(Parts::<R, Covariance, U>::new(rule, self.block, time)),
            FormName::SquareRoot => span.run(Parts::<R, SquareRoot, U>::new(rule, self.block, time)),
        }
    }
}

const NOT_CONTINUOUS: Fault =
    Fault::Mismatch { why: "the method is a continuous-time one, and the model is discrete" };
const NOT_DISCRETE: Fault =
    Fault::Mismatch { why: "the method is a discrete-time one, and the model is continuous" };

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

impl<'a, M, H: Observation, I: Iterator<Item = Row<'a>> + Clone> Span<'_, M, H, I> {
    fn run<R: Rule, F: Form, U: TimeUpdate<M>>(self, method: Parts<R, F, U>) -> Outcome
    where
        Parts<R, F, U>: Over<M>,
    {
        run_at(method, self.model, self.sensors, self.rows, self.t0, self.prior, self.goal, self.at)
    }

    fn refused(self, fault: Fault) -> Outcome {
        let mut outcome = Outcome::new(self.prior.mean().len(), self.sensors.measures(), self.goal);
        outcome.failure = Some((0, StepError { fault, time: self.t0, step: 0 }));
        outcome
    }
}
