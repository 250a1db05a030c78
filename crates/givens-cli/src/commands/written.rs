//! What the answers are written as: the format and its columns.

use crate::args::{FilterArgs, FormatArg, LayoutArg};
use crate::message::Stop;
use givens_io::{Format, Layout};
use std::path::Path;

/// The format asked for, or that of the output's name.
pub fn format(asked: Option<FormatArg>, output: Option<&Path>) -> Result<Format, Stop> {
    let ending = output.and_then(Path::extension).map(|ending| ending.to_string_lossy().to_lowercase());
    match (asked, ending.as_deref()) {
        (Some(FormatArg::Jsonl), _) | (None, Some("jsonl" | "ndjson")) => Ok(Format::Jsonl),
        (Some(FormatArg::Parquet), _) | (None, Some("parquet")) => Ok(Format::Parquet),
        (None, Some(other @ ("json" | "arrow" | "xlsx" | "html" | "svg" | "png"))) => {
            let name = output.unwrap_or(Path::new("")).display();
            let stop = Stop::input(format!("-o {name}: this version does not write .{other}"));
            Err(stop.help("name the output .csv, .jsonl or .parquet, or say --format csv, jsonl or parquet"))
        }
        (Some(FormatArg::Csv) | None, _) => Ok(Format::Csv),
    }
}

/// The columns asked for, of a Parquet file.
pub fn layout(args: &FilterArgs, format: Format) -> Result<Layout, Stop> {
    match args.layout {
        Some(_) if format != Format::Parquet => {
            Err(Stop::input("--layout is for Parquet")
                .help("name the output .parquet, or leave --layout out"))
        }
        _ if format == Format::Parquet && args.resume.is_some() => {
            let stop = Stop::input("--resume: a Parquet file that was broken off cannot be gone on with");
            Err(stop
                .help("write .csv or .jsonl, or give a folder of files, which is gone on with file by file"))
        }
        Some(LayoutArg::Covariances) => Ok(Layout::Covariances),
        Some(LayoutArg::Tidy) => Ok(Layout::Tidy),
        Some(LayoutArg::Wide) | None => Ok(Layout::Wide),
    }
}
