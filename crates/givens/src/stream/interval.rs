//! The fixed-interval smoother over more rows than may be held: thrice over the data, segment by segment.

use super::course::{Course, Recording};
use super::{Ended, Finished, Sink};
use crate::batch::each;
use crate::filter::{Snapshot, StepError};
use crate::run::{Crossing, Outcome, Start, Watch};
use core::num::NonZeroUsize;
use core::ops::Range;
use std::thread::available_parallelism;

/// Rows of a segment, if so many may be held; more where the ends of so short ones would be more than their rows.
const TOGETHER: usize = 8192;

/// Smooths the rows, and hands them to `sink`.
pub(super) fn stream(course: &Course, hold: usize, threads: Option<NonZeroUsize>, sink: &mut Sink) -> Ended {
    let threads = threads.or_else(|| available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN);
    let (rows, watch) = (course.data.len(), course.watch);
    // the last segment takes the rest with it
    let most = hold / (threads.get() + 1);
    let length = rows.isqrt().max(TOGETHER).min(most).max(2);
    let mut progress = Progress { watch, thirds: 0, told: 0 };
    let (segments, mut ended) = match Segments::find(course, length, &mut progress) {
        Ok(found) => found,
        Err(error) => return Ended { failure: Some((0, error)), ..Ended::default() },
    };
    let count = segments.count();
    let mut ends: Vec<Option<Crossing<f64>>> = vec![None; count];
    let groups: Vec<Range<usize>> =
        (0..count).step_by(threads.get()).map(|j| j..(j + threads.get()).min(count)).collect();
    let numbers = |group: &Range<usize>| group.clone().collect::<Vec<_>>();
    for group in groups.iter().rev() {
        let again = each(&numbers(group), Some(threads), |&j| segments.forward(j));
        for (j, segment) in group.clone().zip(again).rev() {
            let crossed = segment.and_then(|(mut recorder, mut outcome)| {
                let crossed = recorder.finish(&mut outcome, ends[j].clone());
                let failure = outcome.failure.filter(|_| crossed.is_none());
                failure.map_or(Ok(crossed), Err)
            });
            if watch.stopped() {
                return ended;
            }
            match crossed {
                Ok(crossed) if j > 0 => ends[j - 1] = crossed,
                Ok(_) => {}
                Err(failure) => {
                    ended.failure.get_or_insert(failure);
                    return ended;
                }
            }
            progress.add(segments.rows(j).len());
        }
    }
    for group in &groups {
        let done = each(&numbers(group), Some(threads), |&j| {
            let (mut recorder, mut outcome) = segments.forward(j)?;
            recorder.finish(&mut outcome, ends[j].clone());
            Ok::<_, (usize, StepError)>(outcome)
        });
        for (j, outcome) in group.clone().zip(done) {
            let (Ok(outcome), false) = (outcome, watch.stopped()) else { return ended };
            let Outcome { estimates, at, .. } = &outcome;
            progress.add(segments.rows(j).len());
            if sink(Finished { first: j * length, estimates, at }).is_break() {
                return ended;
            }
        }
    }
    ended
}

/// The segments of a track that was filtered. Each but the last goes one row into the next: the record of that row leads back.
struct Segments<'s, 't> {
    course: &'s Course<'s, 't>,
    length: usize,
    /// The filter before the first row of each.
    starts: Vec<Snapshot>,
    /// Rows that were finished, and the one that was not.
    finished: usize,
    begun: usize,
}

impl<'s, 't> Segments<'s, 't> {
    /// Filters the track, and notes where the segments begin.
    fn find(
        course: &'s Course<'s, 't>,
        length: usize,
        progress: &mut Progress,
    ) -> Result<(Self, Ended), StepError> {
        let (data, mut outcome) = (course.data, course.blank());
        let rows = data.len();
        let mut segments = Self { course, length, starts: Vec::new(), finished: 0, begun: rows };
        let mut recorder = (course.begin)(Start::Prior(data.start(), course.prior), 1, course.at)?;
        while segments.finished < rows && !course.watch.stopped() {
            segments.starts.push(recorder.snapshot());
            let end = (segments.finished + length).min(rows);
            recorder.forward(data, segments.finished..end, &mut outcome);
            progress.add(recorder.finished() - segments.finished);
            segments.finished = recorder.finished();
            if outcome.failure.is_some() {
                segments.begun = segments.finished + 1;
                break;
            }
            // the last row stays, for a time that is its own
            drop(recorder.cut(&mut outcome, 1));
        }
        recorder.beyond(&mut outcome);
        Ok((segments, Ended::of(outcome)))
    }

    /// How many there are: a rest shorter than the others belongs to the last of them.
    fn count(&self) -> usize {
        (self.finished / self.length).max(usize::from(self.finished > 0))
    }

    /// The rows that segment `j` answers.
    fn rows(&self, j: usize) -> Range<usize> {
        let end = if j + 1 < self.count() { (j + 1) * self.length } else { self.finished };
        j * self.length..end
    }

    /// Filters segment `j` again, up to what failed.
    fn forward(&self, j: usize) -> Result<(Box<dyn Recording + Send + 't>, Outcome), (usize, StepError)> {
        let Range { start, end } = self.rows(j);
        let (data, at, is_last) = (self.course.data, self.course.at, j + 1 == self.count());
        // a row that failed is tried again: the way back begins where it left the filter
        let rows = start..if is_last { self.begun } else { end + 1 };
        let before = |row: usize| {
            let time = data.row(row).map_or(f64::INFINITY, |row| row.time);
            at.partition_point(|&t| t < time)
        };
        let first = if j == 0 { 0 } else { before(start) };
        let wanted = &at[first..if is_last { at.len() } else { before(end) }];
        let begun = (self.course.begin)(Start::Snapshot(&self.starts[j]), rows.len(), wanted);
        let mut recorder = begun.map_err(|error| (start, error))?;
        let mut outcome = self.course.blank();
        recorder.forward(data, rows, &mut outcome);
        recorder.beyond(&mut outcome);
        Ok((recorder, outcome))
    }
}

/// Counts a row when it has been gone over for the third time.
struct Progress<'t> {
    watch: Watch<'t>,
    thirds: usize,
    told: usize,
}

impl Progress<'_> {
    fn add(&mut self, rows: usize) {
        self.thirds += rows;
        self.watch.count(self.thirds / 3 - self.told);
        self.told = self.thirds / 3;
    }
}
