//! Whole trajectories, drawn jointly from what the smoother knows of them.

use super::between::Between;
use super::goal::{Goal, Outcome};
use super::own::Start;
use super::recorder::{Recorder, told};
use super::task::Task;
use super::watch::Watch;
use crate::filter::{Gaussian, Over, StepError};
use crate::model::Observation;
use crate::scalar::Real;
use crate::simulate::Stream;
use crate::{Computes, Estimates, Failure, Row, gate};

/// How many trajectories to draw, and by which random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draws {
    /// How many.
    pub count: u32,
    /// Draw i has a [stream](Stream) of its own, keyed by this seed, the track and i: it is the same however many there are.
    pub seed: u64,
    /// Which track.
    pub track: u32,
}

/// Trajectories drawn by [`sample`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    states: usize,
    /// Time of every row.
    pub time: Vec<f64>,
    /// The states, draws × rows × n.
    pub x: Vec<f64>,
}

impl Samples {
    /// Length n of the state.
    pub fn states(&self) -> usize {
        self.states
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.time.len()
    }

    /// Number of draws; none without rows.
    pub fn len(&self) -> usize {
        self.x.len() / (self.rows() * self.states).max(1)
    }

    /// No draws.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// One trajectory, rows × n.
    pub fn trajectory(&self, draw: usize) -> &[f64] {
        let len = self.rows() * self.states;
        &self.x[draw * len..(draw + 1) * len]
    }

    /// The state of one trajectory at a row, length n.
    pub fn state(&self, draw: usize, row: usize) -> &[f64] {
        &self.trajectory(draw)[row * self.states..(row + 1) * self.states]
    }
}

/// Draws trajectories through the rows from the joint distribution of all their states given all measurements, by
/// backward simulation (docs/algorithms.md S7); `prior` holds at time `t0`. Several sensors are a tuple.
///
/// The mean and covariance of the draws at a row are those of [`smooth`](crate::smooth), and states at different rows go
/// together: what is asked of a whole trajectory (a distance flown, a highest point, whether a line was crossed) is
/// answered by asking each draw.
///
/// ```
/// use givens::filter::{Gaussian, SrCkf};
/// use givens::model::zoo::{CoordinatedTurn, RangeBearing};
/// use givens::{Data, Draws, sample};
///
/// let mut data = Data::new(2).starting_at(0.0);
/// data.push(1.0, &[1640.0, 0.65])?;
/// data.push(2.0, &[1890.0, 0.56])?;
/// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
/// let (turn, radar, draws) =
///     (CoordinatedTurn::default(), RangeBearing::published(), Draws { count: 100, seed: 1, track: 0 });
/// let drawn = sample(SrCkf::default(), &turn, &radar, data.rows(), data.start(), &prior, draws)?;
/// // how far east it has come from one row to the next
/// let moved = (0..drawn.len()).map(|i| drawn.state(i, 1)[0] - drawn.state(i, 0)[0]);
/// assert!((moved.sum::<f64>() / 100.0 - 300.0).abs() < 10.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The first step that fails, with the filtered rows before it. In covariance form that may be one of the way back: a
/// covariance of a state given the next one that is not positive semidefinite.
pub fn sample<'a, X: Computes<M>, M, H: Observation>(
    method: X,
    model: &M,
    sensors: &H,
    rows: impl Iterator<Item = Row<'a>>,
    t0: f64,
    prior: &Gaussian,
    draws: Draws,
) -> Result<Samples, Failure> {
    let rows: Vec<Row> = rows.collect();
    let (n, d, count) = (prior.mean().len(), sensors.measures(), rows.len());
    let mut outcome = Outcome::new(n, d, Goal::Interval);
    let between = Between::<X::Number>::new(&[], Estimates::new(n, d, true));
    let limits = gate::limits(method.gate(), d).map_err(|fault| StepError { fault, time: t0, step: 0 });
    let (method, watch) = (method.method(), Watch::default());
    let started = limits.as_ref().map_err(|&error| error).and_then(|limits| {
        let task = Task { method, model, sensors, parameters: &[], goal: Goal::Interval, limits, watch };
        Recorder::start(task, Start::Prior(t0, prior), count, between)
    });
    let drawn = started.map_err(|error| (0, error)).and_then(|mut recorder| {
        recorder.forward(&rows.as_slice(), 0..count, &mut outcome);
        match outcome.failure {
            Some(failure) => Err(failure),
            None => recorder.draw(&outcome.estimates, draws),
        }
    });
    drawn.map_err(|(row, error)| Failure {
        row,
        error,
        mean: outcome.failed_at,
        finished: Box::new(outcome.estimates),
    })
}

impl<X: Over<M>, M, H: Observation, T: Real> Recorder<'_, '_, X, M, H, T> {
    /// Draws over all rows, which none has failed.
    fn draw(&mut self, est: &Estimates, draws: Draws) -> Result<Samples, (usize, StepError)> {
        let (n, rows) = (est.states(), est.len());
        let Some(last) = rows.checked_sub(1) else {
            return Ok(Samples { states: n, ..Samples::default() });
        };
        let mut streams: Vec<Stream> =
            (0..draws.count).map(|run| Stream::beyond(draws.seed, draws.track, run)).collect();
        let mut x = vec![0.0; streams.len() * rows * n];
        let mut at_work = vec![T::zero(); streams.len() * n];
        let (filter, history) = (&self.filter, &mut self.history);
        let put = |age: usize, draw: usize, state: &[T]| {
            let row = draw * rows + last - age;
            x[row * n..(row + 1) * n].iter_mut().zip(told(state)).for_each(|(to, x)| *to = x);
        };
        let done = history.sample(filter, last, &mut at_work, |draw| T::of(streams[draw].normal()), put);
        done.map_err(|error| {
            let row = error.step.saturating_sub(1).min(last);
            (row, StepError { time: est.time[row], ..error })
        })?;
        Ok(Samples { states: n, time: est.time.clone(), x })
    }
}
