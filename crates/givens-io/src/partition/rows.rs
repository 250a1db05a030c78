//! The rows of one table, whatever its kind.

use std::fs::File;
use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;
use parquet::arrow::ProjectionMask;

use super::csv;
use crate::decode::{Kind, integers, kind, texts, unsigned};
use crate::error::InputError;
use crate::findings::list;
use crate::pages::{self, Pages};
use crate::source::{unreadable, whole};
use crate::table::{is_parquet, names_things, unpackable, unreadable_parquet, whole_chunks};

/// Rows that are decoded at once.
const ROWS: usize = 1 << 16;

/// A table, of which the columns are known.
pub(super) struct Table {
    pub name: String,
    path: PathBuf,
    pub schema: SchemaRef,
    kind: Of,
}

enum Of {
    Parquet,
    Csv(csv::Types),
}

/// Rows of it, some at a time.
pub(super) type Batches<'a> = Box<dyn Iterator<Item = Result<RecordBatch, InputError>> + 'a>;

impl Table {
    /// Opens a table that has a column `by`, which names tracks, and one of times.
    pub fn open(path: &Path, by: &str) -> Result<Self, InputError> {
        let name = path.display().to_string();
        let mut file = File::open(path).map_err(|error| whole(&name, unreadable(&error)))?;
        let (schema, of) = if is_parquet(&mut file).map_err(|error| whole(&name, unreadable(&error)))? {
            let builder = pages::open(file).map_err(|error| unreadable_parquet(&name, &error))?;
            whole_chunks(&name, builder.metadata())?;
            unpackable(&name, builder.metadata(), &ProjectionMask::all())?;
            (SchemaRef::clone(builder.schema()), Of::Parquet)
        } else {
            let types = csv::Types::of(&name, file, by)?;
            (types.schema(), Of::Csv(types))
        };
        for column in [by, "time"] {
            let Ok(field) = schema.field_with_name(column) else {
                let names = list(schema.fields().iter().map(|field| field.name().as_str()));
                let error = whole(&name, format!("the table has no column `{column}`: it has {names}"));
                return Err(error.with_help("name the column of tracks with --by; that of times is `time`"));
            };
            if kind(field.data_type()) == Kind::Other || column == by && !names_things(field.data_type()) {
                let error = whole(&name, format!("`{column}` holds {}", field.data_type()));
                let help = "tracks are named by words or whole numbers, times are numbers or dates";
                return Err(error.with_help(help));
            }
        }
        Ok(Self { name, path: path.to_owned(), schema, kind: of })
    }

    /// Its rows, of these columns or of all.
    pub fn batches(&self, columns: Option<&[&str]>) -> Result<Batches<'_>, InputError> {
        let file = File::open(&self.path).map_err(|error| whole(&self.name, unreadable(&error)))?;
        let Of::Csv(types) = &self.kind else {
            let wrong = |error: String| unreadable_parquet(&self.name, &error);
            let builder = pages::open(file).map_err(wrong)?;
            let wanted = |name: &str| columns.is_none_or(|columns| columns.contains(&name));
            let fields = builder.schema().fields().iter().enumerate();
            let roots = fields.filter(|(_, field)| wanted(field.name())).map(|(k, _)| k);
            let mask = ProjectionMask::roots(builder.parquet_schema(), roots.collect::<Vec<_>>());
            let pages = Pages::of(builder.with_projection(mask).with_batch_size(ROWS)).map_err(wrong)?;
            return Ok(Box::new(pages.map(move |batch| batch.map_err(wrong))));
        };
        Ok(Box::new(types.batches(&self.name, file, ROWS)))
    }
}

/// The names in a column.
pub(super) fn names(batch: &RecordBatch, column: &str) -> Vec<Option<String>> {
    let Some(array) = batch.column_by_name(column) else { return vec![None; batch.num_rows()] };
    match kind(array.data_type()) {
        Kind::Text => texts(array.as_ref())
            .into_iter()
            .map(|name| name.map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()))
            .collect(),
        Kind::Unsigned => {
            let there = |k: usize| !array.is_null(k);
            let all = unsigned(array.as_ref()).into_iter().enumerate();
            all.map(|(k, id)| there(k).then(|| id.to_string())).collect()
        }
        _ => integers(array.as_ref()).into_iter().map(|id| id.map(|id| id.to_string())).collect(),
    }
}
