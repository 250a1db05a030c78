//! Tables in columns, a batch of rows at a time.

use core::fmt::Display;

use arrow_array::RecordBatch;
use arrow_schema::{ArrowError, DataType, Schema, SchemaRef};

use super::columnar::Block;
use super::header::Columns;
use super::reading::{self, How, Reading};
use super::{Ids, Tracks};
use crate::decode::{Kind, kind};
use crate::error::{InputError, InputErrors};
use crate::findings::Findings;
use crate::scheme::Scheme;
use crate::source::{Source, whole};

/// Reads the tracks of a table that another library lends, for whatever model a scheme is of; errors call it `name`, and its
/// rows by their numbers from one. A track with a row that is wrong is left out, and named among [`Tracks::refused`].
///
/// # Errors
/// What is wrong with the table as a whole: its columns, or batches that cannot be read.
pub fn lent_tracks(
    batches: impl Iterator<Item = Result<RecordBatch, ArrowError>>,
    schema: &SchemaRef,
    name: &str,
    scheme: &Scheme,
) -> Result<Tracks, InputErrors> {
    let names: Vec<String> = schema.fields().iter().map(|field| field.name().clone()).collect();
    let source = Source::new(name, line(&names));
    let findings = Findings::new(&source);
    let Some(mut table) =
        Batches::open(&findings, schema, scheme, How { apart: true, in_words: false, ..How::default() })
    else {
        return findings.finish(None);
    };
    let read = table.read.clone();
    table.take(&findings, batches.map(|batch| batch.and_then(|batch| batch.project(&read))), &|error| {
        whole(name, format!("the table cannot be read: {error}"))
    })?;
    table.reading.end(findings, String::new())
}

/// A table of columns of which a part was read.
pub(super) struct Batches {
    header: Vec<String>,
    /// The columns that mean something to the model.
    pub read: Vec<usize>,
    pub reading: Reading,
}

impl Batches {
    /// Understands the columns; what is wrong with them is found so.
    pub fn open(findings: &Findings, schema: &Schema, scheme: &Scheme, how: How) -> Option<Self> {
        let (sheet, mut reading) = reading::open(findings, scheme, how)?;
        let header = sheet.header;
        let of = |column: usize| schema.field(column).data_type();
        reading.ids = match reading.columns().track.map(|column| kind(of(column))) {
            Some(Kind::Whole) => Ids::Whole,
            Some(Kind::Unsigned) => Ids::Unsigned,
            _ => Ids::Words,
        };
        // words may be seconds too, but hardly are
        reading.dates = matches!(kind(of(reading.columns().time)), Kind::Date(..) | Kind::Text);
        let read: Vec<usize> = (0..header.len()).filter(|&column| reading.columns().reads(column)).collect();
        for &column in &read {
            if let Some(remedy) = unfit(of(column), column, reading.columns(), how.in_words) {
                let error = findings.source.whole(format!("`{}` holds {}", header[column], of(column)));
                findings.push(error.with_help(remedy));
            }
        }
        findings.none().then_some(Self { header, read, reading })
    }

    /// Takes in batches of the columns that are read.
    pub fn take<E: Display>(
        &mut self,
        findings: &Findings,
        batches: impl Iterator<Item = Result<RecordBatch, E>>,
        broken: &dyn Fn(&dyn Display) -> InputError,
    ) -> Result<(), InputError> {
        let mut before = 0;
        for batch in batches {
            let batch = batch.map_err(|error| broken(&error))?;
            let block = Block::read(&self.header, &batch, &self.read, self.reading.columns(), before);
            for row in block.rows() {
                self.reading.take(findings, &row).map_err(|error| broken(&error))?;
            }
            before += batch.num_rows();
        }
        Ok(())
    }
}

/// The names as the line that stands above a table of text, so that errors can show it.
pub(super) fn line(names: &[String]) -> String {
    let quoted = |name: &String| {
        let plain = !name.contains(['"', ',', '\n', '\r']) && !name.is_empty();
        if plain { name.clone() } else { format!("\"{}\"", name.replace('"', "\"\"")) }
    };
    names.iter().map(quoted).collect::<Vec<_>>().join(",")
}

/// What to do about a column of a type that cannot be what the column means.
fn unfit(of: &DataType, column: usize, columns: &Columns, in_words: bool) -> Option<&'static str> {
    let found = kind(of);
    if columns.track == Some(column) {
        return match of {
            _ if names_things(of) => None,
            DataType::Null => Some("give each row the name of its track, or leave the column out"),
            _ => Some("tracks are named by words or whole numbers: cast it to int64, or to words"),
        };
    }
    if columns.sensor == Some(column) {
        let fits = names_things(of) || *of == DataType::Null;
        return (!fits).then_some("sensors are named by words: cast it");
    }
    match found {
        Kind::Number | Kind::Whole | Kind::Unsigned | Kind::Duration(_) => None,
        Kind::Date(..) | Kind::Text if column == columns.time => None,
        Kind::Text if in_words => None,
        _ if column == columns.time => {
            Some("times are seconds, dates, or words in RFC 3339: cast it to float64 or a timestamp")
        }
        _ => Some("measures and controls are numbers, null where there is none: cast it to float64"),
    }
}

/// Whether a column of this type can name tracks and sensors.
pub(crate) fn names_things(of: &DataType) -> bool {
    matches!(kind(of), Kind::Text | Kind::Whole | Kind::Unsigned)
}
