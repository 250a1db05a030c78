//! What a race says: its table, and who won.

use super::Race;
use super::report::cpu;
use super::rounds::Standing;
use super::table::Contestant;
use core::fmt::Write;
use givens_contest::{Spread, duration};

/// A standing with its spread.
struct Ranked<'r> {
    standing: &'r Standing<'r>,
    cpu: Spread,
}

fn ranked<'r>(race: &'r Race) -> Vec<Ranked<'r>> {
    let with = |standing: &'r Standing<'r>| cpu(standing).map(|cpu| Ranked { standing, cpu });
    let mut all: Vec<Ranked> = race.standings.iter().filter_map(with).collect();
    all.sort_by(|a, b| a.cpu.median.total_cmp(&b.cpu.median));
    all
}

/// The fastest of these that computes what was asked for, in double precision.
fn best<'r>(all: &'r [Ranked<'r>], wanted: impl Fn(&Contestant) -> bool) -> Option<&'r Ranked<'r>> {
    all.iter().find(|one| {
        let contestant = one.standing.contestant;
        one.standing.agrees && contestant.class != "f32" && wanted(contestant)
    })
}

/// One line for each workload.
pub fn lines(races: &[Race]) -> String {
    let mut text = String::from(
        "| workload | best of the others | givens, one filter | | givens, packs | |\n|---|---|---|---|---|---|\n",
    );
    for race in races {
        let all = ranked(race);
        let theirs = best(&all, |one| !one.ours);
        let named = |one: &Ranked| format!("{} ({})", duration(one.cpu.median), one.standing.contestant.name);
        let _ = write!(text, "| {} | {} |", race.workload.name, theirs.map_or("–".to_owned(), named));
        for class in ["", "packs"] {
            let ours = best(&all, |one| one.ours && one.class == class);
            let _ = match ours {
                None => write!(text, " | |"),
                Some(ours) => {
                    let ratio = theirs.map(|theirs| theirs.cpu.median / ours.cpu.median);
                    write!(text, " {} | {} |", named(ours), ratio.map_or(String::new(), verdict))
                }
            };
        }
        text.push('\n');
    }
    text + "\nHow many times faster than the best of the others; within 1.4 we claim nothing. Single precision is left out here. \
         `C++ by hand` is a program of ours, written as one writes such a filter for one model. In packs, W3a, W4, P1 and P2 have the same trajectory in every lane.\n"
}

/// What a model costs that is not compiled with its filter: one line for each contestant and workload; nothing without any.
pub fn at_run_time(races: &[Race]) -> String {
    let mut text = String::new();
    for race in races {
        let all = ranked(race);
        for one in all.iter().filter(|one| one.standing.agrees) {
            let contestant = one.standing.contestant;
            let native = all.iter().find(|other| contestant.native.contains(&other.standing.contestant.name));
            let Some(native) = native else { continue };
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} | **{:.2}** |",
                race.workload.name,
                contestant.name,
                duration(one.cpu.median),
                native.standing.contestant.name,
                duration(native.cpu.median),
                one.cpu.median / native.cpu.median,
            );
        }
    }
    if text.is_empty() {
        return text;
    }
    format!(
        "### Models known at run time\n\n| workload | contestant | | the same, compiled | | ratio |\n|---|---|--:|---|--:|--:|\n{text}\n\
         How many times as long as with a model that is compiled into the filter. The aim is at most 1.4 in P1, of a model from a file.\n"
    )
}

/// A ratio, and what it says.
fn verdict(ratio: f64) -> String {
    let word = match ratio {
        ratio if ratio < 1.0 / 1.4 => " (a peer wins)",
        ratio if ratio < 1.4 => " (even)",
        _ => "",
    };
    format!("**{ratio:.2}**{word}")
}

/// The table of a workload, the fastest first; below it, who was absent.
pub fn table(race: &Race) -> String {
    let mut text = String::from(
        "| contestant | median | least | quartiles | × best peer | × best of givens | from the reference | rounds |\n|---|---|---|---|---|---|---|---|\n",
    );
    let all = ranked(race);
    for one in &all {
        let Ranked { standing, cpu } = one;
        let times = |ours: bool| {
            best(&all, |one| one.ours == ours)
                .map_or("–".to_owned(), |best| format!("{:.2}", cpu.median / best.cpu.median))
        };
        let mark = if standing.agrees { "" } else { " **≠**" };
        let bold = if standing.contestant.ours { "**" } else { "" };
        let _ = writeln!(
            text,
            "| {bold}{}{bold} | {} | {} | {} – {} | {} | {} | {:.0e} σ{mark} | {} |",
            standing.contestant.name,
            duration(cpu.median),
            duration(cpu.least),
            duration(cpu.lower),
            duration(cpu.upper),
            times(false),
            times(true),
            standing.distance.worst(),
            standing.samples.len()
        );
    }
    for (contestant, reason) in &race.absent {
        let _ = writeln!(text, "\n{}: {reason}.", contestant.name);
    }
    text
}
