//! Parquet files as tables: a batch of rows at a time, of the columns that mean something.

use std::fs::File;
use std::io::{Read, Seek};

use arrow_schema::DataType;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData, RowGroupMetaData};

use super::Tracks;
use super::columnar::Block;
use super::reading;
use crate::decode::{Kind, kind};
use crate::error::{InputError, InputErrors};
use crate::findings::Findings;
use crate::model_file::Model;
use crate::source::{Source, fingerprint, unreadable, whole};

/// The first bytes, and the last, of a Parquet file.
pub(crate) const MAGIC: &[u8] = b"PAR1";
/// Rows that are decoded at once.
const ROWS: usize = 1 << 16;

/// Whether a file is one; it is left at its beginning.
pub(crate) fn is_parquet(file: &mut File) -> std::io::Result<bool> {
    let mut first = [0; MAGIC.len()];
    let found = file.read_exact(&mut first).is_ok() && first == MAGIC;
    file.rewind()?;
    Ok(found)
}

/// Reads the rows, of which so many are held in memory.
pub(super) fn tracks(
    mut file: File,
    name: &str,
    model: &Model,
    measured: bool,
    held: usize,
) -> Result<Tracks, InputErrors> {
    let fingerprint = sum(&mut file).map_err(|error| whole(name, unreadable(&error)))?;
    let wrong = |error: &dyn core::fmt::Display| broken(name, error);
    let builder = ParquetRecordBatchReaderBuilder::try_new(file).map_err(|error| wrong(&error))?;
    whole_chunks(name, builder.metadata())?;
    let names: Vec<String> = builder.schema().fields().iter().map(|field| field.name().clone()).collect();
    let source = Source::new(name, line(&names));
    let findings = Findings::new(&source);
    let Some((sheet, mut reading)) = reading::open(&findings, model, measured, held) else {
        return findings.finish(None);
    };
    let header = sheet.header;
    let of = |column: usize| builder.schema().field(column).data_type();
    reading.whole_ids = reading.columns().track.is_some_and(|column| kind(of(column)) == Kind::Whole);
    let mut named = reading.columns().track.into_iter().chain(reading.columns().sensor);
    if let Some(column) = named.find(|&column| !names_things(of(column))) {
        let message = format!("`{}` holds {}", header[column], of(column));
        findings.push(
            findings.source.whole(message).with_help("name tracks and sensors by words or whole numbers"),
        );
        return findings.finish(None);
    }
    let read: Vec<usize> = (0..names.len()).filter(|&column| reading.columns().reads(column)).collect();
    let mask = ProjectionMask::roots(builder.parquet_schema(), read.iter().copied());
    let reader =
        builder.with_projection(mask).with_batch_size(ROWS).build().map_err(|error| wrong(&error))?;
    let mut before = 0;
    for batch in reader {
        let batch = batch.map_err(|error| wrong(&error))?;
        let block = Block::read(&header, &batch, &read, reading.columns(), before);
        for row in block.rows() {
            reading.take(&findings, &row).map_err(|error| whole(name, error.to_string()))?;
        }
        before += batch.num_rows();
    }
    reading.end(findings, fingerprint)
}

/// The names as the line that stands above a table of text, so that errors can show it.
fn line(names: &[String]) -> String {
    let quoted = |name: &String| {
        let plain = !name.contains(['"', ',', '\n', '\r']) && !name.is_empty();
        if plain { name.clone() } else { format!("\"{}\"", name.replace('"', "\"\"")) }
    };
    names.iter().map(quoted).collect::<Vec<_>>().join(",")
}

/// The error of a file that cannot be read.
pub(crate) fn broken(name: &str, error: &dyn core::fmt::Display) -> InputError {
    let help = "write it anew, or as CSV; compressed with zstd, snappy or not at all";
    whole(name, format!("this Parquet file cannot be read: {error}")).with_help(help)
}

/// Whether a column of this type can name tracks and sensors.
pub(crate) fn names_things(of: &DataType) -> bool {
    matches!(kind(of), Kind::Text | Kind::Whole | Kind::Unsigned)
}

/// Makes sure that no chunk of a column is said to begin before the file or to have a negative length.
pub(crate) fn whole_chunks(name: &str, about: &ParquetMetaData) -> Result<(), InputError> {
    let mut chunks = about.row_groups().iter().flat_map(RowGroupMetaData::columns);
    let wrong = |chunk: &&ColumnChunkMetaData| {
        let offsets = [Some(chunk.data_page_offset()), chunk.dictionary_page_offset()];
        chunk.compressed_size() < 0
            || chunk.num_values() < 0
            || offsets.into_iter().flatten().any(|at| at < 0)
    };
    match chunks.find(wrong) {
        Some(chunk) => Err(broken(name, &format!("the place of {} is damaged", chunk.column_path()))),
        None => Ok(()),
    }
}

/// Tells the file from others.
fn sum(file: &mut File) -> std::io::Result<String> {
    let (mut sum, mut length, mut bytes) = (crc32fast::Hasher::new(), 0, vec![0; 1 << 20]);
    loop {
        match file.read(&mut bytes)? {
            0 => break,
            read => {
                sum.update(&bytes[..read]);
                length += read as u64;
            }
        }
    }
    file.rewind()?;
    Ok(fingerprint(length, &sum))
}
