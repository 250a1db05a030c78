//! A method over a whole trajectory.

mod back;
mod between;
mod crossing;
mod goal;
mod own;
mod recorder;
mod sample;
mod task;
mod watch;

pub(crate) use between::Between;
pub(crate) use crossing::Crossing;
pub use goal::{Goal, Outcome};
pub(crate) use own::{OwnFilter, Start, of_kind, scatter, start_own};
pub(crate) use recorder::{Recorder, told, write_cov};
pub use sample::{Draws, Samples, sample};
pub(crate) use task::{Rows, Task};
pub(crate) use watch::Watch;

use crate::filter::{Gaussian, StepError};
use crate::model::Observation;
use crate::scalar::Shown;
use crate::{Computes, Data, Estimates, Row, gate};

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
pub fn filter<X: Computes<M>, M, H: Observation>(
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
pub fn smooth<X: Computes<M>, M, H: Observation>(
    method: &X,
    model: &M,
    sensors: &H,
    data: &Data,
    prior: &Gaussian,
) -> Result<Estimates, Failure> {
    run(*method, model, sensors, data.rows(), data.start(), prior, Goal::Interval).into_result()
}

/// Runs a method over rows in order of time, for any goal; `prior` holds at time `t0`.
pub fn run<'a, X: Computes<M>, M, H: Observation>(
    method: X,
    model: &M,
    sensors: &H,
    rows: impl Iterator<Item = Row<'a>>,
    t0: f64,
    prior: &Gaussian,
    goal: Goal,
) -> Outcome {
    run_at(method, model, sensors, rows, t0, prior, goal, &[])
}

/// Runs a method over rows as [`run()`] does, and gives the states at the times `at` besides ([`Outcome::at`]), for
/// [`Goal::Filter`] and [`Goal::Interval`]: also between the rows and after the last. The times increase, from `t0` on, and those of a
/// model with a fixed step are whole steps away from each row before. Those that are a row's are that row's estimate; the
/// others come from predictions beside the recursion over the rows, of which no number changes.
///
/// ```
/// use givens::filter::{Gaussian, SrCdCkf};
/// use givens::model::zoo::{Radar3d, Turn3d};
/// use givens::{Data, Goal, run_at};
///
/// let mut data = Data::new(3).starting_at(0.0);
/// data.push(6.0, &[2800.0, 1.2, 0.08])?;
/// let prior = Gaussian::from_std(&[1000.0, 0.0, 2000.0, 100.0, 200.0, 0.0, 0.0], &[200.0; 7])?;
/// let (turn, radar, method) = (Turn3d::default(), Radar3d::default(), SrCdCkf::default());
/// let at = [3.0, 6.0, 9.0];
/// let outcome = run_at(method, &turn, &radar, data.rows(), data.start(), &prior, Goal::Interval, &at);
/// assert_eq!((outcome.estimates.len(), outcome.at.time.as_slice()), (1, at.as_slice()));
/// assert_eq!(outcome.at.mean(1), outcome.estimates.mean(0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run_at<'a, X: Computes<M>, M, H: Observation>(
    method: X,
    model: &M,
    sensors: &H,
    rows: impl Iterator<Item = Row<'a>>,
    t0: f64,
    prior: &Gaussian,
    goal: Goal,
    at: &[f64],
) -> Outcome {
    let rows: Vec<Row> = rows.collect();
    let blank = || Outcome::new(prior.mean().len(), sensors.measures(), goal);
    let limits = match gate::limits(method.gate(), sensors.measures()) {
        Ok(limits) => limits,
        Err(fault) => {
            return Outcome { failure: Some((0, StepError { fault, time: t0, step: 0 })), ..blank() };
        }
    };
    run_until(method, model, sensors, &rows, t0, prior, &[], goal, &limits, at, Watch::default())
        .unwrap_or_else(blank)
}

/// [`run_at`] with parameters in place of the model's, if there are any, and the limits of a gate, that may be cancelled: then there is no outcome.
pub(crate) fn run_until<X: Computes<M>, M, H: Observation>(
    method: X,
    model: &M,
    sensors: &H,
    rows: &[Row],
    t0: f64,
    prior: &Gaussian,
    parameters: &[f64],
    goal: Goal,
    limits: &[f64],
    at: &[f64],
    watch: Watch,
) -> Option<Outcome> {
    let mut outcome = Outcome::new(prior.mean().len(), sensors.measures(), goal);
    let wanted = if matches!(goal, Goal::Filter | Goal::Interval) { at } else { &[] };
    let out = &outcome.estimates;
    let blank = Estimates::new(out.states(), out.measures(), out.is_smoothed());
    let between = Between::<X::Number>::new(wanted, blank);
    let task = Task { method: method.method(), model, sensors, parameters, goal, limits, watch };
    match Recorder::start(task, Start::Prior(t0, prior), rows.len(), between) {
        Ok(mut recorder) => {
            recorder.forward(&rows, 0..rows.len(), &mut outcome);
            recorder.beyond(&mut outcome);
            recorder.finish(&mut outcome, None);
        }
        Err(error) => outcome.failure = Some((0, error)),
    }
    if watch.stopped() { None } else { Some(outcome) }
}
