//! Parquet files as tables: a batch of rows at a time, of the columns that mean something.

use core::fmt::Display;
use std::fs::File;
use std::io::{Read, Seek};

use parquet::arrow::ProjectionMask;
use parquet::basic::Compression;
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData, RowGroupMetaData};

use super::Tracks;
use super::batches::{Batches, line};
use super::reading::How;
use crate::error::{InputError, InputErrors};
use crate::findings::Findings;
use crate::pages::{self, Pages};
use crate::scheme::Scheme;
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
pub(super) fn tracks(mut file: File, name: &str, scheme: &Scheme, how: How) -> Result<Tracks, InputErrors> {
    let fingerprint = sum(&mut file).map_err(|error| whole(name, unreadable(&error)))?;
    let wrong = |error: &dyn Display| broken(name, error);
    let builder = pages::open(file).map_err(|error| wrong(&error))?;
    whole_chunks(name, builder.metadata())?;
    let names: Vec<String> = builder.schema().fields().iter().map(|field| field.name().clone()).collect();
    let source = Source::new(name, line(&names));
    let findings = Findings::new(&source);
    let Some(mut table) = Batches::open(&findings, builder.schema(), scheme, how) else {
        return findings.finish(None);
    };
    let mask = ProjectionMask::roots(builder.parquet_schema(), table.read.iter().copied());
    unpackable(name, builder.metadata(), &mask)?;
    let builder = builder.with_projection(mask).with_batch_size(ROWS);
    let reader = Pages::of(builder).map_err(|error| wrong(&error))?;
    table.take(&findings, reader, &wrong)?;
    table.reading.end(findings, fingerprint)
}

/// The error of a file that cannot be read.
pub(crate) fn broken(name: &str, error: &dyn Display) -> InputError {
    let help = "write it anew, or as CSV; compressed with zstd, snappy or not at all";
    whole(name, format!("this Parquet file cannot be read: {error}")).with_help(help)
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

/// Makes sure that the columns of a mask are compressed by what is known here.
pub(crate) fn unpackable(
    name: &str,
    about: &ParquetMetaData,
    mask: &ProjectionMask,
) -> Result<(), InputError> {
    let chunks = about.row_groups().iter().flat_map(|group| group.columns().iter().enumerate());
    let known = |by| matches!(by, Compression::UNCOMPRESSED | Compression::SNAPPY | Compression::ZSTD(_));
    match chunks.filter(|(leaf, _)| mask.leaf_included(*leaf)).find(|(_, chunk)| !known(chunk.compression()))
    {
        Some((_, chunk)) => {
            let by = chunk.compression().to_string();
            let by = by.split('(').next().unwrap_or_default().to_lowercase();
            let error = whole(name, format!("`{}` is compressed by {by}", chunk.column_path().string()));
            Err(error.with_help("write it anew, or as CSV; compressed with zstd, snappy or not at all"))
        }
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
