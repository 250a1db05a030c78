//! Answers: the estimates of all tracks, as CSV, JSON lines or Parquet, in the order of the table's rows.

mod blocks;
mod columns;
mod csv;
mod destination;
mod jsonl;
mod lent;
mod place;
mod simulated;
mod written;

use core::num::NonZeroUsize;
use givens::Estimates;
use givens::scalar::Shown;
use std::borrow::Cow;
use std::io::{self, Write};

pub use destination::{Destination, DestinationError, make_folder, read_back};
pub use lent::{FailedTrack, LentAnswers};
pub(crate) use place::settle_name;
pub use simulated::{Drawn, write_measurements, write_states};
pub use written::Written;

use crate::table::{Row, Track, Tracks};

/// How answers are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// `time[,track_id][,sensor],<state>…,<state>_std…,nis,nis_dof,log_likelihood[,gated]`.
    #[default]
    Csv,
    /// One JSON object per row, with all matrices.
    Jsonl,
    /// The columns of the CSV in a Parquet file, or others by its [`Layout`].
    Parquet,
}

/// The columns of a Parquet file of answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Those of the CSV.
    #[default]
    Wide,
    /// These, and `cov`: of each row the lower triangle of the covariance, row by row, as a list of n (n + 1) / 2 numbers.
    Covariances,
    /// `time[,track_id][,sensor],state,mean,std`, with a row for each state.
    Tidy,
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

/// The lines of these parts, whose rows these are, in the order of the table.
fn lines<'a>(tracks: &'a Tracks, parts: &[Part<'a>], stretches: &'a [Cow<'a, [Row]>]) -> Vec<Line<'a>> {
    let mut lines = Vec::new();
    for (&Part { track, from, row: first, started, estimates }, rows) in parts.iter().zip(stretches) {
        for (k, row) in (from..).zip(rows.iter()) {
            let estimate = k.checked_sub(first).map(|at| (estimates, at));
            let sensor = row.sensor.and_then(|i| tracks.scheme.sensors.get(i));
            let sensor = sensor.map(|sensor| sensor.name.as_str());
            let started = started && k == first;
            lines.push(Line { track: track.id.as_deref(), row, sensor, estimate, started });
        }
    }
    lines.sort_by_key(|line| line.row.index);
    lines
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

/// How answers are written. The lines are made on so many threads, all cores where it is not said, and are the same for any.
#[derive(Clone, Copy, Debug)]
pub struct AnswerWriter<'a> {
    /// As what.
    pub format: Format,
    /// With which columns, of a Parquet file.
    pub layout: Layout,
    /// The table, for its columns and the names of the model.
    pub tracks: &'a Tracks,
    /// Whether the filtered belief stands beside the smoothed one, in JSON lines.
    pub smoothed: bool,
    /// Whether it is told which rows were beyond the gate.
    pub gated: bool,
    /// How many.
    pub threads: Option<NonZeroUsize>,
}

/// Answers that are written part by part.
pub struct Answers<'a> {
    by: AnswerWriter<'a>,
    columns: Option<columns::Columns>,
}

impl<'a> AnswerWriter<'a> {
    /// Writes what stands above the rows.
    ///
    /// # Errors
    /// What the writer says.
    pub fn begin(self, out: &mut dyn Write) -> io::Result<Answers<'a>> {
        let mut columns = None;
        match self.format {
            Format::Csv => out.write_all(&csv::header(self.tracks, self.gated)?)?,
            Format::Jsonl => {}
            Format::Parquet => columns = Some(columns::Columns::begin(&self, out)?),
        }
        Ok(Answers { by: self, columns })
    }

    /// Goes on behind rows that stand there; a Parquet file cannot be gone on with, and gets no rows.
    #[must_use]
    pub fn behind(self) -> Answers<'a> {
        Answers { by: self, columns: None }
    }
}

impl Answers<'_> {
    /// Writes the rows of some parts in the order of the table.
    ///
    /// # Errors
    /// What the writer says.
    pub fn rows(&mut self, out: &mut dyn Write, parts: &[Part]) -> io::Result<()> {
        let AnswerWriter { format, tracks, smoothed, gated, threads, .. } = self.by;
        let stretches = parts.iter().map(Part::rows).collect::<io::Result<Vec<_>>>()?;
        let lines = lines(tracks, parts, &stretches);
        match (format, &mut self.columns) {
            (Format::Csv, _) => blocks::write(out, &lines, threads, |lines| csv::rows(tracks, gated, lines)),
            (Format::Jsonl, _) => {
                blocks::write(out, &lines, threads, |lines| jsonl::rows(tracks, smoothed, gated, lines))
            }
            (Format::Parquet, Some(columns)) => columns.rows(&self.by, out, &lines),
            (Format::Parquet, None) => Err(io::Error::other("a Parquet file cannot be gone on with")),
        }
    }

    /// Writes what stands below the rows.
    ///
    /// # Errors
    /// What the writer says.
    pub fn end(self, out: &mut dyn Write) -> io::Result<()> {
        self.columns.map_or(Ok(()), |columns| columns.end(out))?;
        out.flush()
    }
}

impl AnswerWriter<'_> {
    /// Writes the answers, one for each of the tracks, as one table in the order of the rows.
    ///
    /// # Errors
    /// What the writer says.
    pub fn write(self, out: &mut dyn Write, answers: &[Answer]) -> io::Result<()> {
        let parts = self.tracks.tracks.iter().zip(answers).map(|(track, answer)| answer.part(track));
        let mut all = self.begin(out)?;
        all.rows(out, &parts.collect::<Vec<_>>())?;
        all.end(out)
    }
}
