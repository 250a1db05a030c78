//! `cargo xtask mutants GROUP`: for every small fault that cargo-mutants knows, does a test fail?
//!
//! cargo-mutants builds the project anew for each; here all mutants of a group are woven into one copy of it, and
//! switched on by their number when the tests run, so that a build of minutes is needed once and not a thousand times.

mod build;
mod explained;
mod group;
mod list;
mod outcome;
mod page;
mod switch;
mod trial;
mod weave;

use crate::say;
use group::Group;
use list::Mutant;
use outcome::{Outcome, Record};
use std::path::{Path, PathBuf};

/// Tries the mutants of a group that have not been tried; with `again` also those that survived.
pub fn run(root: &Path, name: &str, again: bool) -> bool {
    let Some(group) = Group::named(name) else {
        say(&format!("no group {name:?}; there are {}", group::names()));
        return false;
    };
    tried(root, group, again).unwrap_or_else(|message| {
        say(&message);
        false
    })
}

/// Writes the tables of all groups' records into docs/mutation.md.
pub fn write_page(root: &Path) -> bool {
    page::write(root).unwrap_or_else(|message| {
        say(&message);
        false
    })
}

fn tried(root: &Path, group: &Group, again: bool) -> Result<bool, String> {
    let mutants = list::read(root, group)?;
    let mut record = Record::open(&record_path(root, group), again);
    for (number, stage) in group.stages.iter().enumerate() {
        let open: Vec<&Mutant> = mutants.iter().filter(|mutant| record.is_open(mutant, number)).collect();
        say(&format!(
            "{}, {}: {} of {} mutants to try",
            group.name,
            stage.package,
            open.len(),
            mutants.len()
        ));
        if !open.is_empty() {
            try_stage(root, group, number, open, &mut record)?;
        }
    }
    Ok(true)
}

fn try_stage(
    root: &Path,
    group: &Group,
    number: usize,
    open: Vec<&Mutant>,
    record: &mut Record,
) -> Result<(), String> {
    let woven = build::build(root, group, &group.stages[number], &open)?;
    for mutant in &open {
        if mutant.function.is_none() {
            record.add(mutant, &Outcome::Constant)?;
        } else if woven.unviable.contains(&mutant.number) {
            record.add(mutant, &Outcome::Unviable)?;
        }
    }
    let viable: Vec<&Mutant> =
        open.into_iter().filter(|m| m.function.is_some() && !woven.unviable.contains(&m.number)).collect();
    let last = number + 1 == group.stages.len();
    trial::all(&woven, &viable, |mutant, outcome| {
        let outcome = match outcome {
            unseen if unseen.unseen() && !last => Outcome::Passed(number),
            other => other,
        };
        record.add(mutant, &outcome)
    })
}

/// Where the outcomes of a group are kept.
fn record_path(root: &Path, group: &Group) -> PathBuf {
    root.join("target/mutants").join(format!("{}.txt", group.name))
}
