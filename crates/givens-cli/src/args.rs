//! What the user typed.

mod format;
mod partition;

pub use format::{FormatArg, LayoutArg};
pub use partition::PartitionArgs;

use crate::message::Stop;
use crate::numbers::{number, runs, seconds, seed, threads, whole};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use core::num::NonZeroUsize;
use core::time::Duration;
use std::path::PathBuf;

/// Nonlinear Gaussian state estimation from a model file and a table of measurements.
#[derive(Debug, Parser)]
#[command(
    name = "givens",
    version,
    about,
    after_help = "Exit codes: 0 done; 1 a filter failed, what was finished is \
written; 2 bad input, nothing written.\nstdout is data, all else goes to stderr."
)]
pub struct Args {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Estimate each state from the measurements up to it
    #[command(after_help = "\
Memory: some 500,000 rows of the table, 200 bytes each; those beyond lie in a
temporary file (TMPDIR), some 50 bytes each. A track is written as it is
finished, of several those that stand one behind the other in the table. Tracks
whose rows are mixed, and several with a figure, a report or --resume, are held
whole: 8 (4 + 2n + 3n² + d + d²) bytes a row of n states and d measures.

Examples:
  givens filter turn.toml radar.csv -o track.csv --plot track.svg
  givens filter turn.toml radar.csv --method ukf --set kappa=1 --format jsonl
  givens filter turn.toml radar.csv --at every:0.5    also between the rows
  givens filter turn.toml radar.csv --threads 4    for the tracks of a table
  givens filter turn.toml - --truth truth.csv < radar.csv > track.csv")]
    Filter(FilterArgs),
    /// Estimate each state from all measurements, before and after it
    #[command(after_help = "\
Memory: as `filter`, and 8 (4 + 5n + 7n² + d + d²) bytes a row of n states and d
measures for the tracks at work. A single track that needs more than 128 MB of
these is smoothed in segments, three times over its rows, with the same numbers.

Examples:
  givens smooth turn.toml radar.csv -o track.csv --plot track.png
  givens smooth turn.toml radar.csv --lag 5      each row with the next five
  givens smooth turn.toml radar.csv --point 0    the state at t = 0, row by row")]
    Smooth(SmoothArgs),
    /// Draw trajectories and measurements from a model
    #[command(after_help = "Examples:
  givens simulate turn.toml --steps 100 --seed 1 -o radar.csv --states truth.csv
  givens simulate turn.toml --until 60 --every 0.5 --runs 9 --seed 7 -o runs.csv
  givens simulate turn.toml --times radar.csv --seed 1    the rows of a table
  givens simulate swing.toml --until 9 --every 0.3 --substeps 32 --seed 1")]
    Simulate(SimulateArgs),
    /// Cut tables into Parquet files that hold whole tracks
    #[command(after_help = "\
The rows of a file are held in memory at once, and some 100 bytes for each
track; all rows lie in temporary files meanwhile (TMPDIR).

Examples:
  givens partition reports.csv --by track_id -o fleet
  givens partition 'days/*.parquet' --by ship -o fleet --rows 2000000
  givens smooth ship.toml fleet -o smoothed    each file by itself, on all cores")]
    Partition(PartitionArgs),
    /// Run several methods over the same data, side by side
    #[command(after_help = "Examples:
  givens compare turn.toml radar.csv --methods ekf,sr-ukf,ckf --truth truth.csv
  givens compare turn.toml radar.csv --methods ukf,ckf --set ukf.kappa=1")]
    Compare(CompareArgs),
    /// Run the experiments of five papers again, beside the published numbers
    #[command(after_help = "Examples:
  givens reproduce all -o pages              at the papers' own numbers of runs
  givens reproduce arasaratnam2011smoothers --only table-4 --runs 5000 --seed 7
  givens reproduce sarkka2012continuous -o pages --runs 1000

All cores are used; RAYON_NUM_THREADS=2 in the environment sets their number. The numbers are the same for any.
A folder may take the pages of several calls, also at once: its index lists all that lie there.")]
    Reproduce(ReproduceArgs),
    /// List the methods, their parts and their options
    #[command(after_help = "Example:\n  givens methods | grep unscented")]
    Methods,
    /// Tell what was understood of a model file
    #[command(after_help = "Example:\n  givens check turn.toml --set update=separate")]
    Check(CheckArgs),
    /// Print a completion script for a shell
    #[command(
        after_help = "Example:\n  givens completions bash > ~/.local/share/bash-completion/completions/givens"
    )]
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// The model and how to run it.
#[derive(Clone, Debug, ClapArgs)]
pub struct ModelArgs {
    /// Model file (TOML)
    pub model: String,
    /// Another value for a parameter of the model
    #[arg(long = "param", value_name = "NAME=VALUE")]
    pub params: Vec<String>,
}

