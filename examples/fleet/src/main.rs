//! Makes the table of the fleet example from the recorded reports of the vessels, and judges what was filtered.
//!
//! `cargo run -p fleet-example -- [FOLDER]` reads `data/recording.csv` and writes `reports.csv`.
//! `cargo run -p fleet-example -- judge FILTERED.csv` tells how the innovations of moored and moving vessels keep to their
//! covariances.

#[path = "../../flight/src/geodesy.rs"]
mod geodesy;
mod judge;
mod recording;
mod table;

use core::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};

use recording::Position;

/// The origin of the flat frame: the Upper Bay, in the middle of the harbour.
const ORIGIN: Position = Position { latitude: 40.65, longitude: -74.04, height: 0.0 };

fn main() -> Result<(), Box<dyn Error>> {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let source = here.join("data/recording.csv");
    let heard = recording::read(&read(&source)?).map_err(|error| format!("{}, {error}", source.display()))?;
    let reports = table::reports(&heard, &ORIGIN);
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => write(&here, &reports),
        ["judge", filtered] => {
            let report = judge::report(&reports, &read(Path::new(filtered))?);
            let report = report.map_err(|error| format!("{filtered}, {error}"))?;
            Ok(std::io::stdout().write_all(report.as_bytes())?)
        }
        [folder] => write(Path::new(folder), &reports),
        _ => Err("usage: fleet-example [FOLDER], or fleet-example judge FILTERED.csv".into()),
    }
}

fn write(folder: &Path, reports: &[table::Report]) -> Result<(), Box<dyn Error>> {
    let path = folder.join("reports.csv");
    std::fs::write(&path, table::text(reports)).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(())
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}
