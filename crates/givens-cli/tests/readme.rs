//! The README's command does what the README shows.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;
use std::process::Command;

#[test]
fn the_readme_shows_what_its_command_says() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let line = readme.lines().find_map(|line| line.strip_prefix("cargo run --release -- smooth ")).unwrap();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let words = line.split(' ').map(|word| match word {
        "track.csv" | "track.svg" => folder.join(format!("readme-{word}")).into_os_string(),
        other => other.into(),
    });
    let output = Command::new(env!("CARGO_BIN_EXE_givens"))
        .current_dir(&root)
        .arg("smooth")
        .args(words)
        .output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{said}");
    let shown = readme.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    assert_eq!(said, shown);
    for name in ["readme-track.csv", "readme-track.svg"] {
        assert!(std::fs::metadata(folder.join(name)).unwrap().len() > 0, "{name}");
    }
}

#[test]
fn the_survey_shows_what_its_command_says() {
    shows("survey", ["smooth", "examples/survey/survey.toml", "examples/survey/fixes.csv"]);
}

#[test]
fn the_fleet_shows_what_its_command_says() {
    shows("fleet", ["filter", "examples/fleet/fleet.toml", "examples/fleet/reports.csv"]);
}

/// The example's first block of text is what stderr says.
fn shows(name: &str, words: [&str; 3]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let readme = std::fs::read_to_string(root.join(format!("examples/{name}/README.md"))).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_givens"))
        .current_dir(&root)
        .args(words)
        .arg("-o")
        .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.csv")))
        .output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{said}");
    let shown = readme.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    assert_eq!(said, shown);
}