#[derive(Clone, Debug, ClapArgs)]
pub struct MethodArgs {
    /// Method by its registry name (see `givens methods`); without it, that of the file, or sr-ckf (sr-cd-ckf for a
    /// continuous model)
    #[arg(long, short, value_name = "METHOD")]
    pub method: Option<String>,
    /// A part or an option of the method
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub settings: Vec<String>,
}

/// How the path of a continuous model is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SchemeArg {
    /// The Itô–Taylor scheme of strong order 1.5
    ItoTaylor,
    /// Euler and Maruyama's, of order 1; ½ where the diffusion depends on the state
    EulerMaruyama,
}

#[derive(Clone, Debug, ClapArgs)]
pub struct FilterArgs {
    #[command(flatten)]
    pub model: ModelArgs,
    /// Table of measurements (CSV or Parquet: time, measures; sensor, track_id, u_… if any), `-` for CSV from standard
    /// input; or a folder of tables, or a pattern in quotation marks
    pub data: String,
    #[command(flatten)]
    pub method: MethodArgs,
    /// True states (CSV: time, states; track_id if any), for RMSE, NEES and coverage
    #[arg(long, value_name = "FILE")]
    pub truth: Option<String>,
    /// Where to write; standard output without it; for a folder of tables a folder
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// The answers at these times in place of the rows: `T,…`, or `every:DT` from the initial belief to the last row
    #[arg(long, value_name = "T,…|every:DT", allow_hyphen_values = true)]
    pub at: Option<String>,
    /// How to write; from the name of the output, else csv
    #[arg(long, value_enum)]
    pub format: Option<FormatArg>,
    /// The columns of a Parquet file
    #[arg(long, value_enum)]
    pub layout: Option<LayoutArg>,
    /// Draw the track, the states and NIS, through rows and the times of --at; given again, to another file too
    #[arg(long = "plot", value_name = "FILE.svg|png")]
    pub plots: Vec<PathBuf>,
    /// Judge the run by its innovations, in words: a page about their size and whiteness, outliers and gaps
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    /// Tracks are run on so many threads; all cores without it. The answers are the same for any
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<NonZeroUsize>,
    /// Keep a checkpoint beside the output, every so many seconds (10 without them), and go on from the one that a run has
    /// left that was broken off, to the same bytes
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, require_equals = true, default_missing_value = "10", value_parser = seconds, requires = "output")]
    pub resume: Option<Duration>,
}

#[derive(Debug, ClapArgs)]
pub struct SmoothArgs {
    #[command(flatten)]
    pub run: FilterArgs,
    /// Smooth each row with the next ROWS rows only
    #[arg(long, value_name = "ROWS", value_parser = whole, allow_negative_numbers = true, conflicts_with_all = ["point", "at"])]
    pub lag: Option<usize>,
    /// Estimate the state at this one time, a line for each row from it on
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with_all = ["at", "resume"])]
    pub point: Option<String>,
}

