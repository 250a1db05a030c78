//! The segments of a track that is smoothed in pieces.

use super::course::{Course, Recording};
use super::interval::Progress;
use super::mark::{Kind, Mark, Stand};
use super::{Ended, Sink};
use crate::filter::StepError;
use crate::run::{Outcome, Start};
use core::ops::Range;

/// The segments of a track that was filtered. Each but the last goes one row into the next: the record of that row leads back.
pub(super) struct Segments<'s, 't> {
    course: &'s Course<'s, 't>,
    length: usize,
    /// The filter before the first row of each.
    starts: Vec<Stand>,
    /// Rows that were finished, and the one that was not.
    finished: usize,
    begun: usize,
}

/// What filtering a track has found.
pub(super) struct Found<'s, 't, 'f> {
    pub segments: Segments<'s, 't>,
    pub ended: Ended,
    /// Marks of what was done after it, by a stream that was broken off.
    pub before: &'f [Mark],
}

impl<'s, 't> Segments<'s, 't> {
    /// Filters the track, from where a stream was broken off, and notes where the segments begin.
    pub fn find<'f>(
        course: &'s Course<'s, 't>,
        length: usize,
        from: &'f [Mark],
        sink: &mut dyn Sink,
        progress: &mut Progress,
    ) -> Result<Found<'s, 't, 'f>, StepError> {
        let (rows, mut outcome) = (course.data.len(), course.blank());
        let mut segments = Self { course, length, starts: Vec::new(), finished: 0, begun: rows };
        let mut before = from;
        while let [Mark(Kind::Segment { length, stand }), rest @ ..] = before {
            segments.length = *length;
            segments.starts.push(stand.clone());
            before = rest;
        }
        if let [Mark(Kind::Filtered { finished, log_likelihood }), rest @ ..] = before {
            segments.finished = *finished;
            progress.add(*finished);
            let ended = Ended { log_likelihood: *log_likelihood, ..Ended::default() };
            return Ok(Found { segments, ended, before: rest });
        }
        // the segment that was at work begins again
        let mut is_marked = !segments.starts.is_empty();
        let mut recorder = match segments.starts.last() {
            None => (course.begin)(Start::Prior(course.data.start(), course.prior), 1, course.at)?,
            Some(last) => {
                segments.finished = last.row;
                outcome.log_likelihood = last.log_likelihood;
                progress.add(last.row);
                (course.begin)(last.start(), 1, &course.at[course.up_to(last.row)..])?
            }
        };
        while segments.finished < rows && !course.stopped() {
            if !is_marked {
                let (row, filter) = (segments.finished, recorder.snapshot());
                let stand = Stand { row, filter, log_likelihood: outcome.log_likelihood };
                sink.mark(Mark(Kind::Segment { length: segments.length, stand: stand.clone() }));
                segments.starts.push(stand);
            }
            is_marked = false;
            let end = (segments.finished + segments.length).min(rows);
            let Some(read) = course.read(segments.finished..end) else { break };
            recorder.forward(&read, segments.finished..end, &mut outcome);
            // a recorder that went on has finished nothing yet
            let finished = recorder.finished().max(segments.finished);
            progress.add(finished - segments.finished);
            segments.finished = finished;
            if outcome.failure.is_some() {
                segments.begun = segments.finished + 1;
                break;
            }
            // the last row stays, for a time that is its own
            drop(recorder.cut(&mut outcome, 1));
        }
        recorder.beyond(&mut outcome);
        let ended = Ended::of(outcome);
        if ended.failure.is_none() && !course.stopped() {
            let (finished, log_likelihood) = (segments.finished, ended.log_likelihood);
            sink.mark(Mark(Kind::Filtered { finished, log_likelihood }));
        }
        // of a track that fails, all is found again
        Ok(Found { segments, ended, before })
    }

    /// How many there are: a rest shorter than the others belongs to the last of them.
    pub fn count(&self) -> usize {
        (self.finished / self.length).max(usize::from(self.finished > 0))
    }

    /// The rows that segment `j` answers.
    pub fn rows(&self, j: usize) -> Range<usize> {
        let end = if j + 1 < self.count() { (j + 1) * self.length } else { self.finished };
        j * self.length..end
    }

    /// Filters segment `j` again, up to what failed.
    pub fn forward(&self, j: usize) -> Result<(Box<dyn Recording + Send + 't>, Outcome), (usize, StepError)> {
        let Range { start, end } = self.rows(j);
        let (at, is_last) = (self.course.at, j + 1 == self.count());
        // a row that failed is tried again: the way back begins where it left the filter
        let rows = start..if is_last { self.begun } else { end + 1 };
        let wanted = &at[self.course.before(start)..if is_last { at.len() } else { self.course.before(end) }];
        let begun = (self.course.begin)(self.starts[j].start(), rows.len(), wanted);
        let mut recorder = begun.map_err(|error| (start, error))?;
        let mut outcome = self.course.blank();
        if let Some(read) = self.course.read(rows.clone()) {
            recorder.forward(&read, rows, &mut outcome);
        }
        recorder.beyond(&mut outcome);
        Ok((recorder, outcome))
    }
}
