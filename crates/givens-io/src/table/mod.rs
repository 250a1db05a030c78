//! Tables of measurements, as CSV or Parquet, and of true states, as CSV.

mod batches;
mod cell;
mod cells;
mod check;
mod chunks;
mod columnar;
mod header;
mod parquet;
mod reading;
mod row;
mod rows;
mod sheet;
mod spool;
#[cfg(test)]
mod tests;
mod time;
mod truth;

pub use batches::lent_tracks;
pub(crate) use batches::names_things;
pub(crate) use parquet::{MAGIC, broken as unreadable_parquet, is_parquet, unpackable, whole_chunks};
pub use rows::Rows;
pub use time::Calendar;
pub use truth::{Truth, parse_truth, read_truth};

use std::fs::File;
use std::io::{self, Read};

use serde::{Deserialize, Serialize};

use crate::error::InputErrors;
use crate::model_file::Model;
use crate::scheme::Scheme;
use crate::source::{called, unreadable, whole};
use chunks::Chunks;
use reading::How;

/// The rows of a table, track by track.
#[derive(Clone, Debug)]
pub struct Tracks {
    /// What the table was read for.
    pub scheme: Scheme,
    /// The tracks in the order in which the table first names them; a table without `track_id` is one track.
    pub tracks: Vec<Track>,
    /// Tracks that were left out, in the order of the rows that are wrong.
    pub refused: Vec<Refused>,
    /// Columns that the model does not use.
    pub ignored: Vec<String>,
    /// Whether the table has the column `track_id`.
    pub has_track_id: bool,
    /// As what it names tracks.
    pub ids: Ids,
    /// Whether its times are instants of the calendar. The type of a column of dates says so, whatever rows there are.
    pub dated: bool,
    /// Whether the table has the column `sensor`.
    pub has_sensor: bool,
    /// The least and the most of each measure of the stack; none where no row has it.
    pub ranges: Vec<Option<[f64; 2]>>,
    /// Tells the text of the table from others.
    pub fingerprint: String,
}

/// What the names of tracks are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ids {
    /// Words, and all that stands in a text.
    #[default]
    Words,
    /// Whole numbers of up to 64 bits with their sign, in a table of columns.
    Whole,
    /// Whole numbers from 0 up to 2⁶⁴ − 1, in a table of columns.
    Unsigned,
}

/// A track that was left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// The cell of `track_id`; none for a row that names no track, or in a table without tracks.
    pub id: Option<String>,
    /// The row that is wrong, over the whole table, from zero.
    pub row: usize,
    /// What is wrong, and the remedy.
    pub message: String,
}

/// One track: rows in time order.
#[derive(Clone, Debug)]
pub struct Track {
    /// The cell of `track_id`.
    pub id: Option<String>,
    /// The time at which the initial belief holds: `[state] time`, or the first row's.
    pub start: f64,
    /// The rows. Never empty.
    pub rows: Rows,
    /// The instant from which the times of the track count, if the table gives them in RFC 3339.
    pub origin: Option<Calendar>,
}

/// One row of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Line in the file, from one.
    pub line: usize,
    /// Row over the whole file, from zero: the order of the output.
    pub index: usize,
    /// Time in seconds.
    pub time: f64,
    /// Time as the table gives it.
    pub time_text: String,
    /// The sensor that the row names, as an index into [`Model::sensors`].
    pub sensor: Option<usize>,
    /// The measures of all sensors in model order, length d; NaN where the row has none.
    pub z: Vec<f64>,
    /// The controls in the order of [`Model::controls`].
    pub u: Vec<f64>,
}

impl Tracks {
    /// Whether the rows of each track stand together in the table.
    #[must_use]
    pub fn in_turn(&self) -> bool {
        let mut next = 0;
        self.tracks.iter().all(|track| {
            let index = |row: Option<&Row>| row.map(|row| row.index);
            let begins = index(track.rows.first()) == Some(next);
            next += track.rows.len();
            begins && index(track.rows.last()) == next.checked_sub(1)
        })
    }
}

