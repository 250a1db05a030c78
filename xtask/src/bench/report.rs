//! The page: a table for each workload, and what it says.

use super::options::Options;
use super::rounds::Standing;
use super::table::Table;
use super::{Race, machine};
use core::fmt::Write;
use givens_contest::Spread;
use std::path::Path;

/// `docs/benchmarks.md`.
pub fn page(table: &Table, races: &[Race], root: &Path, options: &Options, before: &str) -> String {
    let mut page = String::from(include_str!("head.md"));
    for (what, value) in machine::facts(root, before) {
        let _ = writeln!(page, "- {what}: {value}");
    }
    let (rounds, budget) = (options.rounds, options.budget.as_secs());
    let _ = writeln!(page, "- rounds: {rounds}, fewer where a contestant had used {budget} s");
    let _ = writeln!(page, "\n## In short\n\n{}", super::summary::lines(races));
    page += &super::summary::at_run_time(races);
    for race in races {
        let _ = writeln!(
            page,
            "\n## {}: {}\n\n{}\n",
            race.workload.name, race.workload.title, race.workload.about
        );
        page += &super::summary::table(race);
    }
    page += &remarks(table, races);
    page
}

/// Versions, and what is to be known of contestants.
fn remarks(table: &Table, races: &[Race]) -> String {
    let mut text = String::from("\n## Who took part\n\n| contestant | version | remark |\n|---|---|---|\n");
    for contestant in &table.contestants {
        let standings = races.iter().flat_map(|race| &race.standings);
        let own = |standing: &&Standing| standing.contestant.name == contestant.name;
        if let Some(standing) = standings.into_iter().find(own) {
            let _ = writeln!(text, "| {} | {} | {} |", contestant.name, standing.version, contestant.remark);
        }
    }
    text
}

/// Every repetition, as a table.
pub fn samples(races: &[Race]) -> String {
    let mut text = String::from("workload,contestant,round,cpu_ns_per_step,wall_ns_per_step\n");
    for race in races {
        for standing in &race.standings {
            for (round, sample) in standing.samples.iter().enumerate() {
                let (workload, name) = (&race.workload.name, &standing.contestant.name);
                let _ = writeln!(text, "{workload},{name},{round},{:.3},{:.3}", sample.cpu, sample.wall);
            }
        }
    }
    text
}

/// Time of the processor for each step.
pub fn cpu(standing: &Standing) -> Option<Spread> {
    Spread::of(standing.samples.iter().map(|sample| sample.cpu))
}
