//! What was asked for on the command line.

use super::table::Table;
use core::time::Duration;

/// What is to be done.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Task {
    Race,
    /// Only build, and fetch what that needs.
    Prepare,
    /// What a step costs as something grows; `only` names studies.
    Scaling,
    /// That, and the build.
    ScalingAndBuild,
}

/// The words behind `cargo xtask bench`.
pub struct Options {
    /// Workloads; all if empty.
    pub only: Vec<String>,
    /// Repetitions of each contestant.
    pub rounds: usize,
    /// What a contestant may use of a workload's time before it sits out the remaining rounds.
    pub budget: Duration,
    pub python: bool,
    pub peers: bool,
    pub task: Task,
    /// The page, in place of `docs/benchmarks.md` or `docs/scaling.md`.
    pub out: Option<String>,
}

const USAGE: &str = "cargo xtask bench [--only W1,W2] [--rounds N] [--budget SECONDS] [--no-python] [--no-peers] [--prepare] [--out FILE]
cargo xtask bench --scaling [--only states,tracks,threads,substeps] [--rounds N] [--build] [--out FILE]";

impl Options {
    pub fn parse(words: &[&str]) -> Result<Self, String> {
        let mut options = Self {
            only: Vec::new(),
            rounds: 41,
            budget: Duration::from_secs(8),
            python: true,
            peers: true,
            task: Task::Race,
            out: None,
        };
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            let mut value = || words.next().copied().ok_or(format!("{word} needs a value: {USAGE}"));
            match word {
                "--only" => options.only = value()?.split(',').map(str::to_owned).collect(),
                "--rounds" => options.rounds = number(word, value()?)?.max(1),
                "--budget" => options.budget = Duration::from_secs(number(word, value()?)? as u64),
                "--no-python" => options.python = false,
                "--no-peers" => options.peers = false,
                "--prepare" => options.task = Task::Prepare,
                "--scaling" if options.task == Task::Race => options.task = Task::Scaling,
                "--build" if options.task == Task::Scaling => options.task = Task::ScalingAndBuild,
                "--build" => {
                    return Err(format!("--build stands behind --scaling, whose page it is on: {USAGE}"));
                }
                "--out" => options.out = Some(value()?.to_owned()),
                _ => return Err(format!("`{word}` is no option: {USAGE}")),
            }
        }
        Ok(options)
    }

    /// Whether every workload that was named exists.
    pub fn check(&self, table: &Table) -> Result<(), String> {
        let names: Vec<&str> = table.workloads.iter().map(|workload| workload.name.as_str()).collect();
        match self.only.iter().find(|name| !names.contains(&name.as_str())) {
            Some(name) => Err(format!("no workload `{name}`; there are {}", names.join(", "))),
            None => Ok(()),
        }
    }

    pub fn wants(&self, workload: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|name| name == workload)
    }
}

fn number(word: &str, value: &str) -> Result<usize, String> {
    value.parse().map_err(|_| format!("{word} wants a whole number, not `{value}`"))
}
