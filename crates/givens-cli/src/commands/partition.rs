//! `givens partition`: tables cut into files that hold whole tracks.

use crate::args::PartitionArgs;
use crate::message::{Stop, count, say};
use givens_io::{Partition, list_files};
use std::path::PathBuf;

pub fn partition(args: &PartitionArgs) -> Result<(), Stop> {
    let mut tables = Vec::new();
    for data in &args.data {
        match list_files(data, &["parquet", "csv"])? {
            Some(files) => tables.extend(files),
            None => tables.push(PathBuf::from(data)),
        }
    }
    let by = Partition { by: args.by.clone(), rows: args.rows };
    let done = by.write(&tables, &args.output)?;
    say(&format!(
        "{} of {} in {}",
        count(done.rows, "row"),
        count(done.tracks, "track"),
        count(done.files, "file")
    ));
    Ok(())
}
