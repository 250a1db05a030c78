//! A method over whole trajectories.

use givens::filter::Gaussian;
use givens::registry::Choice as Chosen;
use givens::{Data, Goal, Outcome, Stream};
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;

use crate::choice::Choice;
use crate::crowd::{Ended, aside, each, threads};
use crate::doubts::{self, Doubt};
use crate::errors::Result;
use crate::estimates::Estimates;
use crate::failure::noted;
use crate::listed::Listed;
use crate::memory::room_for_rows;
use crate::model::{Model, Moves};
use crate::numbers::numbers;
use crate::packs::{self, alike};
use crate::rows::{belief, goal, rows, times};
use crate::watch::{Watched, detached};

type Numbers<'py> = PyReadonlyArrayDyn<'py, f64>;

/// Rows from which a smoother's way back, which no signal ends, may take long.
const LONG: usize = 20_000;

/// One run, with all that it needs.
pub struct Job {
    pub model: Model,
    pub choice: Chosen,
    pub prior: Gaussian,
    pub data: Data,
    pub goal: Goal,
    /// Times asked for besides.
    pub at: Option<Vec<f64>>,
}

impl Job {
    fn new(
        model: &Model,
        choice: &Choice,
        (mean, cov, t0): (&Numbers<'_>, &Numbers<'_>, Option<f64>),
        (time, z, u): (&Numbers<'_>, &Numbers<'_>, Option<&Numbers<'_>>),
        (goal, value): (&str, Option<f64>),
        at: Option<&Numbers<'_>>,
    ) -> Result<Self> {
        model.serves(&choice.0)?;
        let prior = belief(model, mean, cov)?;
        let data = rows(model, t0, time, z, u)?;
        let goal = self::goal(goal, value, &numbers(time)?, data.start())?;
        let at = at.map(|at| times(at, data.start())).transpose()?;
        Ok(Self { model: model.clone(), choice: choice.0, prior, data, goal, at })
    }

    /// Bytes that all its estimates need.
    fn bytes(&self) -> usize {
        let each = Stream::bytes_per_row(self.goal, self.prior.mean().len(), self.data.measures());
        self.data.len().saturating_mul(each)
    }

    /// Runs on this thread.
    pub fn run(&self) -> Outcome {
        let Self { model, choice, prior, data, goal, at } = self;
        let (rows, t0, at) = (Watched(data.rows()), data.start(), at.as_deref().unwrap_or_default());
        let sensing = &model.sensing;
        match &model.moves {
            Moves::Discrete(moves) => choice.run(moves, sensing, rows, t0, prior, *goal, at),
            Moves::Continuous(moves) => choice.run_continuous(moves, sensing, rows, t0, prior, *goal, at),
        }
    }

    /// What came of it, with what is doubtful about it alone.
    fn estimates(&self, py: Python<'_>, outcome: Outcome) -> Result<Estimates> {
        let doubts = doubts::of(py, core::slice::from_ref(self), core::slice::from_ref(&outcome))?;
        Ok(self.with(py, outcome, doubts)?)
    }

    fn with(&self, py: Python<'_>, outcome: Outcome, doubts: Vec<Doubt>) -> PyResult<Estimates> {
        Estimates::of(py, outcome, doubts, (&self.model, &self.choice), self.at.is_some())
    }
}

/// Runs a method over the rows of one trajectory; see the stub.
#[pyfunction]
#[pyo3(signature = (model, choice, mean, cov, t0, time, z, u=None, goal="filter", goal_value=None, at=None))]
pub fn run(
    py: Python<'_>,
    model: &Model,
    choice: &Choice,
    mean: Numbers<'_>,
    cov: Numbers<'_>,
    t0: Option<f64>,
    time: Numbers<'_>,
    z: Numbers<'_>,
    u: Option<Numbers<'_>>,
    goal: &str,
    goal_value: Option<f64>,
    at: Option<Numbers<'_>>,
) -> Result<Estimates> {
    let data = (&time, &z, u.as_ref());
    let job = Job::new(model, choice, (&mean, &cov, t0), data, (goal, goal_value), at.as_ref())?;
    room_for_rows(py, job.data.len(), job.bytes())?;
    let goes_back = matches!(job.goal, Goal::Interval | Goal::Lag(_));
    if goes_back && job.data.len() >= LONG && !model.needs_python() {
        let (job, outcome) = aside(py, move || {
            let outcome = job.run();
            (job, outcome)
        })?;
        return job.estimates(py, outcome);
    }
    let (outcome, raised) = detached(py, || job.run());
    if let Some(raised) = raised {
        return Err(at_row(py, raised, outcome).into());
    }
    job.estimates(py, outcome)
}

/// Model, choice, mean, cov, t0, time, z, u, at.
type Track<'py> = (
    PyRef<'py, Model>,
    PyRef<'py, Choice>,
    Numbers<'py>,
    Numbers<'py>,
    Option<f64>,
    Numbers<'py>,
    Numbers<'py>,
    Option<Numbers<'py>>,
    Option<Numbers<'py>>,
);

