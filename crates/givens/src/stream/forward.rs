//! Once over the data: filter, fixed lag, fixed point; and a fixed interval whose rows may all be held.

use super::course::Course;
use super::{Ended, Finished, Sink};
use crate::run::{Goal, Outcome, Start};

/// Rows that are handed over together, if so many may be held.
const TOGETHER: usize = 8192;

/// Runs over the rows, and hands them to `sink`.
pub(super) fn stream(course: &Course, hold: usize, sink: &mut Sink) -> Ended {
    let (data, goal, watch) = (course.data, course.goal, course.watch);
    let (rows, mut outcome) = (data.len(), course.blank());
    // what a later row may change stays; the last row, for a time that is its own
    let (together, keep) = match goal {
        Goal::Interval => (rows, 0),
        Goal::Lag(lag) => (hold.min(TOGETHER), lag.max(1)),
        Goal::Filter | Goal::Point(_) => (hold.min(TOGETHER), 1),
    };
    let wanted = if matches!(goal, Goal::Filter | Goal::Interval) { course.at } else { &[] };
    let mut recorder = match (course.begin)(Start::Prior(data.start(), course.prior), rows, wanted) {
        Ok(recorder) => recorder,
        Err(error) => return Ended { failure: Some((0, error)), ..Ended::default() },
    };
    let mut next = 0;
    while next < rows && outcome.failure.is_none() && !watch.stopped() {
        let end = (next + together.max(1)).min(rows);
        recorder.forward(data, next..end, &mut outcome);
        next = end;
        if next < rows && outcome.failure.is_none() {
            let first = recorder.finished().saturating_sub(outcome.estimates.len());
            let (estimates, at) = &recorder.cut(&mut outcome, keep);
            if sink(Finished { first, estimates, at }).is_break() {
                return Ended::of(outcome);
            }
        }
    }
    recorder.beyond(&mut outcome);
    let first = recorder.finished().saturating_sub(outcome.estimates.len());
    recorder.finish(&mut outcome, None);
    if !watch.stopped() {
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
