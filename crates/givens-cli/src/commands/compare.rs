//! `givens compare`: several methods over the same data, a line each.

use crate::args::CompareArgs;
use crate::doubts;
use crate::files;
use crate::message::{Stop, count, digits, doubt, say};
use crate::method::{Named, Typed, choose, setting};
use crate::plan::{Plan, model};
use crate::session::{Manner, Session};
use crate::stdout;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use givens::Goal;
use givens::metrics::Verdict;
use givens::registry::{Choice, Setting, find};
use givens::scalar::Shown;
use givens_io::Model;
use std::io::{self, Write};

/// Runs every method over the data, with a truth as a smoother too, and lays their figures side by side.
pub fn compare(args: &CompareArgs) -> Result<(), Stop> {
    files::check(
        &[("MODEL", Some(&args.model.model)), ("DATA", Some(&args.data)), ("--truth", args.truth.as_deref())],
        &[],
    )?;
    let model = model(&args.model)?;
    let choices = choices(&model, args)?;
    let Some(&first) = choices.first() else { return Err(Stop::input("--methods names no method")) };
    let plan = Plan::with(model, first, &args.data, args.truth.as_deref())?;
    let gated = choices.iter().any(|choice| choice.gate.is_some());
    let mut table = vec![header(&plan, gated)];
    let (mut failures, mut doubts) = (Vec::new(), Vec::new());
    for (name, choice) in args.methods.iter().zip(&choices) {
        let Line { cells, failures: failed, doubts: doubtful } =
            line(&plan, name.trim(), choice, gated, args.threads)?;
        table.push(cells);
        failures.extend(failed.into_iter().map(|failure| format!("{}: {failure}", name.trim())));
        doubts.extend(doubtful.into_iter().map(|told| format!("{}: {told}", name.trim())));
    }
    stdout::write(|out| aligned(out, &table))?;
    let rows = plan.tracks.tracks.iter().map(|track| track.rows.len()).sum();
    let pair = if plan.truth.is_some() { "; RMSE and NEES of the filter | of the smoother" } else { "" };
    let side_by_side = if plan.tracks.tracks.len() > 1 { ", tracks side by side" } else { "" };
    let timed = "µs/row: the filter alone, once, without reading and writing";
    say(&format!("{}; {timed}{side_by_side}{pair}", count(rows, "row")));
    doubt(&doubts);
    if failures.is_empty() { Ok(()) } else { Err(Stop::failures(&failures)) }
}

/// The methods with their settings: those without a name before the dot are for all.
fn choices(model: &Model, args: &CompareArgs) -> Result<Vec<Choice>, Stop> {
    let names: Vec<&str> = args.methods.iter().map(|name| name.trim()).collect();
    if names.iter().any(|name| name.is_empty()) {
        let list = args.methods.join(",");
        let stop = Stop::input(format!("--methods {list}: a name is empty"));
        return Err(stop.help("write names with commas between: --methods ekf,sr-ckf"));
    }
    let mut settings: Vec<(Option<&str>, Typed)> = Vec::new();
    for text in &args.settings {
        let Typed { text, setting } = setting(text)?;
        let Some((method, key)) = setting.key.split_once('.') else {
            settings.push((None, Typed { text, setting }));
            continue;
        };
        let Some(named) = names.iter().find(|name| **name == method) else {
            return Err(Stop::input(format!("--set {text}: `{method}` is not among --methods"))
                .help(format!("they are {}", names.join(", "))));
        };
        let setting = Setting { key: key.to_owned(), value: setting.value };
        settings.push((Some(named), Typed { text, setting }));
    }
    let of = |name: &&str| -> Result<Choice, Stop> {
        let own = settings.iter().filter(|(method, _)| method.is_none_or(|method| method == *name));
        let own: Vec<Typed> = own.map(|(_, typed)| typed.clone()).collect();
        choose(model, Some(Named { option: "--methods", name }), &own)
            .map_err(|stop| one_only(stop, &settings))
    };
    names.iter().map(of).collect()
}

