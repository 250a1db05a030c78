//! Makes the tables of the survey example from a recorded flight, and scores what was smoothed at the fixes held out.
//!
//! `cargo run -p survey-example -- [FOLDER]` reads `data/recording.csv` and writes `fixes.csv` and
//! `circles.csv`. `cargo run -p survey-example -- score SMOOTHED.csv` compares estimates with the fixes held out.

// the same frame as the other flight's
#[path = "../../flight/src/geodesy.rs"]
mod geodesy;
mod recording;
mod score;
mod tables;

use core::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};

use geodesy::Local;
use recording::{Fix, Position};

/// The airfield that the flight left, Toulouse-Blagnac.
const ORIGIN: Position = Position { latitude: 43.6294, longitude: 1.3638, height: 152.0 };

/// Every so many-th fix is held out.
const HELD_OUT: usize = 5;

/// Stretch of the flight that is drawn, s: two circles, in each a gap three times as long as the others.
const DRAWN: (f64, f64) = (3540.0, 3800.0);

fn main() -> Result<(), Box<dyn Error>> {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let fixes = flight(&here)?;
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => write(&here, &fixes),
        ["score", smoothed] => {
            let text = read(Path::new(smoothed))?;
            let report =
                score::report(&fixes, HELD_OUT, &text).map_err(|error| format!("{smoothed}, {error}"))?;
            Ok(std::io::stdout().write_all(report.as_bytes())?)
        }
        [folder] => write(Path::new(folder), &fixes),
        _ => Err("usage: survey-example [FOLDER], or survey-example score SMOOTHED.csv".into()),
    }
}

/// The recorded fixes in the frame of the origin.
fn flight(here: &Path) -> Result<Vec<Fix>, Box<dyn Error>> {
    let source = here.join("data/recording.csv");
    let rows = recording::read(&read(&source)?).map_err(|error| format!("{}, {error}", source.display()))?;
    let local = Local::at(&ORIGIN);
    Ok(rows.iter().map(|row| row.fix(local.of(&row.position))).collect())
}

fn write(folder: &Path, fixes: &[Fix]) -> Result<(), Box<dyn Error>> {
    let drawn: Vec<Fix> =
        fixes.iter().filter(|fix| DRAWN.0 <= fix.time && fix.time <= DRAWN.1).copied().collect();
    for (name, table) in
        [("fixes.csv", tables::fixes(fixes, Some(HELD_OUT))), ("circles.csv", tables::fixes(&drawn, None))]
    {
        let path = folder.join(name);
        std::fs::write(&path, table).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}
