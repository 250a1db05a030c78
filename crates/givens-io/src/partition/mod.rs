//! Tables cut into Parquet files that hold whole tracks, each in the order of time: what can be run file by file.

mod alike;
mod csv;
mod rows;
mod sorted;

use std::collections::HashMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::{RecordBatch, UInt64Array};
use arrow_ipc::reader::StreamReader;
use arrow_ipc::writer::StreamWriter;
use arrow_schema::{Field, FieldRef, Schema, SchemaRef};
use arrow_select::concat::concat_batches;
use arrow_select::take::take_record_batch;

use crate::decode::{Kind, floats, integers, kind};
use crate::error::{InputError, InputErrors};
use crate::files::UNFINISHED;
use crate::source::whole;
use alike::alike;
use rows::{Table, names};

/// Files that are written at once; of more the data is gone over again.
const TOGETHER: usize = 256;

/// What the column of tracks is called where it is read.
const TRACK: &str = "track_id";

/// How a table is cut.
#[derive(Clone, Debug)]
pub struct Partition {
    /// The column that names the track of each row.
    pub by: String,
    /// Rows that a file has at least, but for the last one.
    pub rows: usize,
}

/// What was written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Partitioned {
    /// Files.
    pub files: usize,
    /// Tracks.
    pub tracks: usize,
    /// Rows.
    pub rows: usize,
}

/// Where each track goes.
struct Places {
    /// The file of each track, and its place among all.
    of: HashMap<String, (usize, usize)>,
    files: usize,
    rows: usize,
}

impl Partition {
    /// Cuts the tables, CSV or Parquet, which have the same columns, into files `part-00000.parquet` … in a folder, with the
    /// column of tracks under the name `track_id`. Until all are written they end in `.unfinished`. Tracks stand in the
    /// order in which they are first named, the rows of each in the order of time; row groups hold whole tracks. The rows of a
    /// file are held in memory at once, and some 100 bytes for each track; all rows lie in a temporary file meanwhile.
    ///
    /// # Errors
    /// Tables that cannot be read, or whose columns differ; a row without track or time; a folder that has such files already, or
    /// cannot be written.
    pub fn write(&self, tables: &[PathBuf], folder: &Path) -> Result<Partitioned, InputErrors> {
        let told = folder.display().to_string();
        let failed = |error: std::io::Error| whole(&told, format!("cannot be written: {error}"));
        if self.by == "time" {
            let error = whole("--by time", "that is the column of times, which files of tracks have too");
            return Err(error.with_help("name the column of tracks").into());
        }
        crate::make_folder(folder).map_err(|error| whole(&told, error.to_string()))?;
        let there = [name(0), unfinished(&name(0))].into_iter().find(|name| folder.join(name).exists());
        if let Some(there) = there {
            let error = whole(&told, format!("there is a {there} in this folder already"));
            return Err(error.with_help("name another folder, or remove the files").into());
        }
        let mut opened = Vec::new();
        for path in tables {
            opened.push(Table::open(path, &self.by)?);
        }
        let schema = self.called(&opened)?;
        let places = self.places(&opened)?;
        let written = self.fill(&opened, &schema, &places, folder);
        if written.is_err() {
            // nothing has its name yet: the folder may be cut into again
            for file in 0..places.files {
                let _ = std::fs::remove_file(folder.join(unfinished(&name(file))));
            }
        }
        written?;
        for file in 0..places.files {
            let (from, to) = (folder.join(unfinished(&name(file))), folder.join(name(file)));
            std::fs::rename(from, to).map_err(failed)?;
        }
        Ok(Partitioned { files: places.files, tracks: places.of.len(), rows: places.rows })
    }

    /// Writes the files, under the names that they have until all are there.
    fn fill(
        &self,
        opened: &[Table],
        schema: &SchemaRef,
        places: &Places,
        folder: &Path,
    ) -> Result<(), InputErrors> {
        let failed = |error: std::io::Error| {
            whole(&folder.display().to_string(), format!("cannot be written: {error}"))
        };
        for from in (0..places.files).step_by(TOGETHER) {
            let files = from..(from + TOGETHER).min(places.files);
            let spools = self.spread(opened, schema, places, files.clone()).map_err(|error| match error {
                Broken::Input(error) => error,
                Broken::Output(error) => meanwhile(&error),
            })?;
            for (file, spool) in files.zip(spools) {
                let rows = read_back(spool).map_err(|error| meanwhile(&error))?;
                let rows =
                    concat_batches(schema, &rows).map_err(|error| failed(std::io::Error::other(error)))?;
                let path = folder.join(unfinished(&name(file)));
                sorted::write(&path, &rows, TRACK, &places.of).map_err(failed)?;
            }
        }
        Ok(())
    }

    /// The columns that all tables have, with that of tracks under its usual name.
    fn called(&self, tables: &[Table]) -> Result<SchemaRef, InputErrors> {
        let schema = alike(tables)?;
        if self.by == TRACK {
            return Ok(schema);
        }
        if let (Ok(_), Some(table)) = (schema.field_with_name(TRACK), tables.first()) {
            let message = format!("the column `{}` would be called `{TRACK}`, and there is one", self.by);
            return Err(whole(&table.name, message).with_help("cut by `track_id`, or rename it").into());
        }
        let renamed = |field: &FieldRef| {
            let is_track = field.name() == &self.by;
            if is_track { Arc::new(Field::clone(field).with_name(TRACK)) } else { Arc::clone(field) }
        };
        let fields: Vec<FieldRef> = schema.fields().iter().map(renamed).collect();
        Ok(Arc::new(Schema::new_with_metadata(fields, schema.metadata().clone())))
    }

