//! What is streamed, with the method behind a pointer: all that goes over rows in portions is compiled once.

use super::source::{Source, Stretch};
use crate::Estimates;
use crate::filter::Gaussian;
use crate::filter::{Over, Snapshot, StepError};
use crate::model::Observation;
use crate::run::{Between, Crossing, Goal, Outcome, Recorder, Rows, Start, Task, Watch, of_kind};
use crate::scalar::Real;
use core::ops::Range;
use core::sync::atomic::{AtomicBool, Ordering};

/// A recorder at work on rows of a trajectory.
pub(super) trait Recording {
    fn forward(&mut self, rows: &Stretch, range: Range<usize>, outcome: &mut Outcome);
    fn beyond(&mut self, outcome: &mut Outcome);
    fn cut(&mut self, outcome: &mut Outcome, keep: usize) -> (Estimates, Estimates);
    fn finish(&mut self, outcome: &mut Outcome, from: Option<Crossing<f64>>) -> Option<Crossing<f64>>;
    fn snapshot(&self) -> Snapshot;
    /// Rows of the data up to the last one that was finished.
    fn finished(&self) -> usize;
}

impl<X: Over<M>, M, H: Observation, T: Real> Recording for Recorder<'_, '_, X, M, H, T> {
    fn forward(&mut self, rows: &Stretch, range: Range<usize>, outcome: &mut Outcome) {
        self.forward(rows, range, outcome);
    }
    fn beyond(&mut self, outcome: &mut Outcome) {
        self.beyond(outcome);
    }
    fn cut(&mut self, outcome: &mut Outcome, keep: usize) -> (Estimates, Estimates) {
        self.cut(outcome, keep)
    }
    fn finish(&mut self, outcome: &mut Outcome, from: Option<Crossing<f64>>) -> Option<Crossing<f64>> {
        self.finish(outcome, from.map(|from| from.of_kind())).map(|first| first.of_kind())
    }
    fn snapshot(&self) -> Snapshot {
        of_kind(self.filter.carried())
    }
    fn finished(&self) -> usize {
        self.finished
    }
}

pub(super) type Begun<'t> = Result<Box<dyn Recording + Send + 't>, StepError>;

/// What is streamed.
pub(super) struct Course<'s, 't> {
    /// A recorder that starts here, has room for the records of so many rows, and gives the states at these times.
    pub begin: &'s (dyn Fn(Start, usize, &'t [f64]) -> Begun<'t> + Sync),
    pub data: &'s dyn Source,
    pub prior: &'t Gaussian,
    pub at: &'t [f64],
    pub goal: Goal,
    pub measures: usize,
    pub watch: Watch<'t>,
    /// Rows could not be read.
    pub lost: AtomicBool,
}

impl<'s> Course<'s, '_> {
    /// How many of the wanted times lie before this row; before the first row, none do.
    pub fn before(&self, row: usize) -> usize {
        if row == 0 {
            return 0;
        }
        let time = self.time(row).unwrap_or(f64::INFINITY);
        self.at.partition_point(|&t| t < time)
    }

    /// How many of them lie up to the row before this one.
    pub fn up_to(&self, row: usize) -> usize {
        let before = row.checked_sub(1).and_then(|k| self.time(k));
        before.map_or(0, |before| self.at.partition_point(|&t| t <= before))
    }

    /// When row `k` is, if there is one.
    fn time(&self, k: usize) -> Option<f64> {
        let rows = (k < self.data.len()).then(|| self.data.read(k..k + 1))??;
        rows.at(k).map(|row| row.time)
    }

    /// These rows, and the one before, whose controls hold up to them; none where they cannot be read.
    pub fn read(&self, rows: Range<usize>) -> Option<Stretch<'s>> {
        let read = self.data.read(rows.start.saturating_sub(1)..rows.end);
        if read.is_none() {
            self.lost.store(true, Ordering::Relaxed);
        }
        read
    }

    /// Whether nothing further is to be done: others say so, or rows could not be read.
    pub fn stopped(&self) -> bool {
        self.watch.stopped() || self.lost.load(Ordering::Relaxed)
    }

    pub fn blank(&self) -> Outcome {
        Outcome::new(self.prior.mean().len(), self.measures, self.goal)
    }
}

/// Begins a recorder of a task.
pub(super) fn begin<'t, X, M, H, T>(
    task: Task<'t, 't, X, M, H>,
    start: Start,
    rows: usize,
    at: &'t [f64],
) -> Begun<'t>
where
    X: Over<M> + Send + 't,
    M: Sync,
    H: Observation + Sync,
    T: Real + Send + 't,
{
    let d = task.sensors.measures();
    let n = match start {
        Start::Prior(_, prior) => prior.mean().len(),
        Start::Snapshot(snapshot) => snapshot.mean.len(),
    };
    let blank = Estimates::new(n, d, task.goal != Goal::Filter);
    Ok(Box::new(Recorder::start(task, start, rows, Between::<T>::new(at, blank))?))
}
