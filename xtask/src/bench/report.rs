//! The page: a table for each workload, and what it says.

use super::options::Options;
use super::rounds::Standing;
use super::spread::Spread;
use super::table::Table;
use super::{Race, machine};
use core::fmt::Write;
use std::path::Path;

/// `docs/benchmarks.md`.
pub fn page(table: &Table, races: &[Race], root: &Path, options: &Options, before: &str) -> String {
    let mut page = String::from(include_str!("head.md"));
    let line = |program: &str, words: &[&str]| machine::line_of(program, words, root);
    let revision = line("git", &["describe", "--always", "--dirty"]);
    let facts = [
        ("date", line("date", &["-u", "+%Y-%m-%d %H:%M UTC"])),
        ("machine", machine::processor()),
        ("load before and after", format!("{before}; {}", machine::load())),
        ("givens", format!("revision {revision}, {}", line("rustc", &["--version"]))),
        (
            "rounds",
            format!("{}, fewer where a contestant had used {} s", options.rounds, options.budget.as_secs()),
        ),
    ];
    for (what, value) in facts {
        let _ = writeln!(page, "- {what}: {value}");
    }
    let _ = writeln!(page, "\n## In short\n\n{}", super::summary::lines(races));
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
