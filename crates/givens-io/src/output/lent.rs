//! Answers as record batches, for whoever takes them over.

use std::io;
use std::sync::Arc;

use arrow_array::{
    ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray, TimestampNanosecondArray, UInt64Array,
    new_null_array,
};
use arrow_schema::{DataType, Field, Schema, SchemaRef};

use super::columns::{arrays, instant, schema};
use super::{AnswerWriter, Layout, Line, Part, lines};

/// A track that failed, as a row behind those that it has.
#[derive(Clone, Debug, Default)]
pub struct FailedTrack {
    /// Its name; none in a table without tracks, or of a row without a name.
    pub id: Option<String>,
    /// When: as its table gives times, if it can be told.
    pub time_text: Option<String>,
    /// Why, and the remedy.
    pub message: String,
}

/// The columns of a Parquet file of answers, and `error`: null but in rows of tracks that failed, where the others are.
pub struct LentAnswers<'a> {
    by: AnswerWriter<'a>,
    schema: SchemaRef,
    /// The batches of the table with the first row of each, where they are at hand.
    table: Vec<(usize, RecordBatch)>,
}

impl<'a> LentAnswers<'a> {
    /// Of a table with these batches, or of one without: columns that are wanted as they are there are lent on from them.
    #[must_use]
    pub fn new(by: AnswerWriter<'a>, table: &[RecordBatch]) -> Self {
        let Schema { fields, metadata } = schema(&by);
        let mut all: Vec<Field> =
            fields.iter().map(|field| Field::clone(field).with_nullable(true)).collect();
        all.push(Field::new("error", DataType::Utf8, true));
        let mut first = 0;
        let at = |batch: &RecordBatch| {
            first += batch.num_rows();
            (first - batch.num_rows(), batch.clone())
        };
        let table = table.iter().map(at).collect();
        Self { by, schema: Arc::new(Schema::new_with_metadata(all, metadata)), table }
    }

    /// Names, types and what is said about the model.
    #[must_use]
    pub fn schema(&self) -> SchemaRef {
        Arc::clone(&self.schema)
    }

    /// The rows of these parts in the order of the table.
    ///
    /// # Errors
    /// Rows that cannot be read from the disk; times beyond what nanoseconds count.
    pub fn rows(&self, parts: &[Part]) -> io::Result<RecordBatch> {
        let stretches = parts.iter().map(Part::rows).collect::<io::Result<Vec<_>>>()?;
        let lines = lines(self.by.tracks, parts, &stretches);
        let mut columns = arrays(&self.by, &lines).map_err(io::Error::other)?;
        for (column, field) in columns.iter_mut().zip(self.schema.fields()) {
            if let Some(own) = self.lent(field, &lines) {
                *column = own;
            }
        }
        columns.push(new_null_array(&DataType::Utf8, columns.first().map_or(0, |column| column.len())));
        RecordBatch::try_new(self.schema(), columns).map_err(io::Error::other)
    }

    /// Times, and names that are numbers, where they stand in the table, if the lines are rows of it that lie together.
    fn lent(&self, field: &Field, lines: &[Line]) -> Option<ArrayRef> {
        let tidy = self.by.layout == Layout::Tidy;
        let together = lines.windows(2).all(|two| two[0].row.index + 1 == two[1].row.index);
        let from = lines.first().map(|line| line.row.index)?;
        if tidy
            || !together
            || !["time", "track_id"].contains(&field.name().as_str())
            || *field.data_type() == DataType::Utf8
        {
            return None;
        }
        let (first, batch) = self.table.iter().rev().find(|(first, _)| *first <= from)?;
        let column = batch.column_by_name(field.name())?;
        let fits = column.data_type() == field.data_type() && from - first + lines.len() <= column.len();
        fits.then(|| column.slice(from - first, lines.len()))
    }

    /// A row for each of these tracks.
    ///
    /// # Errors
    /// Times beyond what nanoseconds count.
    pub fn failed(&self, tracks: &[FailedTrack]) -> io::Result<RecordBatch> {
        let ids = tracks.iter().map(|track| track.id.as_deref());
        let texts = tracks.iter().map(|track| track.time_text.as_deref());
        let mut columns: Vec<ArrayRef> = Vec::new();
        for field in self.schema.fields() {
            columns.push(match (field.name().as_str(), field.data_type()) {
                ("time", DataType::Float64) => {
                    Arc::new(texts.clone().map(|text| text?.parse::<f64>().ok()).collect::<Float64Array>())
                }
                ("time", _) => {
                    let instants = texts.clone().map(|text| text.map(instant).transpose());
                    let instants = instants.collect::<Result<Vec<_>, _>>().map_err(io::Error::other)?;
                    Arc::new(TimestampNanosecondArray::from(instants).with_timezone("UTC"))
                }
                ("track_id", DataType::Int64) => {
                    Arc::new(ids.clone().map(|id| id?.parse::<i64>().ok()).collect::<Int64Array>())
                }
                ("track_id", DataType::UInt64) => {
                    Arc::new(ids.clone().map(|id| id?.parse::<u64>().ok()).collect::<UInt64Array>())
                }
                ("track_id", _) => Arc::new(ids.clone().collect::<StringArray>()),
                ("error", _) => {
                    Arc::new(StringArray::from_iter_values(tracks.iter().map(|track| &track.message)))
                }
                (_, of) => new_null_array(of, tracks.len()),
            });
        }
        RecordBatch::try_new(self.schema(), columns).map_err(io::Error::other)
    }
}