impl Row {
    /// Whether the row brings a measure; one without any asks for the prediction at its time.
    pub fn measured(&self) -> bool {
        self.z.iter().any(|value| !value.is_nan())
    }
}

impl Track {
    /// A time of this track in words: RFC 3339 if the table's times are, else seconds.
    pub fn time_text(&self, time: f64) -> String {
        time::time_text(self.origin, time)
    }

    /// Reads a time on the axis of this track: seconds, or RFC 3339 if the table's times are.
    ///
    /// # Errors
    /// What is wrong with the text, in words.
    pub fn parse_time(&self, text: &str) -> Result<f64, String> {
        match (text.trim().parse::<f64>(), self.origin) {
            (Ok(seconds), _) if seconds.is_finite() => Ok(seconds),
            (Ok(_), _) => Err(format!("`{text}` is not a finite time")),
            (Err(_), Some(origin)) => Calendar::parse(text.trim()).map(|instant| instant.since(origin)),
            (Err(_), None) => Err(format!("`{text}` is not a time in seconds, as the table's are")),
        }
    }
}

/// Reads the measurements for a model from a CSV or a Parquet file, or as CSV from standard input for `-`.
///
/// Times are seconds, or RFC 3339. The latter count from `[state] time` if that is such a time too, else from the
/// first row of each track; a number of `[state] time` then places the belief that many seconds after the first row.
///
/// Some 500,000 rows are held in memory. The others of a longer table, and so of standard input, lie in a temporary file.
///
/// # Errors
/// Everything that is wrong with the table, by line, column and name.
pub fn read_tracks(path: &str, model: &Model) -> Result<Tracks, InputErrors> {
    read(path, &model.scheme(), How::default())
}

/// [`read_tracks`] for whatever model a scheme is of. A track with a row that is wrong is left out, and named among
/// [`Tracks::refused`]; the others stay.
///
/// # Errors
/// What is wrong with the table as a whole: its header, or a file that cannot be read.
pub fn read_tracks_apart(path: &str, scheme: &Scheme) -> Result<Tracks, InputErrors> {
    read(path, scheme, How { apart: true, ..How::default() })
}

/// Reads a table of rows to simulate, which need only bring times, and the controls of the model if it has some. `z` is
/// NaN where a row shall have no measure: if the table has columns of measures, where their cells are empty; if not,
/// at the measures of other sensors than the one that the row names.
///
/// # Errors
/// As [`read_tracks`].
pub fn read_times(path: &str, model: &Model) -> Result<Tracks, InputErrors> {
    read(path, &model.scheme(), How { measured: false, ..How::default() })
}

/// [`read_tracks`] from a text; errors call it `name`.
///
/// # Errors
/// As [`read_tracks`].
pub fn parse_tracks(text: &str, name: &str, model: &Model) -> Result<Tracks, InputErrors> {
    tracks(&mut text.as_bytes(), name, &model.scheme(), How::default())
}

fn read(path: &str, scheme: &Scheme, how: How) -> Result<Tracks, InputErrors> {
    let name = called(path);
    if path == "-" {
        return tracks(&mut io::stdin().lock(), name, scheme, how);
    }
    let mut file = File::open(path).map_err(|error| whole(name, unreadable(&error)))?;
    let found = file.metadata().is_ok_and(|about| about.is_file())
        && parquet::is_parquet(&mut file).map_err(|error| whole(name, unreadable(&error)))?;
    if found {
        return parquet::tracks(file, name, scheme, how);
    }
    tracks(&mut file, name, scheme, how)
}

fn tracks(text: &mut dyn Read, name: &str, scheme: &Scheme, how: How) -> Result<Tracks, InputErrors> {
    reading::tracks(Chunks::new(name, text, chunks::USUAL), name, scheme, how)
}