    /// Goes over the tables once, for the names and lengths of their tracks.
    fn places(&self, tables: &[Table]) -> Result<Places, InputErrors> {
        let (mut found, mut lengths) = (HashMap::<String, usize>::new(), Vec::new());
        for table in tables {
            let mut row = 0;
            for batch in table.batches(Some(&[&self.by, "time"]))? {
                let batch = batch?;
                let at = |k: usize, what: &str| {
                    let message = format!("row {}: a row has no {what}", row + k + 1);
                    whole(&table.name, message).with_help("give it one, or leave the row out")
                };
                if let Some(k) = batch.column_by_name("time").and_then(|time| untimed(time.as_ref())) {
                    return Err(at(k, "time").into());
                }
                for (k, id) in names(&batch, &self.by).into_iter().enumerate() {
                    let Some(id) = id else { return Err(at(k, &format!("`{}`", self.by)).into()) };
                    let next = found.len();
                    let track = *found.entry(id).or_insert(next);
                    if track == lengths.len() {
                        lengths.push(0_usize);
                    }
                    lengths[track] += 1;
                }
                row += batch.num_rows();
            }
        }
        let (mut file, mut held, mut files) = (0, 0, Vec::new());
        for &length in &lengths {
            if held >= self.rows.max(1) {
                (file, held) = (file + 1, 0);
            }
            held += length;
            files.push(file);
        }
        let rows = lengths.iter().sum();
        let of = found.into_iter().map(|(id, track)| (id, (files[track], track))).collect();
        Ok(Places { of, files: if rows > 0 { file + 1 } else { 0 }, rows })
    }

    /// Goes over the tables again, and lays the rows of each of these files together.
    fn spread(
        &self,
        tables: &[Table],
        schema: &SchemaRef,
        places: &Places,
        files: core::ops::Range<usize>,
    ) -> Result<Vec<File>, Broken> {
        let mut spools = files
            .clone()
            .map(|_| StreamWriter::try_new(tempfile::tempfile()?, schema).map_err(other))
            .collect::<std::io::Result<Vec<_>>>()?;
        for table in tables {
            for batch in table.batches(None).map_err(Broken::Input)? {
                let batch = batch.map_err(Broken::Input)?;
                let mut rows = vec![Vec::new(); files.len()];
                for (k, id) in names(&batch, &self.by).into_iter().enumerate() {
                    let place = id.and_then(|id| places.of.get(&id)).map(|(file, _)| *file);
                    if let Some(file) = place.filter(|file| files.contains(file)) {
                        rows[file - files.start].push(k as u64);
                    }
                }
                for (spool, rows) in spools.iter_mut().zip(rows).filter(|(_, rows)| !rows.is_empty()) {
                    let of_file = if rows.len() == batch.num_rows() {
                        batch.clone()
                    } else {
                        take_record_batch(&batch, &UInt64Array::from(rows)).map_err(other)?
                    };
                    let of_file = RecordBatch::try_new(Arc::clone(schema), of_file.columns().to_vec());
                    spool.write(&of_file.map_err(other)?).map_err(other)?;
                }
            }
        }
        spools.into_iter().map(|spool| Ok(spool.into_inner().map_err(other)?)).collect()
    }
}

/// Why rows could not be laid together.
enum Broken {
    Input(InputError),
    Output(std::io::Error),
}

impl From<std::io::Error> for Broken {
    fn from(error: std::io::Error) -> Self {
        Self::Output(error)
    }
}

/// Rows that could not be held in a temporary file.
fn meanwhile(error: &std::io::Error) -> InputError {
    let folder = std::env::temp_dir();
    whole(&folder.display().to_string(), format!("rows cannot be held in this folder meanwhile: {error}"))
        .with_help("set TMPDIR to a folder with as much room as the tables take")
}

fn other(error: arrow_schema::ArrowError) -> std::io::Error {
    std::io::Error::other(error)
}

fn read_back(mut spool: File) -> std::io::Result<Vec<RecordBatch>> {
    use std::io::Seek;
    spool.rewind()?;
    StreamReader::try_new(std::io::BufReader::new(spool), None)
        .map_err(other)?
        .map(|batch| batch.map_err(other))
        .collect()
}

/// The name of a file until all are written: a folder in which there is one is not read.
fn unfinished(name: &str) -> String {
    format!("{name}{UNFINISHED}")
}

fn name(file: usize) -> String {
    format!("part-{file:05}.parquet")
}

/// The first row without a time.
fn untimed(time: &dyn arrow_array::Array) -> Option<usize> {
    match kind(time.data_type()) {
        Kind::Number | Kind::Whole | Kind::Unsigned => floats(time).iter().position(|t| t.is_nan()),
        Kind::Text => (0..time.len()).find(|&k| time.is_null(k)),
        _ => integers(time).iter().position(Option::is_none),
    }
}
