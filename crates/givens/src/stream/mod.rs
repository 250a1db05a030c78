//! One long trajectory, whose estimates are handed over as they are finished: memory does not grow with its rows.

mod course;
mod forward;
mod interval;
mod mark;
mod segments;
mod source;

use crate::batch::Track;
use crate::filter::StepError;
use crate::model::Observation;
use crate::run::{Goal, Start, Task, Watch};
use crate::smoother::History;
use crate::{Computes, Estimates, gate};
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicUsize};
use course::Course;

pub use mark::Mark;
pub use source::{Source, Stretch};

/// Rows that are finished together.
#[derive(Clone, Copy, Debug)]
pub struct Finished<'e> {
    /// The row of the data that the first of the estimates is of.
    pub first: usize,
    /// The estimates of these rows.
    pub estimates: &'e Estimates,
    /// The states at the times asked for, up to these rows.
    pub at: &'e Estimates,
}

/// How a stream ended.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ended {
    /// The row that failed, and why.
    pub failure: Option<(usize, StepError)>,
    /// The log-likelihood of all measurements that were taken in.
    pub log_likelihood: f64,
    /// The mean from which the failed step set out, length n; empty if none failed, or none began.
    pub failed_at: Vec<f64>,
}

/// How a trajectory is streamed.
///
/// The rows come in their order, some at a time, with the numbers of [`run_at`](crate::run_at) to the bit. Filter, fixed lag and
/// fixed point hold some of the rows at once and go over the data once. The fixed-interval smoother does so where all rows may
/// be [held](Self::hold). Where not, it goes over the data three times: it filters, and keeps the filter at the ends of its
/// segments, √rows of them; then it filters and smooths the segments from the last to the first, and keeps the smoothed
/// belief at the end of each; then again from the first to the last, and hands them over. Nothing is written to a disk, and what
/// fails on the way is known before the first row is handed over.
///
/// ```
/// use core::ops::ControlFlow;
/// use givens::batch::Track;
/// use givens::filter::{Gaussian, SrCkf};
/// use givens::model::zoo::{CoordinatedTurn, RangeBearing};
/// use givens::{Data, Finished, Goal, Stream};
///
/// let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
/// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
/// let mut data = Data::new(2).starting_at(0.0);
/// for k in 1..100 {
///     data.push(f64::from(k), &[1640.0, f64::NAN])?;
/// }
/// let stream = Stream { goal: Goal::Interval, hold: 20, ..Stream::default() };
/// let mut rows = 0;
/// let ended = stream.run(SrCkf::default(), &Track::new(&turn, &radar, &data, &prior), &mut |finished: Finished| {
///     assert_eq!(finished.first, rows);
///     rows += finished.estimates.len();
///     ControlFlow::Continue(())
/// });
/// assert!(ended.failure.is_none() && rows == 99);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Stream<'a> {
    /// What the estimates are given.
    pub goal: Goal,
    /// So many rows may be in memory at once, each of [`bytes_per_row`](Self::bytes_per_row); at least two, and those of the lag.
    pub hold: usize,
    /// The segments of the smoother are filtered again on so many threads; all cores where it is not said.
    pub threads: Option<NonZeroUsize>,
    /// Cancels the run when it is set, before its next row.
    pub cancel: Option<&'a AtomicBool>,
    /// Counts the rows as they are taken in; where the data are gone over thrice, to the third part each time.
    pub rows: Option<&'a AtomicUsize>,
    /// The marks of a stream that was broken off, all of them and in their order; none for one from the beginning.
    pub from: &'a [Mark],
}

impl Default for Stream<'_> {
    /// Filtering, with up to 8192 rows at once.
    fn default() -> Self {
        Self { goal: Goal::Filter, hold: 8192, threads: None, cancel: None, rows: None, from: &[] }
    }
}

/// Takes in what a stream hands over: a closure, or what keeps its marks too.
pub trait Sink {
    /// Takes in rows that are finished. After `Break` none follows.
    fn take(&mut self, finished: Finished) -> ControlFlow<()>;

    /// Takes in how far the stream has come, all rows before being taken in. A fixed point, and a fixed interval that is held
    /// as a whole, come to no mark before they end.
    fn mark(&mut self, _mark: Mark) {}
}

impl<F: FnMut(Finished) -> ControlFlow<()>> Sink for F {
    fn take(&mut self, finished: Finished) -> ControlFlow<()> {
        self(finished)
    }
}

impl Stream<'_> {
    /// Bytes of memory for each row that is held, of n `states` and d `measures`: its estimates, and what the fixed-interval
    /// smoother records.
    pub fn bytes_per_row(goal: Goal, states: usize, measures: usize) -> usize {
        let record = History::<f64, Vec<f64>>::record_len(states).saturating_mul(size_of::<f64>());
        let recorded = if goal == Goal::Interval { record } else { 0 };
        Estimates::row_bytes(states, measures, goal != Goal::Filter).saturating_add(recorded)
    }

    /// Runs a method over a trajectory, and hands its rows to `sink`; a method of run time by
    /// [`Choice::stream`](crate::registry::Choice::stream).
    pub fn run<X, M, H, D>(&self, method: X, track: &Track<M, H, D>, sink: &mut dyn Sink) -> Ended
    where
        X: Computes<M, Method: Send + Sync>,
        M: Sync,
        H: Observation + Sync,
        D: Source + ?Sized,
    {
        let Track { model, sensors, data, prior, parameters, at } = *track;
        let data: &dyn Source = &data;
        let (goal, watch) = (self.goal, Watch { cancel: self.cancel, rows: self.rows });
        // a smoother in segments counts its rows itself
        let segments = goal == Goal::Interval && (data.len() > self.hold || !self.from.is_empty());
        let counted = if segments { Watch { rows: None, ..watch } } else { watch };
        let limits = &match gate::limits(method.gate(), sensors.measures()) {
            Ok(limits) => limits,
            Err(fault) => {
                let error = StepError { fault, time: data.start(), step: 0 };
                return Ended { failure: Some((0, error)), ..Ended::default() };
            }
        };
        let task = Task { method: method.method(), model, sensors, parameters, goal, limits, watch: counted };
        let begin = |start: Start<'_>, rows, at| course::begin::<_, _, _, X::Number>(task, start, rows, at);
        let (measures, lost) = (sensors.measures(), AtomicBool::new(false));
        let course = Course { begin: &begin, data, prior, at, goal, measures, watch, lost };
        if segments { interval::stream(&course, self, sink) } else { forward::stream(&course, self, sink) }
    }
}
