//! Wrong use: exit code 2, nothing written, and words that name the place and the remedy.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../common/mod.rs"]
mod common;
mod continuous;
mod files;
mod gate;
mod models;
mod options;
mod tables;

use common::models::{DATA, MODEL, OSCILLATOR, TRUTH, WALK};
use common::{Folder, Run};
use core::fmt::Write;

/// What is wrong in a file: its name, what is replaced there, by what.
type Slip = (&'static str, &'static str, &'static str);

/// A name for the case, the slip, the command, and the words of stderr.
type Case = (&'static str, Slip, &'static str, &'static [&'static str]);

const NONE: Slip = ("model.toml", "", "");
const FILTER: &str = "filter model.toml data.csv -o out.csv";

/// Runs every case in a folder with the good files, one of them changed.
fn check(group: &str, cases: &[Case]) {
    let mut wrong = String::new();
    for (name, slip, command, words) in cases {
        let folder = folder(&format!("{group}/{name}"), slip);
        let before = folder.files();
        let found = folder.run(command);
        judge(&mut wrong, name, &found, words);
        if folder.files() != before {
            writeln!(wrong, "{name}: left {:?}", folder.files()).unwrap();
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

fn folder(name: &str, (file, from, to): &Slip) -> Folder {
    let folder = Folder::new(name);
    let discrete = [("model.toml", MODEL), ("data.csv", DATA), ("truth.csv", TRUTH), ("walk.toml", WALK)];
    let continuous = [("osc.toml", OSCILLATOR), ("osc.csv", "time,z\n1,0.4\n2,0.1\n")];
    for (name, text) in discrete.into_iter().chain(continuous) {
        let changed = name == *file && !(from.is_empty() && to.is_empty());
        assert!(!changed || text.contains(from), "{file} does not hold `{from}`");
        // all of a file is replaced where nothing is named
        let text = match from.is_empty() {
            _ if !changed => text.to_owned(),
            true => (*to).to_owned(),
            false => text.replacen(from, to, 1),
        };
        folder.write(name, &text);
    }
    folder
}

fn judge(wrong: &mut String, name: &str, found: &Run, words: &[&str]) {
    if found.code != 2 || !found.stdout.is_empty() {
        writeln!(wrong, "{name}: exit {}, stdout {:?}", found.code, found.stdout).unwrap();
    }
    for word in words.iter().filter(|word| !found.stderr.contains(**word)) {
        writeln!(wrong, "{name}: stderr does not say `{word}`:\n{}", found.stderr).unwrap();
    }
}

#[test]
fn the_good_files_are_good() {
    let folder = folder("good", &NONE);
    folder.run(FILTER).good();
    folder.run("smooth model.toml data.csv --truth truth.csv --plot track.svg").good();
    folder.run("filter osc.toml osc.csv -o osc_out.csv").good();
    let files = "data.csv model.toml osc.csv osc.toml osc_out.csv out.csv track.svg truth.csv walk.toml";
    assert_eq!(folder.files().join(" "), files);
}
