//! How answers are written.

use clap::ValueEnum;

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum FormatArg {
    /// One line per row: means, standard deviations, NIS
    Csv,
    /// One JSON object per row, with all matrices, in numbers that read back exactly
    Jsonl,
    /// The columns of the CSV, or others by --layout
    Parquet,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum LayoutArg {
    /// The columns of the CSV
    Wide,
    /// These, and of each row the lower triangle of its covariance
    Covariances,
    /// A row for each state: its mean and standard deviation
    Tidy,
}
