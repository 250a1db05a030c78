//! Answers: the estimates of all tracks, as CSV or JSON lines, in the order of the table's rows.

mod blocks;
mod csv;
mod destination;
mod jsonl;
mod simulated;

use core::num::NonZeroUsize;
use givens::Estimates;
use givens::scalar::Shown;
use std::io::{self, Write};

pub use destination::{Destination, DestinationError, make_folder, read_back};
pub use simulated::{Drawn, write_measurements, write_states};

use crate::model_file::Model;
use crate::table::{Row, Tracks};

/// How answers are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// `time[,track_id][,sensor],<state>…,<state>_std…,nis,nis_dof,log_likelihood`.
    #[default]
    Csv,
    /// One JSON object per row, with all matrices.
    Jsonl,
}

/// The answer for one track.
#[derive(Clone, Debug, Default, PartialEq)]
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

/// Writes the answers, one for each of the tracks, as one table in the order of the rows. The lines are made on so many threads,
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
    threads: Option<NonZeroUsize>,
) -> io::Result<()> {
    let mut lines = Vec::new();
    for (track, answer) in tracks.tracks.iter().zip(answers) {
        let end = answer.row + answer.estimates.len();
        let begin = if answer.from_first { answer.row } else { 0 };
        for (k, row) in track.rows.iter().enumerate().take(end).skip(begin) {
            let estimate = k.checked_sub(answer.row).map(|at| (&answer.estimates, at));
            let sensor = row.sensor.and_then(|i| model.sensors.get(i)).map(|sensor| sensor.name.as_str());
            let started = answer.started && k == answer.row;
            lines.push(Line { track: track.id.as_deref(), row, sensor, estimate, started });
        }
    }
    lines.sort_by_key(|line| line.row.index);
    match format {
        Format::Csv => {
            out.write_all(&csv::header(model, tracks)?)?;
            blocks::write(out, &lines, threads, |lines| csv::rows(model, tracks, lines))?;
        }
        Format::Jsonl => {
            let smoothed = answers.iter().any(|answer| answer.estimates.is_smoothed());
            blocks::write(out, &lines, threads, |lines| jsonl::rows(model, smoothed, lines))?;
        }
    }
    out.flush()
}