#[derive(Debug, ClapArgs)]
pub struct SimulateArgs {
    #[command(flatten)]
    pub model: ModelArgs,
    /// Until this time
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with_all = ["steps", "times"])]
    pub until: Option<String>,
    /// So many rows (where sensors share a column: so many of each)
    #[arg(long, value_name = "N", value_parser = whole, allow_negative_numbers = true, conflicts_with = "times")]
    pub steps: Option<usize>,
    /// Time between rows; the model's step without it
    #[arg(long, value_name = "DT", value_parser = number, allow_negative_numbers = true, conflicts_with = "times")]
    pub every: Option<f64>,
    /// At the rows of this table (CSV): its times, tracks, sensors and controls; where it has columns of measures, only
    /// the cells that are filled are drawn
    #[arg(long, value_name = "DATA")]
    pub times: Option<String>,
    /// Of a continuous model, how its path is followed; without it ito-taylor, or euler-maruyama where the diffusion
    /// depends on the state
    #[arg(long, value_enum)]
    pub scheme: Option<SchemeArg>,
    /// Of a continuous model, into how many steps each gap is divided: 16 without it
    #[arg(long, value_name = "N", value_parser = whole, allow_negative_numbers = true, conflicts_with = "max_step")]
    pub substeps: Option<usize>,
    /// Of a continuous model, the longest step of its path
    #[arg(long, value_name = "DT", value_parser = number, allow_negative_numbers = true)]
    pub max_step: Option<f64>,
    /// Independent runs, each a track
    #[arg(long, value_name = "N", default_value = "1", value_parser = runs, allow_negative_numbers = true)]
    pub runs: u32,
    /// Seed of the random numbers: equal seeds draw equal data
    #[arg(long, value_name = "S", value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// Where to write the measurements; standard output without it
    #[arg(long, short, value_name = "DATA")]
    pub output: Option<PathBuf>,
    /// Where to write the true states
    #[arg(long, value_name = "FILE")]
    pub states: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub struct CompareArgs {
    #[command(flatten)]
    pub model: ModelArgs,
    /// Table of measurements (CSV: time, measures; sensor, track_id, u_… if any), `-` for standard input
    pub data: String,
    /// Methods, with commas between
    #[arg(long, value_name = "A,B,…", value_delimiter = ',', required = true)]
    pub methods: Vec<String>,
    /// A part or an option, of all methods or of one
    #[arg(long = "set", value_name = "[METHOD.]KEY=VALUE")]
    pub settings: Vec<String>,
    /// True states (CSV: time, states; track_id if any), for RMSE, NEES and coverage
    #[arg(long, value_name = "FILE")]
    pub truth: Option<String>,
    /// Tracks are run on so many threads; all cores without it. The answers are the same for any
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<NonZeroUsize>,
}

#[derive(Debug, ClapArgs)]
pub struct CheckArgs {
    #[command(flatten)]
    pub model: ModelArgs,
    #[command(flatten)]
    pub method: MethodArgs,
}

/// The words for an option of `smooth` that was given to another command, where the parser's tip would mislead.
pub fn of_smooth(error: &clap::Error) -> Option<Stop> {
    let Some(ContextValue::String(found)) = error.get(ContextKind::InvalidArg) else { return None };
    let value = match found.as_str() {
        "--lag" => "ROWS",
        "--point" => "T",
        _ => return None,
    };
    let unknown = error.kind() == ErrorKind::UnknownArgument;
    let stop = Stop::input(format!("{found} is an option of `smooth`"));
    unknown.then(|| stop.help(format!("write givens smooth MODEL DATA {found} {value}")))
}

/// Which experiments, and how often.
#[derive(Debug, ClapArgs)]
pub struct ReproduceArgs {
    /// The paper, or `all`
    pub paper: String,
    /// One experiment of it
    #[arg(long, value_name = "NAME")]
    pub only: Option<String>,
    /// Monte-Carlo runs of each setting; without it, as many as the paper made
    #[arg(long, value_parser = runs)]
    pub runs: Option<u32>,
    /// Of all random numbers
    #[arg(long, value_parser = seed, default_value = "1")]
    pub seed: u64,
    /// The folder for pages, tables and figures; without it, the pages' claims go to standard output
    #[arg(long, short, value_name = "DIR")]
    pub output: Option<PathBuf>,
}
