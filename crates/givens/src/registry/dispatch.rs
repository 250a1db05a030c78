//! From the words of a choice to types: each filter is compiled once for all rules of points and all time updates of a kind
//! of model, whatever is done with it.

use super::choice::Choice;
use super::runtime::{AnyPoints, Parts};
use super::time::{AnyTime, LEVEL_SET_IN_COVARIANCE};
use super::words::{FormName, Kind, Precision, RuleName, TimeName};
use crate::filter::predict::{EulerMaruyama, ItoTaylor, LevelSet, MomentOde, OneTransition, TimeUpdate};
use crate::filter::{Covariance, Fault, SquareRoot};
use crate::model::{Sde, Transition};
use crate::rule::{Cubature3, Cubature5, Rule, RuleError, Taylor};
use crate::{Computes, Gated, Single, gate};

/// What is done with a method, once its parts are types.
pub(super) trait Job<M> {
    /// What comes of it.
    type Done;
    fn with<X: Computing<M>>(self, method: X) -> Self::Done;
}

/// A method as types, in either precision.
pub(super) trait Computing<M>:
    Computes<M, Method: Send + Sync + 'static> + Send + Sync + 'static
{
}

impl<M, X: Computes<M, Method: Send + Sync + 'static> + Send + Sync + 'static> Computing<M> for X {}

/// A method that is compiled for packs.
pub(super) enum Packed<U> {
    Points(Parts<AnyPoints, SquareRoot, U>),
    Taylor(Parts<Taylor, SquareRoot, U>),
}

impl Choice {
    /// What is wrong with the options for a model of `states` states, if anything.
    ///
    /// # Errors
    /// The option and its range.
    pub fn check(&self, states: usize) -> Result<(), RuleError> {
        if self.kind() == Kind::Continuous {
            self.integrator.check()?;
            self.integrator.resolves(self.precision.epsilon())?;
        }
        self.gate.map_or(Ok(()), gate::check)?;
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

    /// Does the job with a discrete method; a continuous one is refused.
    pub(super) fn discrete<M: Transition, J: Job<M>>(&self, job: J) -> Result<J::Done, Fault> {
        match self.time_update {
            TimeName::Transition => self.over(OneTransition, job),
            _ => Err(NOT_CONTINUOUS),
        }
    }

    /// Does the job with a continuous method; a discrete one is refused.
    pub(super) fn continuous<M: Sde, J: Job<M>>(&self, job: J) -> Result<J::Done, Fault> {
        match self.time() {
            None => Err(NOT_DISCRETE),
            Some(AnyTime::LevelSet(_)) if self.form == FormName::Covariance => Err(LEVEL_SET_IN_COVARIANCE),
            Some(time) => self.over(time, job),
        }
    }

    /// The time update of a method by Itô and Taylor.
    pub(super) fn ito_taylor(&self) -> Option<ItoTaylor> {
        match self.time() {
            Some(AnyTime::ItoTaylor(time)) => Some(time),
            _ => None,
        }
    }

    /// The method with this time update, if it is one of those that are compiled for packs.
    pub(super) fn packed<U: Copy>(&self, time: U) -> Option<Packed<U>> {
        match (self.form, self.rule) {
            (FormName::Covariance, _) | (_, RuleName::CentralDifference) => None,
            (_, RuleName::Taylor) => Some(Packed::Taylor(Parts::new(Taylor, self.block, time))),
            _ => Some(Packed::Points(Parts::new(self.points(), self.block, time))),
        }
    }

    fn over<M, J: Job<M>, U>(&self, time: U, job: J) -> Result<J::Done, Fault>
    where
        U: TimeUpdate<M> + Send + Sync + 'static,
    {
        match self.rule {
            RuleName::CentralDifference => self.with(self.central_difference, time, job),
            RuleName::Taylor => self.with(Taylor, time, job),
            _ => self.with(self.points(), time, job),
        }
    }

    fn with<M, J: Job<M>, R, U>(&self, rule: R, time: U, job: J) -> Result<J::Done, Fault>
    where
        R: Rule + Send + Sync + 'static,
        U: TimeUpdate<M> + Send + Sync + 'static,
    {
        let root = Parts::<R, SquareRoot, U>::new(rule, self.block, time);
        let covariance = Parts::<R, Covariance, U>::new(rule, self.block, time);
        let gate = self.gate;
        match (self.form, self.precision) {
            (FormName::Covariance, Precision::F64) => Ok(job.with(Gated { method: covariance, gate })),
            (FormName::Covariance, Precision::F32) => Err(SINGLE_IN_COVARIANCE),
            (FormName::SquareRoot, Precision::F64) => Ok(job.with(Gated { method: root, gate })),
            (FormName::SquareRoot, Precision::F32) => Ok(job.with(Gated { method: Single(root), gate })),
        }
    }
}

/// A variance has twice the digits of its root, and f32 too few of them: none is compiled.
const SINGLE_IN_COVARIANCE: Fault =
    Fault::Mismatch { why: "precision = f32 is for square roots; form = covariance is not for it" };
const NOT_CONTINUOUS: Fault =
    Fault::Mismatch { why: "the method is a continuous-time one, and the model is discrete" };
const NOT_DISCRETE: Fault =
    Fault::Mismatch { why: "the method is a discrete-time one, and the model is continuous" };
