//! Answers: the estimates of all tracks, as CSV or JSON lines, in the order of the table's rows.

mod blocks;
mod csv;
mod destination;
mod jsonl;
mod place;
mod simulated;
mod written;

use core::num::NonZeroUsize;
use givens::Estimates;
use givens::scalar::Shown;
use std::borrow::Cow;
use std::io::{self, Write};

pub use destination::{Destination, DestinationError, make_folder, read_back};
pub(crate) use place::settle_name;
pub use simulated::{Drawn, write_measurements, write_states};
pub use written::Written;

use crate::model_file::Model;
use crate::table::{Row, Track, Tracks};

/// How answers are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// `time[,track_id][,sensor],<state>…,<state>_std…,nis,nis_dof,log_likelihood[,gated]`.
    #[default]
    Csv,
    /// One JSON object per row, with all matrices.
    Jsonl,
}

/// The answer for one track.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Answer {
    /// The estimates of the finished rows.
    pub estimates: Estimates,
    /// The row of the track that the first estimate is of.
    pub row: usize,
    /// The first estimate is the initial belief that `start` found: nothing was predicted or measured there.
    pub started: bool,
    /// Rows before the first estimate have no line of output, in place of an empty one.
    pub from_first: bool,
}

impl Answer {
    /// The lines that it has.
    #[must_use]
    pub fn part<'a>(&'a self, track: &'a Track) -> Part<'a> {
        let Self { ref estimates, row, started, from_first } = *self;
        Part { track, from: if from_first { row } else { 0 }, row, started, estimates }
    }
}

/// A row of output: a row of the table, and the estimate of it if there is one.
struct Line<'a> {
    track: Option<&'a str>,
    row: &'a Row,
    sensor: Option<&'a str>,
    estimate: Option<(&'a Estimates, usize)>,
    started: bool,
}

/// A number that reads back exactly, with an exponent where digits alone would be long.
fn digits(x: f64) -> String {
    Shown(x).to_string()
}

/// What the writer under a table said; in the error of the table its kind would be lost.
fn told(error: ::csv::Error) -> io::Error {
    match error.into_kind() {
        ::csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// Estimates of a stretch of the rows of one track.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// The track.
    pub track: &'a Track,
    /// The first row that has a line.
    pub from: usize,
    /// The row that the first estimate is of; those between have empty lines.
    pub row: usize,
    /// The first estimate is the initial belief that `start` found.
    pub started: bool,
    /// One for each row from `row` on.
    pub estimates: &'a Estimates,
}

impl<'a> Part<'a> {
    fn rows(&self) -> io::Result<Cow<'a, [Row]>> {
        self.track.rows.read(self.from..self.row + self.estimates.len())
    }
}

/// Writes answers part by part. The lines are made on so many threads, all cores where it is not said, and are the same for any.
#[derive(Clone, Copy, Debug)]
pub struct AnswerWriter<'a> {
    /// How.
    pub format: Format,
    /// The model, for its names.
    pub model: &'a Model,
    /// The table, for its columns.
    pub tracks: &'a Tracks,
    /// Whether the filtered belief stands beside the smoothed one, in JSON lines.
    pub smoothed: bool,
    /// Whether it is told which rows were beyond the gate.
    pub gated: bool,
    /// How many.
    pub threads: Option<NonZeroUsize>,
}

impl AnswerWriter<'_> {
    /// Writes what stands above the rows.
    ///
    /// # Errors
    /// What the writer says.
    pub fn header(&self, out: &mut dyn Write) -> io::Result<()> {
        match self.format {
            Format::Csv => out.write_all(&csv::header(self.model, self.tracks, self.gated)?),
            Format::Jsonl => Ok(()),
        }
    }

    /// Writes the rows of some parts in the order of the table.
    ///
    /// # Errors
    /// What the writer says.
    pub fn rows(&self, out: &mut dyn Write, parts: &[Part]) -> io::Result<()> {
        let Self { format, model, tracks, smoothed, gated, threads } = *self;
        let stretches = parts.iter().map(Part::rows).collect::<io::Result<Vec<_>>>()?;
        let mut lines = Vec::new();
        for (&Part { track, from, row: first, started, estimates }, rows) in parts.iter().zip(&stretches) {
            for (k, row) in (from..).zip(rows.iter()) {
                let estimate = k.checked_sub(first).map(|at| (estimates, at));
                let sensor = row.sensor.and_then(|i| model.sensors.get(i)).map(|sensor| sensor.name.as_str());
                let started = started && k == first;
                lines.push(Line { track: track.id.as_deref(), row, sensor, estimate, started });
            }
        }
        lines.sort_by_key(|line| line.row.index);
        match format {
            Format::Csv => {
                blocks::write(out, &lines, threads, |lines| csv::rows(model, tracks, gated, lines))
            }
            Format::Jsonl => {
                blocks::write(out, &lines, threads, |lines| jsonl::rows(model, smoothed, gated, lines))
            }
        }
    }
}

/// Writes the answers, one for each of the tracks, as one table in the order of the rows; with `gated`, it is told which rows
/// were beyond the gate. The lines are made on so many threads,
/// all cores where it is not said, and are the same for any.
///
/// # Errors
/// What the writer says.
pub fn write_answers(
    out: &mut dyn Write,
    format: Format,
    model: &Model,
    tracks: &Tracks,
    answers: &[Answer],
    gated: bool,
    threads: Option<NonZeroUsize>,
) -> io::Result<()> {
    let smoothed = answers.iter().any(|answer| answer.estimates.is_smoothed());
    let parts = tracks.tracks.iter().zip(answers).map(|(track, answer)| answer.part(track));
    let writer = AnswerWriter { format, model, tracks, smoothed, gated, threads };
    writer.header(out)?;
    writer.rows(out, &parts.collect::<Vec<_>>())?;
    out.flush()
}
