//! The fixed-interval smoother over more rows than may be held: thrice over the data, segment by segment.

use super::course::Course;
use super::mark::{Kind, Mark};
use super::segments::{Found, Segments};
use super::{Ended, Finished, Sink, Stream};
use crate::batch::each;
use crate::filter::StepError;
use crate::run::{Crossing, Outcome, Watch};
use core::num::NonZeroUsize;
use core::ops::Range;
use std::thread::available_parallelism;

/// Rows of a segment, if so many may be held; more where the ends of so short ones would be more than their rows.
const TOGETHER: usize = 8192;

/// Smooths the rows, and hands them to `sink`.
pub(super) fn stream(course: &Course, by: &Stream, sink: &mut dyn Sink) -> Ended {
    let threads = by.threads.or_else(|| available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN);
    let (rows, watch) = (course.data.len(), course.watch);
    // the last segment takes the rest with it
    let most = by.hold / (threads.get() + 1);
    let length = rows.isqrt().max(TOGETHER).min(most).max(2);
    let mut progress = Progress { watch, thirds: 0, told: 0 };
    let Found { segments, mut ended, before } =
        match Segments::find(course, length, by.from, sink, &mut progress) {
            Ok(found) => found,
            Err(error) => return Ended { failure: Some((0, error)), ..Ended::default() },
        };
    let count = segments.count();
    let mut ends: Vec<Option<Crossing<f64>>> = vec![None; count];
    let mut crossed = 0;
    for mark in before {
        if let Mark(Kind::Back(end)) = mark
            && crossed < count
        {
            crossed += 1;
            if let Some(j) = count.checked_sub(crossed + 1) {
                ends[j].clone_from(end);
            }
            progress.add(segments.rows(count - crossed).len());
        }
    }
    let numbers = |group: &Range<usize>| group.clone().collect::<Vec<_>>();
    for group in groups(0..count - crossed, threads).into_iter().rev() {
        let again = each(&numbers(&group), Some(threads), |&j| segments.forward(j));
        for (j, segment) in group.zip(again).rev() {
            let crossed = segment.and_then(|(mut recorder, mut outcome)| {
                let crossed = recorder.finish(&mut outcome, ends[j].clone());
                let failure = outcome.failure.filter(|_| crossed.is_none());
                failure.map_or(Ok(crossed), Err)
            });
            if course.stopped() {
                return ended;
            }
            match crossed {
                Ok(crossed) => {
                    sink.mark(Mark(Kind::Back(crossed.clone())));
                    if j > 0 {
                        ends[j - 1] = crossed;
                    }
                }
                Err(failure) => {
                    ended.failure.get_or_insert(failure);
                    return ended;
                }
            }
            progress.add(segments.rows(j).len());
        }
    }
    let handed = before.iter().filter(|mark| mark.0 == Kind::Handed).count().min(count);
    (0..handed).for_each(|j| progress.add(segments.rows(j).len()));
    for group in groups(handed..count, threads) {
        let done = each(&numbers(&group), Some(threads), |&j| {
            let (mut recorder, mut outcome) = segments.forward(j)?;
            recorder.finish(&mut outcome, ends[j].clone());
            Ok::<_, (usize, StepError)>(outcome)
        });
        for (j, outcome) in group.zip(done) {
            let (Ok(outcome), false) = (outcome, course.stopped()) else { return ended };
            let Outcome { estimates, at, .. } = &outcome;
            let rows = segments.rows(j);
            progress.add(rows.len());
            if sink.take(Finished { first: rows.start, estimates, at }).is_break() {
                return ended;
            }
            sink.mark(Mark(Kind::Handed));
        }
    }
    ended
}

/// Segments that are at work at the same time.
fn groups(of: Range<usize>, threads: NonZeroUsize) -> Vec<Range<usize>> {
    of.clone().step_by(threads.get()).map(|j| j..(j + threads.get()).min(of.end)).collect()
}

/// Counts a row when it has been gone over for the third time.
pub(super) struct Progress<'t> {
    watch: Watch<'t>,
    thirds: usize,
    told: usize,
}

impl Progress<'_> {
    pub fn add(&mut self, rows: usize) {
        self.thirds += rows;
        self.watch.count(self.thirds / 3 - self.told);
        self.told = self.thirds / 3;
    }
}
