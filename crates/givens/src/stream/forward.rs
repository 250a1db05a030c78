//! Once over the data: filter, fixed lag, fixed point; and a fixed interval whose rows may all be held.

use super::{Ended, Finished, Sink};
use crate::Estimates;
use crate::batch::Track;
use crate::filter::Over;
use crate::model::Observation;
use crate::run::{Between, Goal, Outcome, Recorder, Start, Task};

/// Rows that are handed over together, if so many may be held.
const TOGETHER: usize = 8192;

/// Runs over the track, and hands its rows to `sink`.
pub(super) fn stream<X: Over<M>, M, H: Observation>(
    task: Task<X, M, H>,
    track: &Track<M, H>,
    hold: usize,
    sink: &mut Sink,
) -> Ended {
    let (rows, goal) = (track.data.len(), task.goal);
    let smoothed = goal != Goal::Filter;
    let mut outcome = Outcome::new(track.prior.mean().len(), track.sensors.measures(), goal);
    // what a later row may change stays; the last row, for a time that is its own
    let (together, keep) = match goal {
        Goal::Interval => (rows, 0),
        Goal::Lag(lag) => (hold.min(TOGETHER), lag.max(1)),
        Goal::Filter | Goal::Point(_) => (hold.min(TOGETHER), 1),
    };
    let wanted = if matches!(goal, Goal::Filter | Goal::Interval) { track.at } else { &[] };
    let blank = Estimates::new(outcome.estimates.states(), outcome.estimates.measures(), smoothed);
    let start = Start::Prior(track.data.start(), track.prior);
    let mut recorder = match Recorder::start(task, start, rows, Between::new(wanted, blank)) {
        Ok(recorder) => recorder,
        Err(error) => return Ended { failure: Some((0, error)), ..Ended::default() },
    };
    let mut next = 0;
    while next < rows && outcome.failure.is_none() && !task.watch.stopped() {
        let end = (next + together.max(1)).min(rows);
        recorder.forward(track.data, next..end, &mut outcome);
        next = end;
        if next < rows && outcome.failure.is_none() {
            let first = recorder.first(&outcome);
            let (estimates, at) = &recorder.cut(&mut outcome, keep);
            if sink(Finished { first, estimates, at }).is_break() {
                return Ended::of(outcome);
            }
        }
    }
    recorder.beyond(&mut outcome);
    let first = recorder.first(&outcome);
    recorder.finish(&mut outcome, None);
    if !task.watch.stopped() {
        // nothing follows, whatever is answered
        let _ = sink(Finished { first, estimates: &outcome.estimates, at: &outcome.at });
    }
    Ended::of(outcome)
}

impl Ended {
    pub(super) fn of(outcome: Outcome) -> Self {
        let Outcome { failure, log_likelihood, failed_at, .. } = outcome;
        Self { failure, log_likelihood, failed_at }
    }
}
