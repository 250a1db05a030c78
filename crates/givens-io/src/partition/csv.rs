//! CSV as columns: what each holds is found by reading it once.

use std::fs::File;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray, TimestampNanosecondArray};
use arrow_schema::{DataType, Field, Schema, SchemaRef, TimeUnit};

use crate::error::InputError;
use crate::source::whole;
use crate::table::Calendar;

/// What the columns hold.
pub(super) struct Types(Vec<(String, Of)>);

#[derive(Clone, Copy, PartialEq, Eq)]
enum Of {
    Numbers,
    /// Times alone: other dates stay as they are written.
    Instants,
    Words,
}

impl Of {
    /// What holds this cell without a loss.
    fn cell(column: &str, cell: &str) -> Self {
        let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
        // 007 is a name, and a whole number of seventeen digits no longer itself as a number
        let digits = cell.trim_start_matches(['-', '+']);
        let whole = digits.bytes().all(|byte| byte.is_ascii_digit());
        let padded = digits.len() > 1 && digits.starts_with('0');
        match number {
            Some(number) if !whole || !padded && number.abs() < EXACT => Self::Numbers,
            None if column == "time" && instant(cell).is_some() => Self::Instants,
            _ => Self::Words,
        }
    }
}

/// From here on not every whole number is a number of its own.
const EXACT: f64 = 9_007_199_254_740_992.0;

type Reader = csv::Reader<File>;

impl Types {
    /// Reads a table to its end. Names of tracks and sensors are words, also where they look like numbers.
    pub fn of(name: &str, file: File, by: &str) -> Result<Self, InputError> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(file);
        let header = reader.headers().map_err(|error| broken(name, &error))?.clone();
        let words = |column: &str| column == by || column == "sensor" || column == "track_id";
        let mut found: Vec<Option<Of>> =
            header.iter().map(|column| words(column).then_some(Of::Words)).collect();
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(|error| broken(name, &error))? {
            for ((of, cell), column) in found.iter_mut().zip(&record).zip(&header) {
                if *of != Some(Of::Words) && !cell.is_empty() {
                    let own = Of::cell(column, cell);
                    // what is of two kinds stays as it is written
                    *of = Some(if of.is_none_or(|of| of == own) { own } else { Of::Words });
                }
            }
        }
        let of = |of: Option<Of>| of.unwrap_or(Of::Numbers);
        let all = header.iter().zip(found).map(|(column, found)| (column.to_owned(), of(found))).collect();
        Ok(Self(all))
    }

    /// The columns.
    pub fn schema(&self) -> SchemaRef {
        let field = |(name, of): &(String, Of)| {
            let of = match of {
                Of::Numbers => DataType::Float64,
                Of::Instants => DataType::Timestamp(TimeUnit::Nanosecond, Some("UTC".into())),
                Of::Words => DataType::Utf8,
            };
            Field::new(name, of, true)
        };
        Arc::new(Schema::new(self.0.iter().map(field).collect::<Vec<_>>()))
    }

    /// So many rows at a time.
    pub fn batches<'a>(
        &'a self,
        name: &'a str,
        file: File,
        rows: usize,
    ) -> impl Iterator<Item = Result<RecordBatch, InputError>> + 'a {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(file);
        core::iter::from_fn(move || self.next(name, &mut reader, rows).transpose())
    }

    fn next(&self, name: &str, reader: &mut Reader, rows: usize) -> Result<Option<RecordBatch>, InputError> {
        let mut cells: Vec<Vec<Option<String>>> = vec![Vec::new(); self.0.len()];
        let mut record = csv::StringRecord::new();
        let mut count = 0;
        while count < rows && reader.read_record(&mut record).map_err(|error| broken(name, &error))? {
            for (column, cell) in cells.iter_mut().zip(&record) {
                column.push((!cell.is_empty()).then(|| cell.to_owned()));
            }
            count += 1;
        }
        if count == 0 {
            return Ok(None);
        }
        let array = |((_, of), cells): (&(String, Of), Vec<Option<String>>)| -> ArrayRef {
            match of {
                Of::Numbers => {
                    Arc::new(cells.iter().map(|cell| cell.as_ref()?.parse().ok()).collect::<Float64Array>())
                }
                Of::Instants => Arc::new(
                    cells
                        .iter()
                        .map(|cell| instant(cell.as_deref()?))
                        .collect::<TimestampNanosecondArray>()
                        .with_timezone("UTC"),
                ),
                Of::Words => Arc::new(cells.into_iter().collect::<StringArray>()),
            }
        };
        let arrays = self.0.iter().zip(cells).map(array).collect();
        let batch = RecordBatch::try_new(self.schema(), arrays);
        batch.map(Some).map_err(|error| whole(name, error.to_string()))
    }
}

fn instant(text: &str) -> Option<i64> {
    i64::try_from(Calendar::parse(text).ok()?.nanoseconds()).ok()
}

fn broken(name: &str, error: &csv::Error) -> InputError {
    whole(name, format!("cannot be read: {error}"))
        .with_help("the rows have as many cells as the header, in UTF-8")
}
