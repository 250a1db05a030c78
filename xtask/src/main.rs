//! The project's chores: `cargo xtask tidy` checks what the compiler does not, `cargo xtask ci` runs all that CI runs,
//! `cargo xtask reproduction` puts the papers' tables into their page.

mod bench;
mod ci;
mod dependencies;
mod embedded;
mod finding;
mod instructions;
mod mutants;
mod reproduction;
mod rust_text;
mod step;
mod stress;
mod tidy;
mod tree;

use std::io::{Write, stderr};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const USAGE: &str = "usage:
  cargo xtask tidy    check order of modules and crates, lengths, citations, the registry and the README
  cargo xtask ci      everything that CI runs: format, tidy, lints, documentation, builds, tests
  cargo xtask reproduction PAGES
                      puts the index of a folder that `givens reproduce` wrote into docs/reproduction.md
  cargo xtask bench [OPTIONS]
                      givens and its peers on fixed workloads, into docs/benchmarks.md; with --scaling, what a step costs as
                      something grows, into docs/scaling.md
  cargo xtask stress  givens and its peers on problems that grow harder rung by rung, into docs/stress.md
  cargo xtask instructions [--bless | --where-valgrind-is]
                      counts the instructions of fixed work under valgrind, against benchmarks/instructions.toml; without
                      valgrind an error, or nothing
  cargo xtask mutants [--again] GROUP | page
                      small faults in the code, and whether a test sees them; survivors are tried again, or the records of
                      all groups put into docs/mutation.md
  cargo xtask dependencies
                      licences and sources of all crates, against deny.toml; where cargo-deny is installed, known weaknesses
  cargo xtask embedded
                      builds examples/embedded without std, runs it against the textbook, looks for an allocator among its
                      symbols, and tells its flash, RAM and stack";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["tidy"] => tidy::run(&root()),
        ["ci"] => ci::run(&root()),
        ["reproduction", pages] => reproduction::run(&root(), Path::new(pages)),
        ["bench", options @ ..] => bench::run(&root(), options),
        ["dependencies"] => dependencies::run(&root()),
        ["stress"] => stress::run(&root()),
        ["embedded"] => embedded::run(&root()),
        ["mutants", "page"] => mutants::write_page(&root()),
        ["mutants", group] => mutants::run(&root(), group, false),
        ["mutants", "--again", group] => mutants::run(&root(), group, true),
        ["instructions"] => instructions::run(&root(), false),
        ["instructions", "--where-valgrind-is"] => !instructions::can() || instructions::run(&root(), false),
        ["instructions", "--bless"] => instructions::run(&root(), true),
        _ => {
            say(USAGE);
            return ExitCode::from(2);
        }
    };
    if done { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The root of the repository.
fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_path_buf()
}

/// Writes a line to stderr; if nobody reads it, there is nobody to tell.
fn say(line: &str) {
    let _ = writeln!(stderr(), "{line}");
}
