//! `cargo xtask embedded`: `examples/embedded`, built without `std`, run, and looked into.

mod image;
mod symbols;

use crate::say;
use image::Image;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The features of the example, a tracker each.
const TRACKERS: [&str; 3] = ["plane-filter", "plane-smoother", "space-filter"];
/// A Cortex-M4F or M7.
const TARGET: &str = "thumbv7em-none-eabihf";

/// Builds, runs, and looks for what must not be there; whether all is well.
pub fn run(root: &Path) -> bool {
    checked(root).unwrap_or_else(|message| {
        say(&message);
        false
    })
}

fn checked(root: &Path) -> Result<bool, String> {
    let mut good = cross_built(root)?;
    if !cfg!(target_os = "linux") {
        say("the host program was not built: it starts and writes as programs on Linux do");
        return Ok(good);
    }
    let program = built(root, &TRACKERS)?;
    let disagreeing = status(Command::new(&program))?;
    if disagreeing != 0 {
        say(&format!("exit status {disagreeing}: trackers disagree with the textbook, or one has panicked"));
        good = false;
    }
    // the comparison is worth something only if it can fail
    let expected = i32::try_from(TRACKERS.len()).unwrap_or(0);
    let mut falsified = Command::new(&program);
    falsified.arg("falsified").stdout(Stdio::null());
    let disagreeing = status(falsified)?;
    if disagreeing != expected {
        say(&format!(
            "exit status {disagreeing} over a falsified measurement: all {expected} were to disagree"
        ));
        good = false;
    }
    let whole = Image::read(&program)?;
    let unwanted = symbols::unwanted(&whole.symbols);
    for found in &unwanted {
        say(&format!("{}: {found}", program.display()));
    }
    if unwanted.is_empty() {
        let imported = symbols::imported(&whole.symbols).join(", ");
        let count = whole.symbols.len();
        say(&format!("{count} symbols: no allocator, no std, no formatting; of the C library {imported}"));
    }
    good &= unwanted.is_empty();
    say(&format!("{:<16}{:>14}{:>18}{:>8}", "alone", "flash (bytes)", "of it givens-core", "libm"));
    for tracker in TRACKERS {
        let image = Image::read(&built(root, &[tracker])?)?;
        let (givens, libm) = (image.code_of("givens_core"), image.code_of("libm"));
        say(&format!("{tracker:<16}{:>14}{givens:>18}{libm:>8}", image.flash()));
    }
    Ok(good)
}

/// The host program with these trackers.
fn built(root: &Path, trackers: &[&str]) -> Result<PathBuf, String> {
    let features = trackers.join(",");
    cargo(root, &["--bin", "host", "--no-default-features", "--features", &features])?;
    Ok(target(root).join("release/host"))
}

/// The library for a microcontroller, where the target is installed; whether that went well.
fn cross_built(root: &Path) -> Result<bool, String> {
    let arguments = ["--print", "target-libdir", "--target", TARGET];
    let out = Command::new("rustc").args(arguments).current_dir(root).output();
    let out = out.map_err(|error| format!("rustc could not be run: {error}"))?;
    let folder = String::from_utf8_lossy(&out.stdout);
    if !out.status.success() || !Path::new(folder.trim()).is_dir() {
        say(&format!("not built for {TARGET}: `rustup target add {TARGET}` brings it"));
        return Ok(true);
    }
    cargo(root, &["--lib", "--target", TARGET])?;
    say(&format!("built for {TARGET}"));
    Ok(true)
}

fn cargo(root: &Path, arguments: &[&str]) -> Result<(), String> {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(["build", "--quiet", "--release", "--locked", "--manifest-path"]);
    command.arg(root.join("examples/embedded/Cargo.toml")).arg("--target-dir").arg(target(root));
    let status = command.args(arguments).status();
    match status.map_err(|error| format!("cargo could not be run: {error}"))? {
        status if status.success() => Ok(()),
        _ => Err(format!("examples/embedded was not built ({})", arguments.join(" "))),
    }
}

fn status(mut program: Command) -> Result<i32, String> {
    let status = program.status();
    let status = status.map_err(|error| format!("the host program could not be run: {error}"))?;
    status.code().ok_or_else(|| format!("the host program was ended: {status}"))
}

fn target(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from).join("embedded")
}
