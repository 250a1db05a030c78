//! A method over a whole trajectory.

mod goal;
mod recorder;

pub use goal::{Goal, Outcome};

use crate::filter::{Gaussian, Over, StepError};
use crate::model::Observation;
use crate::scalar::Shown;
use crate::{Data, Estimates, Row};

/// A run that stopped in the middle: what it had finished, and why it went no further.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The row at which it stopped, from zero.
    pub row: usize,
    /// What went wrong.
    pub error: StepError,
    /// The mean from which the failed step set out, length n; empty if none began.
    pub mean: Vec<f64>,
    /// The rows before.
    pub finished: Box<Estimates>,
}

impl core::fmt::Display for Failure {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "row {}, t = {}: {}", self.row, Shown(self.error.time), self.error.fault)
    }
}

impl core::error::Error for Failure {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.error)
    }
}

/// Filters a trajectory; `prior` holds at [`Data::start`]. Several sensors are a tuple.
///
/// # Errors
/// The first step that fails, with all rows before it.
pub fn filter<X: Over<M>, M, H: Observation>(
    method: &X,
    model: &M,
    sensors: &H,
    data: &Data,
    prior: &Gaussian,
) -> Result<Estimates, Failure> {
    run(*method, model, sensors, data.rows(), data.start(), prior, Goal::Filter).into_result()
}

/// Smooths a trajectory over all of its rows; `prior` holds at [`Data::start`]. Several sensors are a tuple.
///
/// # Errors
/// The first step that fails, with the rows before it, smoothed among themselves.
pub fn smooth<X: Over<M>, M, H: Observation>(
    method: &X,
    model: &M,
    sensors: &H,
    data: &Data,
    prior: &Gaussian,
) -> Result<Estimates, Failure> {
    run(*method, model, sensors, data.rows(), data.start(), prior, Goal::Interval).into_result()
}

/// Runs a method over rows in order of time, for any goal; `prior` holds at time `t0`.
pub fn run<'a, X: Over<M>, M, H: Observation>(
    method: X,
    model: &M,
    sensors: &H,
    rows: impl Iterator<Item = Row<'a>> + Clone,
    t0: f64,
    prior: &Gaussian,
    goal: Goal,
) -> Outcome {
    let mut outcome = Outcome::new(prior.mean().len(), sensors.measures(), goal);
    recorder::record(method, model, sensors, rows, t0, prior, &mut outcome, goal);
    outcome
}
