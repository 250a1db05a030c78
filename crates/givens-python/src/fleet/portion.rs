//! Some of the tracks of a table, and what comes of them.

use givens::explain::Told;
use givens::filter::Fault;
use givens::registry::Choice;
use givens::{Estimates, Goal, Outcome};
use givens_io::{Answer, Beginning, FailedTrack, Track, Unread};
use pyo3::prelude::*;

use crate::crowd::each;
use crate::doubts;
use crate::errors::Result;
use crate::failure::{told, word};
use crate::model::Model;
use crate::packs::{self, alike};
use crate::run::Job;
use crate::watch::{detached, signals};

/// Where each track begins, or why it does not.
pub type Beginnings = Vec<core::result::Result<Beginning, String>>;

/// By what tracks are run.
pub struct Run<'a> {
    pub model: &'a Model,
    pub choice: Choice,
    pub goal: Goal,
    pub threads: usize,
}

/// What came of a portion: an answer for each of its tracks.
#[derive(Default)]
pub struct Come {
    pub answers: Vec<Answer>,
    pub failed: Vec<FailedTrack>,
    /// What is doubtful about them, in words, and whether it is grave.
    pub doubts: Vec<(String, bool)>,
}

impl Run<'_> {
    /// Runs these tracks. An exception in a function of the model ends its track alone, a signal all of them.
    pub fn portion(
        &self,
        py: Python<'_>,
        tracks: &[Track],
        beginnings: &[core::result::Result<Beginning, String>],
    ) -> Result<Come> {
        let mut come = Come::default();
        let (mut jobs, mut of) = (Vec::new(), Vec::new());
        for (i, (track, beginning)) in tracks.iter().zip(beginnings).enumerate() {
            come.answers.push(Answer::default());
            let job = beginning.as_ref().map_err(String::clone);
            match job.and_then(|begin| Ok((begin, self.job(track, begin)?))) {
                Ok((begin, job)) => {
                    jobs.push(job);
                    of.push((i, begin));
                }
                Err(message) => {
                    let message = format!("beginning: {message}");
                    come.failed.push(FailedTrack { id: track.id.clone(), time_text: None, message });
                }
            }
        }
        // also a single one: a track is the same in a table of its own
        let outcomes = if alike(&jobs) {
            packs::run(py, &jobs, self.threads)?.into_iter().map(|outcome| (outcome, None)).collect()
        } else if jobs.iter().any(|job| job.model.needs_python()) {
            one_by_one(py, &jobs)?
        } else {
            let outcomes = each(py, jobs.len(), self.threads, |k| jobs[k].run());
            outcomes.map_err(|ended| ended.raised)?.into_iter().map(|outcome| (outcome, None)).collect()
        };
        let (outcomes, raised): (Vec<Outcome>, Vec<Option<PyErr>>) = outcomes.into_iter().unzip();
        for (k, row, time, message, count, grave) in doubts::of(py, &jobs, &outcomes)? {
            let (track, begin) = (&tracks[of[k].0], of[k].1);
            come.doubts.push((doubtful(track, begin.row + row, time, &message, count), grave));
        }
        for ((i, begin), (outcome, raised)) in of.into_iter().zip(outcomes.into_iter().zip(raised)) {
            let Outcome { estimates, failure, .. } = outcome;
            let track = &tracks[i];
            if let Some((row, error)) = failure {
                let row = track.rows.read(begin.row + row..begin.row + row + 1);
                let row = row.ok().and_then(|rows| Some(rows.first()?.index + 1));
                let row = row.map_or_else(String::new, |row| format!("row {row}: "));
                let message = match raised {
                    Some(raised) => format!("raised: {row}{raised}"),
                    None => format!("{}: {row}{}", word(&error.fault), self.words(&error.fault)),
                };
                let time_text = Some(track.time_text(error.time));
                come.failed.push(FailedTrack { id: track.id.clone(), time_text, message });
            }
            come.answers[i] = Answer { estimates, row: begin.row, started: begin.started, from_first: false };
        }
        Ok(come)
    }

    /// What is wrong, and the remedy.
    fn words(&self, fault: &Fault) -> String {
        let Told { what, remedy, .. } = told(self.model, Some(&self.choice), fault);
        remedy.map_or_else(|| what.clone(), |remedy| format!("{what}; {remedy}"))
    }

    /// The rows of a track from its beginning on.
    fn job(&self, track: &Track, begin: &Beginning) -> core::result::Result<Job, String> {
        let widths = (self.model.measures(), self.model.controls());
        let data = track.data(widths, begin, 0..track.rows.len()).map_err(|unread| match unread {
            Unread::Lost(error) => error.to_string(),
            Unread::Wrong(row, error) => format!("row {}: {error}", row.index + 1),
        })?;
        let (model, prior) = (self.model.clone(), begin.prior.clone());
        Ok(Job { model, choice: self.choice, prior, data, goal: self.goal, at: None })
    }
}

/// A doubt in words, and its place.
fn doubtful(track: &Track, row: usize, time: f64, message: &str, rows: usize) -> String {
    let id = track.id.as_ref().map_or_else(String::new, |id| format!("track {id}, "));
    let index = track.rows.row(row).ok().flatten().map_or(row, |row| row.index);
    let more =
        if rows > 1 { format!(" (the same of {rows} rows that were looked at)") } else { String::new() };
    format!("{id}row {}, t = {}: {message}{more}", index + 1, track.time_text(time))
}

/// Runs that call functions of Python, with the exception that ended each if one did.
fn one_by_one(py: Python<'_>, jobs: &[Job]) -> Result<Vec<(Outcome, Option<PyErr>)>> {
    let mut outcomes = Vec::with_capacity(jobs.len());
    for job in jobs {
        let (outcome, raised) = detached(py, || job.run());
        signals()?;
        // Ctrl-C and the end of the program are no failures of a track
        match raised {
            Some(raised) if !raised.is_instance_of::<pyo3::exceptions::PyException>(py) => {
                return Err(raised.into());
            }
            raised => outcomes.push((outcome, raised)),
        }
    }
    Ok(outcomes)
}

/// The sum of the log-likelihoods of the rows.
pub fn log_likelihood(answers: &[Answer]) -> f64 {
    answers.iter().map(|Answer { estimates, .. }| Estimates::total_log_likelihood(estimates)).sum()
}
