//! `cargo xtask stress`: docs/stress.md, its head written by hand, the tables below it by givens and the peers that are there.

use crate::bench::{cargo, peers, target};
use crate::say;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Ends the head of the page.
const MARK: &str = "<!-- Below: the tables that `cargo xtask stress` wrote. -->";

/// The peers and the precisions they are run in: that in Rust, and those in Python by the word of `benchmarks/python/stress.py`.
const PEERS: [(&str, &[&str]); 6] = [
    (RUST, &["f64", "f32"]),
    ("filterpy", &["f64"]),
    ("turbo-ckf", &["f64"]),
    ("kalman-py", &["f64"]),
    ("cuthbert", &["f64", "f32"]),
    ("dynamax", &["f64", "f32"]),
];

const RUST: &str = "numeris";

/// Runs all, and writes the page; whether that could be done.
pub fn run(root: &Path) -> bool {
    match written(root) {
        Ok(()) => true,
        Err(message) => {
            say(&message);
            false
        }
    }
}

fn written(root: &Path) -> Result<(), String> {
    let doc = root.join("docs/stress.md");
    let old = fs::read_to_string(&doc).map_err(|error| format!("{}: {error}", doc.display()))?;
    let environments = target(root).join("benchmarks");
    let folder = environments.join("stress");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let (mut answers, mut absent) = (Vec::new(), Vec::new());
    for (peer, precisions) in PEERS {
        for precision in precisions {
            say(&format!("{peer}, {precision}"));
            let file = folder.join(format!("{peer}-{precision}.json"));
            match answered(root, &environments, peer, precision, &file) {
                Ok(()) => answers.push(file),
                Err(reason) => absent.push(format!("- {peer}, {precision}: {reason}\n")),
            }
        }
    }
    say("givens");
    let mut tables = grouped(&report(root, &answers)?);
    say("givens, ten million rows");
    tables += "\n\n### Ten million rows: `sr-ckf` on `long_run`\n\n";
    tables += &report(root, &[PathBuf::from("--long")])?;
    if !absent.is_empty() {
        tables += &["\nNot run here:\n\n", &absent.concat()].concat();
    }
    let new = joined(&old, &tables).ok_or_else(|| format!("{} has no line `{MARK}`", doc.display()))?;
    fs::write(&doc, new).map_err(|error| format!("{}: {error}", doc.display()))
}

/// Runs a peer, its answers into a file.
fn answered(
    root: &Path,
    environments: &Path,
    peer: &str,
    precision: &str,
    file: &Path,
) -> Result<(), String> {
    let mut command = if peer == RUST {
        let mut command = Command::new(peers(root, environments)?);
        command.args(["stress", precision]);
        command
    } else {
        let interpreter = environments.join("python/bin/python");
        if !interpreter.exists() {
            return Err("its environment is not there; `cargo xtask bench --prepare` makes it, with network"
                .to_owned());
        }
        let mut command = Command::new(interpreter);
        command.arg("benchmarks/python/stress.py").args([peer, precision]);
        command.env("JAX_PLATFORMS", "cpu").env("PYTHONDONTWRITEBYTECODE", "1");
        command
    };
    let out = File::create(file).map_err(|error| format!("{}: {error}", file.display()))?;
    match command.current_dir(root).arg("tests/golden/stress.json").stdout(out).status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("it ended with {status}")),
        Err(error) => Err(error.to_string()),
    }
}

/// What the report of the tests prints.
fn report(root: &Path, words: &[PathBuf]) -> Result<String, String> {
    let mut command = cargo();
    command.current_dir(root).args(["run", "--release", "--quiet", "--package", "givens-tests"]);
    command.args(["--features", "reports", "--bin", "stress", "--"]).args(words).stderr(Stdio::inherit());
    let out = command.output().map_err(|error| error.to_string())?;
    if !out.status.success() {
        return Err(format!("the report ended with {}", out.status));
    }
    String::from_utf8(out.stdout).map_err(|error| error.to_string())
}

fn joined(old: &str, tables: &str) -> Option<String> {
    let (head, _) = old.split_once(MARK)?;
    Some(format!("{head}{MARK}\n\n{}\n", tables.trim()))
}

/// The tables with one row for all filters that fare alike, in the place of the first.
fn grouped(tables: &str) -> String {
    let (mut text, mut rows): (String, Vec<(Vec<&str>, &str)>) = (String::new(), Vec::new());
    for line in tables.lines().chain([""]) {
        let row = line.strip_prefix("| ").and_then(|row| row.split_once(" | "));
        if let Some((name, cells)) = row {
            match rows.iter_mut().find(|(_, own)| *own == cells) {
                Some((names, _)) => names.push(name),
                None => rows.push((vec![name], cells)),
            }
            continue;
        }
        for (names, cells) in rows.drain(..) {
            text += &["| ", &both(&names).join(" · "), " | ", cells, "\n"].concat();
        }
        text += line;
        text.push('\n');
    }
    text.trim_end().to_owned()
}

/// Where both updates of a square root fare alike, its name alone.
fn both(names: &[&str]) -> Vec<String> {
    let mut out = Vec::new();
    for name in names {
        match name.rsplit_once(", ") {
            Some((root, "joint")) if names.contains(&format!("{root}, separate").as_str()) => {
                out.push(root.to_owned());
            }
            Some((root, "separate")) if names.contains(&format!("{root}, joint").as_str()) => {}
            _ => out.push((*name).to_owned()),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_stays_and_the_tables_are_replaced() {
        let old = format!("# Head\n\n{MARK}\n\n### old\n");
        let new = joined(&old, "\n### a\n\n| x |\n").unwrap();
        assert_eq!(new, format!("# Head\n\n{MARK}\n\n### a\n\n| x |\n"));
        assert_eq!(joined(&new, "### a\n\n| x |").unwrap(), new);
        assert!(joined("no mark", "").is_none());
    }

    #[test]
    fn filters_that_fare_alike_share_a_row() {
        let table = "| filter | f64 | f32 |\n|---|---|---|\n| a, joint | x | – |\n| b | y | – |\n| a, separate | x | – |\n| c, joint | x | – |\n\ntext";
        let shared = "| filter | f64 | f32 |\n|---|---|---|\n| a · c, joint | x | – |\n| b | y | – |\n\ntext";
        assert_eq!(grouped(table), shared);
    }
}
