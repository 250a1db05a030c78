//! `cargo xtask bench --scaling`: what a step costs as something grows, into docs/scaling.md.

use super::options::{Options, Task};
use super::{build, machine, size};
use core::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Measures, and writes the page. What it says of the build is kept where that is not measured anew.
pub fn run(root: &Path, target: &Path, options: &Options) -> Result<(), String> {
    let page = options.out.clone().map_or_else(|| root.join("docs/scaling.md"), PathBuf::from);
    let fault = |path: &Path| {
        let path = path.display().to_string();
        move |error: std::io::Error| format!("{path}: {error}")
    };
    let before = machine::load();
    let figures = page.parent().unwrap_or(root).join("images");
    std::fs::create_dir_all(&figures).map_err(fault(&figures))?;
    let studies = studies(root, target, &figures, options)?;
    let mut text = String::from(include_str!("scaling.md"));
    for (what, value) in machine::facts(root, &before) {
        let _ = writeln!(text, "- {what}: {value}");
    }
    let _ = writeln!(text, "- rounds: up to {}\n\n{studies}", options.rounds);
    text += &if options.task == Task::ScalingAndBuild {
        size::section(root, target)?
    } else {
        let old = std::fs::read_to_string(&page).unwrap_or_default();
        size::section_of(&old).map_or_else(size::unknown, str::to_owned)
    };
    std::fs::write(&page, text).map_err(fault(&page))?;
    crate::say(&format!("written: {}, and figures in {}", page.display(), figures.display()));
    Ok(())
}

/// The studies' sections, from the program that measures.
fn studies(root: &Path, target: &Path, figures: &Path, options: &Options) -> Result<String, String> {
    let mut wanted = format!("scaling {}", options.rounds);
    if !options.only.is_empty() {
        let _ = write!(wanted, " {}", options.only.join(","));
    }
    let mut program = Command::new(build::ours_for_scaling(root, target)?);
    program.arg(wanted).arg(figures).arg(root.join("benchmarks/inputs")).stderr(Stdio::inherit());
    let out = program.output().map_err(|error| format!("{}: {error}", program.get_program().display()))?;
    if out.status.success() {
        String::from_utf8(out.stdout).map_err(|error| error.to_string())
    } else {
        Err(format!("measuring failed: {}", out.status))
    }
}
