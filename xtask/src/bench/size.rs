//! `cargo xtask bench --build`: how long the command takes to build from nothing, and how large what users get is.

use super::build::{cargo, done};
use super::machine;
use crate::say;
use core::fmt::Write;
use core::time::Duration;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

const HEADING: &str = "## Build";
/// A full release build takes less, on two cores.
const LIMIT: Duration = Duration::from_mins(5);

/// The page's section, measured now.
pub fn section(root: &Path, target: &Path) -> Result<String, String> {
    let before = machine::load();
    let folder = target.join("benchmarks/build");
    let command = command(root, &folder)?;
    let wheel = wheel(root, target, &folder);
    std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut text = format!(
        "{HEADING}\n\nA release build of the command from nothing, all dependencies with it, their sources already fetched; and the wheel, by \
         maturin. The command holds every method, the experiments of the papers and the font of the figures; it is given as built, and without its line tables.\n\n"
    );
    for (what, value) in machine::facts(root, &before) {
        let _ = writeln!(text, "- {what}: {value}");
    }
    let within = if command.time <= LIMIT { "within" } else { "**over**" };
    let _ = writeln!(
        text,
        "\n| what | time | size |\n|---|--:|--:|\n| `givens`, the command | {} ({within} the {} min that it may take) | {} |\n| stripped | | {} |",
        minutes(command.time),
        LIMIT.as_secs() / 60,
        size(command.bytes),
        command.stripped.map_or("no `strip` here".to_owned(), size),
    );
    let _ = match wheel {
        Ok((time, bytes)) => writeln!(text, "| the wheel | {} | {} |", minutes(time), size(bytes)),
        Err(reason) => writeln!(text, "\nThe wheel was not built: {reason}."),
    };
    Ok(text)
}

/// The section as a page has it.
pub fn section_of(page: &str) -> Option<&str> {
    page.find(&format!("\n{HEADING}\n")).map(|at| &page[at + 1..])
}

/// The section of a page that never had one.
pub fn unknown() -> String {
    format!("{HEADING}\n\nNot measured: `cargo xtask bench --scaling --build` does.\n")
}

/// What came of the command's build.
struct Built {
    time: Duration,
    bytes: u64,
    stripped: Option<u64>,
}

fn command(root: &Path, folder: &Path) -> Result<Built, String> {
    let _ = std::fs::remove_dir_all(folder);
    done(cargo().current_dir(root).args(["fetch", "--locked", "--quiet"]), "fetching the dependencies")?;
    say("building the command from nothing");
    let mut build = cargo();
    build.current_dir(root).env("CARGO_TARGET_DIR", folder);
    build.args(["build", "--release", "--locked", "--offline", "--quiet", "--package", "givens-cli"]);
    let begin = Instant::now();
    done(&mut build, "building the command")?;
    let time = begin.elapsed();
    let program = folder.join("release").join(format!("givens{}", std::env::consts::EXE_SUFFIX));
    let stripped = folder.join("stripped");
    let strip = Command::new("strip").arg("-o").arg(&stripped).arg(&program).status();
    let small = strip.is_ok_and(|status| status.success()).then(|| length(&stripped)).transpose()?;
    Ok(Built { time, bytes: length(&program)?, stripped: small })
}

/// Builds the wheel with pip in the environment that `--prepare` made for givens: how long that took, and its size.
fn wheel(root: &Path, target: &Path, folder: &Path) -> Result<(Duration, u64), String> {
    let interpreter = target.join("benchmarks/givens/bin/python");
    if !interpreter.exists() {
        return Err("`cargo xtask bench --prepare` has not made the environment `givens`".to_owned());
    }
    say("building the wheel from nothing");
    let (wheels, own) = (folder.join("wheels"), folder.join("wheel"));
    let mut build = Command::new(interpreter);
    build.current_dir(root).env("CARGO_TARGET_DIR", own);
    build.args(["-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir"]).arg(&wheels).arg(".");
    let begin = Instant::now();
    done(&mut build, "building the wheel")?;
    let time = begin.elapsed();
    let files = std::fs::read_dir(&wheels).map_err(|error| format!("{}: {error}", wheels.display()))?;
    let file: Option<PathBuf> = files.flatten().map(|file| file.path()).next();
    Ok((time, length(&file.ok_or("no wheel came of it")?)?))
}

fn length(file: &Path) -> Result<u64, String> {
    file.metadata().map(|data| data.len()).map_err(|error| format!("{}: {error}", file.display()))
}

fn minutes(time: Duration) -> String {
    let seconds = time.as_secs_f64().round() as u64;
    format!("{} min {:02} s", seconds / 60, seconds % 60)
}

fn size(bytes: u64) -> String {
    format!("{:.1} MB", bytes as f64 / 1e6)
}

#[cfg(test)]
mod tests {
    use super::{minutes, section_of, size, unknown};
    use core::time::Duration;

    #[test]
    fn the_section_of_an_older_page_is_found_and_a_page_without_has_none() {
        let page = format!("# Scaling\n\n## Else\n\n{}", unknown());
        assert_eq!(section_of(&page), Some(unknown().as_str()));
        assert_eq!(section_of("# Scaling\n\n## Builders\n"), None);
    }

    #[test]
    fn times_and_sizes_are_in_units_that_one_reads() {
        assert_eq!(minutes(Duration::from_millis(125_400)), "2 min 05 s");
        assert_eq!(size(12_345_678), "12.3 MB");
    }
}
