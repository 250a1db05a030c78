//! Mutants are switched on, one a run, until a test program fails.

use super::build::{Built, Program};
use super::list::Mutant;
use super::outcome::Outcome;
use crate::say;
use core::sync::atomic::{AtomicUsize, Ordering};
use core::time::Duration;
use std::collections::BTreeSet;
use std::os::unix::process::CommandExt;
use std::process::{Command, Stdio};
use std::sync::mpsc;
use std::time::Instant;

/// Kilobytes that a mutant may take: some ask for memory without end.
const MEMORY: usize = 6_000_000;

/// A stack of 256 MiB, for a function has room for the numbers of all its mutants; and random cases that are always the same.
const SAME: [(&str, &str); 2] = [("RUST_MIN_STACK", "268435456"), ("PROPTEST_RNG_SEED", "1")];

/// A test program and what was seen of it without a mutant.
struct Judge<'b> {
    program: &'b Program,
    /// The mutants whose functions it runs.
    asked: BTreeSet<u32>,
    limit: Duration,
}

/// Tries them all; what becomes of each is kept as it is known.
pub fn all(
    built: &Built,
    mutants: &[&Mutant],
    mut keep: impl FnMut(&Mutant, Outcome) -> Result<(), String>,
) -> Result<(), String> {
    let judges = built.programs.iter().map(|program| {
        let (asked, took) = note(built, program)?;
        let (name, count) = (&program.name, asked.len());
        say(&format!("{name}: {:.1} s, runs {count} mutants' functions", took.as_secs_f64()));
        Ok(Judge { program, asked, limit: Duration::from_secs(20) + took * 6 })
    });
    let judges: Vec<Judge> = judges.collect::<Result<_, String>>()?;
    let next = AtomicUsize::new(0);
    let (sender, outcomes) = mpsc::channel();
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            let (sender, next, judges) = (sender.clone(), &next, &judges);
            scope.spawn(move || {
                while let Some(&mutant) = mutants.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if sender.send((mutant, outcome(judges, mutant.number))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        let (mut done, mut unseen) = (0, 0);
        for (mutant, outcome) in outcomes {
            let outcome = outcome?;
            done += 1;
            unseen += usize::from(outcome.unseen());
            if outcome.unseen() || done % 50 == 0 {
                say(&format!("{done} of {}, {unseen} unseen: {}", mutants.len(), mutant.name));
            }
            keep(mutant, outcome)?;
        }
        Ok(())
    })
}

/// Runs a program without a mutant: whose functions it asks, and how long it takes.
fn note(built: &Built, program: &Program) -> Result<(BTreeSet<u32>, Duration), String> {
    let notes = program.path.with_extension("asked");
    let _ = std::fs::remove_file(&notes);
    let start = Instant::now();
    let mut command = Command::new(&program.path);
    command
        .args(&program.arguments)
        .current_dir(&program.folder)
        .env("MUTANT", "note")
        .env("MUTANTS_ASKED", &notes)
        .envs(SAME);
    let path = program.path.display();
    let out = command.output().map_err(|error| format!("{path}: {error}"))?;
    if !out.status.success() {
        let words = String::from_utf8_lossy(&out.stdout);
        return Err(format!("{path} fails without a mutant:\n{words}"));
    }
    let told = std::fs::read_to_string(&notes).unwrap_or_default();
    let first = told.lines().filter_map(|line| line.parse::<u32>().ok());
    let asked = first.filter_map(|first| built.functions.get(&first)).flatten().copied().collect();
    Ok((asked, start.elapsed()))
}

fn outcome(judges: &[Judge], number: u32) -> Result<Outcome, String> {
    let mut asked = false;
    for judge in judges.iter().filter(|judge| judge.asked.contains(&number)) {
        asked = true;
        match try_one(judge, number)? {
            Some(true) => {}
            Some(false) => return Ok(Outcome::Fell(judge.program.name.clone())),
            None => return Ok(Outcome::Endless(judge.program.name.clone())),
        }
    }
    Ok(if asked { Outcome::Survives } else { Outcome::NotAsked })
}

/// Whether the program passes; nothing if it does not end.
fn try_one(judge: &Judge, number: u32) -> Result<Option<bool>, String> {
    let program = judge.program;
    let mut command = Command::new("sh");
    command.args(["-c", &format!("ulimit -v {MEMORY}; exec \"$0\" -q \"$@\"")]);
    command.arg(&program.path).args(&program.arguments).current_dir(&program.folder);
    command.env("MUTANT", number.to_string()).envs(SAME);
    // what a property found wrong with a mutant is not to be kept
    command.env("PROPTEST_FAILURE_PERSISTENCE", "off").process_group(0);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let told = |error: std::io::Error| format!("{}: {error}", program.path.display());
    let mut child = command.spawn().map_err(told)?;
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait().map_err(told)? {
            return Ok(Some(status.success()));
        }
        if start.elapsed() > judge.limit {
            child.kill().map_err(told)?;
            child.wait().map_err(told)?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}