/// Runs several trajectories on threads; see the stub.
#[pyfunction]
#[pyo3(signature = (tracks, goal="filter", goal_value=None, threads=None))]
pub fn run_batch<'py>(
    py: Python<'py>,
    tracks: Listed<Track<'py>>,
    goal: &str,
    goal_value: Option<f64>,
    threads: Option<usize>,
) -> Result<(Vec<Estimates>, Vec<Doubt>)> {
    let of = |(k, track): (usize, &Track<'py>)| {
        let (model, choice, mean, cov, t0, time, z, u, at) = track;
        let data = (time, z, u.as_ref());
        let job = Job::new(model, choice, (mean, cov, *t0), data, (goal, goal_value), at.as_ref());
        job.map_err(|refusal| in_track(py, k, refusal.into()))
    };
    let jobs = tracks.iter().enumerate().map(of).collect::<PyResult<Vec<Job>>>()?;
    drop(tracks);
    let rows = jobs.iter().map(|job| job.data.len()).sum();
    room_for_rows(py, rows, jobs.iter().fold(0, |sum: usize, job| sum.saturating_add(job.bytes())))?;
    // also of a single track: it is the same in any batch
    if alike(&jobs) {
        let outcomes = packs::run(py, &jobs, self::threads(threads)?)?;
        return together(py, &jobs, outcomes);
    }
    // one thread has the interpreter at a time: several would only wait for each other
    let alone = jobs.iter().any(|job| job.model.needs_python());
    let threads = self::threads(threads)?;
    let outcomes = each(py, jobs.len(), if alone { 1 } else { threads }, |k| jobs[k].run());
    let outcomes = outcomes.map_err(|Ended { raised, job }| match job {
        Some((k, outcome)) => in_track(py, k, at_row(py, raised, outcome)),
        None => raised,
    })?;
    together(py, &jobs, outcomes)
}

/// What came of several, and what is doubtful about them.
fn together(py: Python<'_>, jobs: &[Job], outcomes: Vec<Outcome>) -> Result<(Vec<Estimates>, Vec<Doubt>)> {
    let doubts = doubts::of(py, jobs, &outcomes)?;
    let all = jobs.iter().zip(outcomes).map(|(job, outcome)| job.with(py, outcome, Vec::new()));
    Ok((all.collect::<PyResult<Vec<_>>>()?, doubts))
}

/// Notes on an exception of the user's at which row it was raised.
fn at_row(py: Python<'_>, raised: PyErr, outcome: Outcome) -> PyErr {
    let (row, error) = outcome.failure.unzip();
    noted(py, raised, row, error.as_ref())
}

/// Notes on an exception which track it is about.
fn in_track(py: Python<'_>, track: usize, error: PyErr) -> PyErr {
    // an exception that takes no note is raised as it is
    let _ = error.add_note(py, format!("in track {track}"));
    error
}
