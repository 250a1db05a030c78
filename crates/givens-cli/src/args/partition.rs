//! Which tables are cut, and how.

use crate::numbers::whole;
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub struct PartitionArgs {
    /// Tables (CSV or Parquet) with the same columns; folders and patterns of them
    #[arg(required = true)]
    pub data: Vec<String>,
    /// The column that names the track of each row; it is called track_id in the files
    #[arg(long, value_name = "COLUMN")]
    pub by: String,
    /// The folder of the files
    #[arg(long, short, value_name = "FOLDER")]
    pub output: PathBuf,
    /// Rows that a file has at least
    #[arg(long, value_name = "ROWS", default_value_t = 1_000_000, value_parser = whole)]
    pub rows: usize,
}
