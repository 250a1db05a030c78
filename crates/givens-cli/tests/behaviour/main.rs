//! What a user sees, as the design says it: outputs, rows, tracks, times, smoothers, figures, simulations, tables.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::format_collect)]

mod columns;
#[path = "../common/mod.rs"]
mod common;
mod compare;
mod continuous;
mod doubts;
mod failures;
mod folders;
mod gate;
mod judged;
mod large;
mod output;
mod precision;
mod reproduce;
mod resume;
mod rows;
mod simulate;
mod simulated_tables;
mod smoothers;
mod start;
mod streams;
mod texts;
mod tracks;
mod truth;
mod zoo;

use common::Folder;
use common::models::{DATA, MODEL, TRUTH, WALK};

/// A folder with the good files.
fn folder(name: &str) -> Folder {
    // two tests may use one name at once
    let test = std::thread::current().name().unwrap_or("").replace("::", "/");
    let folder = Folder::new(&format!("{test}/{name}"));
    folder.write("model.toml", MODEL).write("data.csv", DATA);
    folder.write("truth.csv", TRUTH).write("walk.toml", WALK);
    folder
}

/// The numbers of a CSV column, NaN where a cell is empty.
fn column(cells: &[Vec<String>], name: &str) -> Vec<f64> {
    let at = cells[0].iter().position(|cell| cell == name).unwrap_or_else(|| panic!("no column {name}"));
    let number = |cell: &String| if cell.is_empty() { f64::NAN } else { cell.parse().unwrap() };
    cells[1..].iter().map(|row| number(&row[at])).collect()
}

/// Two numbers that differ by rounding only.
fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs().max(1.0)
}