/// A setting of all methods that one of them does not read can be given to the others by name.
fn one_only(stop: Stop, settings: &[(Option<&str>, Typed)]) -> Stop {
    let mut all = settings.iter().filter(|(method, _)| method.is_none()).map(|(_, typed)| typed);
    let unread = |typed: &&Typed| stop.message.contains(&format!("does not read `{}`", typed.setting.key));
    match all.find(unread) {
        Some(typed) => stop.help(format!("give it to one method alone: --set METHOD.{}", typed.text)),
        None => stop,
    }
}

fn header(plan: &Plan, gated: bool) -> Vec<String> {
    let mut header: Vec<String> =
        ["method", "rows", "failed", "log-likelihood", "NIS/dof", "verdict", "µs/row"]
            .map(str::to_owned)
            .into();
    if gated {
        header.insert(3, "gated".to_owned());
    }
    if let Some(truth) = &plan.truth {
        let known = plan.model.states.iter().zip(&truth.states).filter(|(_, column)| column.is_some());
        header.extend(known.map(|(name, _)| format!("{name} RMSE")));
        header.push("NEES/dof".into());
    }
    header
}

/// A method's line of the table, and what is told below it.
struct Line {
    cells: Vec<String>,
    failures: Vec<String>,
    doubts: Vec<String>,
}

fn line(
    plan: &Plan,
    name: &str,
    choice: &Choice,
    gated: bool,
    threads: Option<NonZeroUsize>,
) -> Result<Line, Stop> {
    let manner = Manner { at: None, threads, whole: false, judged: false, counted: None };
    let run = |goal: Goal| {
        let goals = vec![goal; plan.tracks.tracks.len()];
        Session::hand_over(plan, choice, &goals, manner, &mut |_, _, _| ControlFlow::Continue(()))
    };
    let filtered = run(Goal::Filter)?;
    let (seconds, summary) = (filtered.took.as_secs_f64(), filtered.sums.summary(choice.gate));
    let (rows, consistency) = (summary.rows, summary.consistency);
    let verdict = match consistency.verdict() {
        Verdict::Unknown => "unknown",
        Verdict::Consistent => "consistent",
        Verdict::Overconfident => "overconfident",
        Verdict::Underconfident => "underconfident",
    };
    let own_name = find(name).is_some_and(|entry| entry.name == name);
    let mut line = vec![
        if own_name { name.to_owned() } else { format!("{name} = {}", choice.name) },
        rows.to_string(),
        filtered.failures.len().to_string(),
        format!("{:.4}", Shown(summary.log_likelihood)),
        digits(consistency.ratio),
        verdict.to_owned(),
        if rows == 0 { "-".to_owned() } else { format!("{:.2}", 1e6 * seconds / rows as f64) },
    ];
    if gated {
        line.insert(3, summary.gated.count().to_string());
    }
    let mut failures = filtered.failures.clone();
    if let Some(truth) = &plan.truth {
        let smoothed = run(Goal::Interval)?;
        let (f, s) = (summary.accuracy.clone(), smoothed.sums.summary(choice.gate).accuracy);
        if filtered.failures.is_empty() {
            failures.extend(smoothed.failures);
        }
        let pair = |f: Option<f64>, s: Option<f64>| {
            format!("{} | {}", digits(f.unwrap_or(f64::NAN)), digits(s.unwrap_or(f64::NAN)))
        };
        for i in (0..plan.model.states.len()).filter(|&i| truth.states[i].is_some()) {
            line.push(pair(f.as_ref().map(|f| f.rmse[i]), s.as_ref().map(|s| s.rmse[i])));
        }
        line.push(pair(f.map(|f| f.nees / f.nees_dof), s.map(|s| s.nees / s.nees_dof)));
    }
    let doubts = doubts::all(plan, choice, &summary.doubts);
    Ok(Line { cells: line, failures, doubts })
}

/// Columns as wide as their widest cell; the first one to the left, the others to the right.
fn aligned(out: &mut dyn Write, table: &[Vec<String>]) -> io::Result<()> {
    let columns = table.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        table.iter().filter_map(|line| line.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    for line in table {
        for (column, (cell, width)) in line.iter().zip(&widths).enumerate() {
            if column == 0 { write!(out, "{cell:width$}")? } else { write!(out, "  {cell:>width$}")? }
        }
        writeln!(out)?;
    }
    Ok(())
}
