//! One file: its tracks one behind the other, each in the order of time, in row groups that hold whole tracks.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use arrow_array::{RecordBatch, UInt64Array};
use arrow_select::take::take_record_batch;
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, ZstdLevel};
use parquet::file::properties::WriterProperties;

use super::rows::names;
use crate::decode::{Kind, floats, integers, kind, texts};
use crate::table::Calendar;

/// Rows that a row group has at least, but for the last one.
const GROUP: usize = 1 << 17;

/// Writes the rows.
pub(super) fn write(
    path: &Path,
    rows: &RecordBatch,
    by: &str,
    places: &HashMap<String, (usize, usize)>,
) -> io::Result<()> {
    let tracks: Vec<usize> = names(rows, by)
        .into_iter()
        .map(|id| id.and_then(|id| places.get(&id)).map_or(0, |place| place.1))
        .collect();
    let times = times(rows);
    let mut order: Vec<u64> = (0..rows.num_rows() as u64).collect();
    let key = |k: u64| (tracks[k as usize], times.get(k as usize).copied().unwrap_or(0.0));
    // stable: rows at one time stay as they stand
    order.sort_by(|&a, &b| {
        let ((track, time), (other, later)) = (key(a), key(b));
        track.cmp(&other).then(time.total_cmp(&later))
    });
    let level = ZstdLevel::try_new(1).map_err(io::Error::other)?;
    let properties = WriterProperties::builder().set_compression(Compression::ZSTD(level));
    let properties = properties.set_max_row_group_row_count(None).build();
    let destination = BufWriter::new(File::create(path)?);
    let mut file = ArrowWriter::try_new(destination, rows.schema(), Some(properties))?;
    let mut from = 0;
    while from < order.len() {
        let mut to = (from + GROUP).min(order.len());
        while to < order.len() && tracks[order[to] as usize] == tracks[order[to - 1] as usize] {
            to += 1;
        }
        let group = UInt64Array::from(order[from..to].to_vec());
        file.write(&take_record_batch(rows, &group).map_err(io::Error::other)?)?;
        file.flush()?;
        from = to;
    }
    file.into_inner()?.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()
}

/// Numbers in the order of the times. Dates count from the first one, so that they are told apart to a nanosecond in a month.
fn times(rows: &RecordBatch) -> Vec<f64> {
    let Some(time) = rows.column_by_name("time") else { return Vec::new() };
    match kind(time.data_type()) {
        Kind::Number | Kind::Whole | Kind::Unsigned => floats(time.as_ref()),
        Kind::Text => {
            let words = texts(time.as_ref());
            let read = |word: &Option<String>| Calendar::parse(word.as_deref().unwrap_or("").trim()).ok();
            let first = words.iter().find_map(read);
            let since = |word: &Option<String>| match (
                word.as_deref().unwrap_or("").trim().parse(),
                read(word),
                first,
            ) {
                (Ok(seconds), ..) => seconds,
                (_, Some(instant), Some(first)) => instant.since(first),
                _ => f64::NAN,
            };
            words.iter().map(since).collect()
        }
        _ => {
            let counts = integers(time.as_ref());
            let first = counts.iter().copied().flatten().next().unwrap_or(0);
            counts
                .into_iter()
                .map(|count| count.map_or(f64::NAN, |count| (i128::from(count) - i128::from(first)) as f64))
                .collect()
        }
    }
}
