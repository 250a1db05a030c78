//! Every target over its kept corpus, and over so many changes of it: the same on every machine.
//!
//! `GIVENS_CASES=100 cargo test --release -p givens-fuzz` tries a hundred times as many, of another seed.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use givens_fuzz::{Random, TARGETS, Target, mutate, target};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Changes that are tried of each target.
const CASES: usize = 3000;
/// Inputs that take longer are told: a stranger could hold up who reads them.
const SLOW: f64 = 5.0;

fn corpus(of: &Target) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(of.name);
    let files = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = files.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(!files.is_empty(), "{} is empty", folder.display());
    files.into_iter().map(|path| (path.clone(), std::fs::read(path).unwrap())).collect()
}

/// Hands an input over; one that breaks a promise is shown as it may be kept.
fn try_one(of: &Target, input: &[u8], whence: &str) {
    let begin = Instant::now();
    let done = catch_unwind(AssertUnwindSafe(|| (of.body)(input)));
    assert!(done.is_ok(), "{} breaks at {whence}: {}", of.name, input.escape_ascii());
    let seconds = begin.elapsed().as_secs_f64();
    assert!(seconds < SLOW, "{} takes {seconds} s at {whence}: {}", of.name, input.escape_ascii());
}

fn bounded(name: &str) {
    let of = target(name);
    let corpus = corpus(of);
    for (path, input) in &corpus {
        try_one(of, input, &path.display().to_string());
    }
    let times: usize = std::env::var("GIVENS_CASES").map_or(1, |times| times.parse().expect("a number"));
    let mut random = Random::new(times as u64);
    for case in 0..CASES * times {
        let (_, input) = &corpus[random.below(corpus.len())];
        try_one(of, &mutate(input, of.words, of.longest, &mut random), &format!("case {case}"));
    }
}

#[test]
fn expressions() {
    bounded("expression");
}

#[test]
fn model_files() {
    bounded("model_file");
}

#[test]
fn tables() {
    bounded("table");
}

#[test]
fn tables_in_columns() {
    bounded("columns");
}

#[test]
fn options() {
    bounded("options");
}

#[test]
fn constructors() {
    bounded("constructors");
}

#[test]
fn filters_by_hand() {
    bounded("by_hand");
}

#[test]
fn runs() {
    bounded("run");
}

#[test]
fn every_target_has_its_program_and_its_test() {
    let programs = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz_targets");
    let own =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bounded.rs")).unwrap();
    for Target { name, .. } in TARGETS {
        assert!(programs.join(format!("{name}.rs")).exists(), "{name}");
        assert!(own.contains(&format!("bounded(\"{name}\")")), "{name}");
    }
}
