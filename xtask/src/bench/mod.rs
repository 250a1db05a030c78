//! `cargo xtask bench`: givens and its peers side by side on fixed workloads, taking turns.

mod agreement;
mod build;
mod contestant;
mod machine;
mod options;
mod python;
mod report;
mod rounds;
mod scaling;
mod size;
mod summary;
mod table;

use crate::say;
use options::{Options, Task};
use rounds::{Runner, Standing};
use std::path::{Path, PathBuf};
use table::{Contestant, Table, Workload};

/// What came of a workload.
struct Race<'t> {
    workload: &'t Workload,
    standings: Vec<Standing<'t>>,
    /// Contestants that did not take part, and why.
    absent: Vec<(&'t Contestant, String)>,
}

/// Runs what was asked for, and writes the page; whether that could be done.
pub fn run(root: &Path, words: &[&str]) -> bool {
    match measured(root, words) {
        Ok(()) => true,
        Err(message) => {
            say(&message);
            false
        }
    }
}

fn measured(root: &Path, words: &[&str]) -> Result<(), String> {
    let options = Options::parse(words)?;
    let table = Table::read(&root.join("benchmarks/contestants.toml"))?;
    let target = target(root);
    if matches!(options.task, Task::Scaling | Task::ScalingAndBuild) {
        return scaling::run(root, &target, &options);
    }
    options.check(&table)?;
    if options.task == Task::Prepare {
        return build::prepare(root, &target, &options);
    }
    let built = build::all(root, &target, &options);
    let before = machine::load();
    let inputs = root.join("benchmarks/inputs");
    let mut races = Vec::new();
    for workload in table.workloads.iter().filter(|workload| options.wants(&workload.name)) {
        say(&format!("{}: {}", workload.name, workload.title));
        let runner = Runner { workload, inputs: &inputs, rounds: options.rounds, budget: options.budget };
        let mut race = Race { workload, standings: Vec::new(), absent: Vec::new() };
        let mut running = Vec::new();
        for contestant in table.contestants.iter().filter(|one| one.takes_part(&workload.name)) {
            let started = built.command(contestant).and_then(|command| runner.start(contestant, command));
            match started {
                Ok(one) => running.push(one),
                Err(reason) => {
                    say(&format!("  {}: {reason}", contestant.name));
                    race.absent.push((contestant, reason));
                }
            }
        }
        race.standings = runner.race(running, &mut race.absent);
        races.push(race);
    }
    let page = report::page(&table, &races, root, &options, &before);
    let out = options.out.clone().map_or_else(|| root.join("docs/benchmarks.md"), PathBuf::from);
    std::fs::write(&out, page).map_err(|error| format!("{}: {error}", out.display()))?;
    let samples = target.join("benchmarks/samples.csv");
    std::fs::write(&samples, report::samples(&races))
        .map_err(|error| format!("{}: {error}", samples.display()))?;
    say(&format!("written: {} and every repetition in {}", out.display(), samples.display()));
    Ok(())
}

/// Builds givens as a contestant, and says where it is.
pub fn build(root: &Path) -> Result<PathBuf, String> {
    build::ours_for_counting(root, &target(root))
}

pub use build::{cargo, peers};
pub use machine::line_of;

/// Where cargo builds.
pub fn target(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from)
}
