//! What a race says: its table, and who won.

use super::Race;
use super::report::cpu;
use super::rounds::Standing;
use super::spread::Spread;
use core::fmt::Write;

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

/// The fastest that computes what was asked for, of givens or of the others, in double precision.
fn best<'r>(all: &'r [Ranked<'r>], ours: bool) -> Option<&'r Ranked<'r>> {
    all.iter().find(|one| {
        one.standing.contestant.ours == ours && one.standing.agrees && one.standing.contestant.class != "f32"
    })
}

/// One line for each workload.
pub fn lines(races: &[Race]) -> String {
    let mut text =
        String::from("| workload | givens | best of the others | theirs / ours |\n|---|---|---|---|\n");
    for race in races {
        let all = ranked(race);
        let cell = |one: Option<&Ranked>| {
            one.map_or("–".to_owned(), |one| {
                format!("{} ({})", time(one.cpu.median), one.standing.contestant.name)
            })
        };
        let (ours, theirs) = (best(&all, true), best(&all, false));
        let ratio = match (ours, theirs) {
            (Some(ours), Some(theirs)) => {
                let ratio = theirs.cpu.median / ours.cpu.median;
                let won = if ratio < 1.0 { "**: a peer wins" } else { "**" };
                format!("**{ratio:.2}{won}")
            }
            _ => "–".to_owned(),
        };
        let _ = writeln!(text, "| {} | {} | {} | {ratio} |", race.workload.name, cell(ours), cell(theirs));
    }
    text
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
            best(&all, ours).map_or("–".to_owned(), |best| format!("{:.2}", cpu.median / best.cpu.median))
        };
        let mark = if standing.agrees { "" } else { " **≠**" };
        let bold = if standing.contestant.ours { "**" } else { "" };
        let _ = writeln!(
            text,
            "| {bold}{}{bold} | {} | {} | {} – {} | {} | {} | {:.0e} σ{mark} | {} |",
            standing.contestant.name,
            time(cpu.median),
            time(cpu.least),
            time(cpu.lower),
            time(cpu.upper),
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

/// Nanoseconds, in a unit that suits.
fn time(ns: f64) -> String {
    let (value, unit) = match ns {
        ns if ns < 1e3 => return format!("{ns:.0} ns"),
        ns if ns < 1e6 => (ns / 1e3, "µs"),
        ns => (ns / 1e6, "ms"),
    };
    let digits = 2_usize.saturating_sub(value.log10().floor().max(0.0) as usize);
    format!("{value:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::time;

    #[test]
    fn times_have_three_digits() {
        assert_eq!(time(123.4), "123 ns");
        assert_eq!(time(1234.0), "1.23 µs");
        assert_eq!(time(45_670.0), "45.7 µs");
        assert_eq!(time(1.234e8), "123 ms");
    }
}
