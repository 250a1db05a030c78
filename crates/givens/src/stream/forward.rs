//! Once over the data: filter, fixed lag, fixed point; and a fixed interval whose rows may all be held.

use super::course::{Course, Recording};
use super::mark::{Kind, Mark, Stand};
use super::{Ended, Finished, Sink, Stream};
use crate::Estimates;
use crate::filter::StepError;
use crate::run::{Goal, Outcome, Start};
use core::ops::ControlFlow;
use std::collections::VecDeque;

/// Rows that are handed over together, if so many may be held.
const TOGETHER: usize = 8192;

/// Runs over the rows, and hands them to `sink`.
pub(super) fn stream(course: &Course, by: &Stream, sink: &mut dyn Sink) -> Ended {
    let (goal, hold) = (course.goal, by.hold);
    let (rows, mut outcome) = (course.data.len(), course.blank());
    // what a later row may change stays; the last row, for a time that is its own
    let (together, keep) = match goal {
        Goal::Interval => (rows, 0),
        Goal::Lag(lag) => (hold.min(TOGETHER), lag.max(1)),
        Goal::Filter | Goal::Point(_) => (hold.min(TOGETHER), 1),
    };
    let (mut recorder, mut next, mut given) = match begin(course, by.from, &mut outcome) {
        Ok(begun) => begun,
        Err(error) => return Ended { failure: Some((0, error)), ..Ended::default() },
    };
    let markable = matches!(goal, Goal::Filter | Goal::Lag(_));
    // where portions began: the first of them before the rows that were not handed over yet
    let mut stands: VecDeque<Stand> = VecDeque::new();
    while next < rows && outcome.failure.is_none() && !course.stopped() {
        let end = (next + together.max(1)).min(rows);
        if markable {
            let (row, log_likelihood) = (next, outcome.log_likelihood);
            stands.push_back(Stand { row, filter: recorder.snapshot(), log_likelihood });
        }
        let Some(read) = course.read(next..end) else { break };
        recorder.forward(&read, next..end, &mut outcome);
        next = end;
        if next < rows && outcome.failure.is_none() {
            let first = recorder.finished().saturating_sub(outcome.estimates.len());
            let (estimates, at) = recorder.cut(&mut outcome, keep);
            if given.hand(first, estimates, at, sink).is_break() {
                return Ended::of(outcome);
            }
            while stands.get(1).is_some_and(|next| next.row <= given.rows) {
                stands.pop_front();
            }
            if let Some(stand) = stands.front().cloned() {
                sink.mark(Mark(Kind::Rows { stand, handed: given.rows, at: given.at }));
            }
        }
    }
    recorder.beyond(&mut outcome);
    // a recorder that went on, and failed at once, has finished nothing
    let first = recorder.finished().max(given.rows).saturating_sub(outcome.estimates.len());
    recorder.finish(&mut outcome, None);
    if !course.stopped() {
        let [estimates, at] = [&mut outcome.estimates, &mut outcome.at].map(core::mem::take);
        // nothing follows, whatever is answered
        let _ = given.hand(first, estimates, at, sink);
    }
    Ended::of(outcome)
}

/// A recorder, at the beginning or where a stream was broken off: the row that it takes in next, and what was given already.
fn begin<'t>(
    course: &Course<'_, 't>,
    from: &[Mark],
    outcome: &mut Outcome,
) -> Result<(Box<dyn Recording + Send + 't>, usize, Given), StepError> {
    let (rows, goal) = (course.data.len(), course.goal);
    let at = if matches!(goal, Goal::Filter | Goal::Interval) { course.at } else { &[] };
    let Some(Mark(Kind::Rows { stand, handed, at: times })) = from.last() else {
        let recorder = (course.begin)(Start::Prior(course.data.start(), course.prior), rows, at)?;
        return Ok((recorder, 0, Given::default()));
    };
    let passed = course.before(stand.row).min(at.len());
    outcome.log_likelihood = stand.log_likelihood;
    let recorder = (course.begin)(stand.start(), rows, &at[passed..])?;
    course.watch.count(stand.row);
    let given = Given { rows: *handed, at: *times, twice: times.saturating_sub(passed) };
    Ok((recorder, stand.row, given))
}

/// What was handed over: rows, and times; of the times, so many come a second time.
#[derive(Default)]
struct Given {
    rows: usize,
    at: usize,
    twice: usize,
}

impl Given {
    /// Hands over what was not.
    fn hand(
        &mut self,
        first: usize,
        mut rows: Estimates,
        mut at: Estimates,
        sink: &mut dyn Sink,
    ) -> ControlFlow<()> {
        let again = self.rows.saturating_sub(first).min(rows.len());
        if again > 0 {
            rows = rows.split_off(again);
        }
        let twice = self.twice.min(at.len());
        if twice > 0 {
            at = at.split_off(twice);
        }
        self.twice -= twice;
        self.rows += rows.len();
        self.at += at.len();
        sink.take(Finished { first: first + again, estimates: &rows, at: &at })
    }
}

impl Ended {
    pub(super) fn of(outcome: Outcome) -> Self {
        let Outcome { failure, log_likelihood, failed_at, .. } = outcome;
        Self { failure, log_likelihood, failed_at }
    }
}
