//! `givens compare`: several methods over the same data, a line each.

use crate::args::CompareArgs;
use crate::message::{Stop, say};
use crate::plan::{Plan, choose, model, setting};
use crate::session::Session;
use crate::stdout;
use givens::Goal;
use givens::metrics::{Consistency, Verdict};
use givens::registry::{Choice, Setting, find};
use std::time::Instant;

/// Runs every method as a filter and as a smoother and lays their figures side by side.
pub fn compare(args: &CompareArgs) -> Result<(), Stop> {
    let model = model(&args.model)?;
    let mut settings: Vec<(Option<&str>, Setting)> = Vec::new();
    for text in &args.settings {
        let whole = setting(text)?;
        match whole.key.split_once('.') {
            None => settings.push((None, whole)),
            Some((method, key)) => {
                let Some(named) = args.methods.iter().find(|name| *name == method) else {
                    return Err(Stop::input(format!("--set {text}: `{method}` is not among --methods")));
                };
                settings.push((Some(named), Setting { key: key.to_owned(), value: whole.value }));
            }
        }
    }
    let choices = args.methods.iter().map(|name| {
        let own = settings.iter().filter(|(method, _)| method.is_none_or(|method| method == name));
        let own: Vec<Setting> = own.map(|(_, setting)| setting.clone()).collect();
        choose(&model, Some(name), &own)
    });
    let choices: Vec<Choice> = choices.collect::<Result<_, _>>()?;
    let Some(&first) = choices.first() else { return Err(Stop::input("--methods names no method")) };
    let plan = Plan::with(model, first, &args.data, args.truth.as_deref())?;
    let mut table = vec![header(&plan)];
    let mut failures = Vec::new();
    for (name, choice) in args.methods.iter().zip(&choices) {
        let (line, failed) = line(&plan, name, choice);
        table.push(line);
        failures.extend(failed.into_iter().map(|failure| format!("{name}: {failure}")));
    }
    stdout::write(|out| aligned(out, &table))?;
    say(&format!(
        "{} rows; µs per row: the run alone, once, without reading and writing{}",
        plan.tracks.tracks.iter().map(|track| track.rows.len()).sum::<usize>(),
        if plan.truth.is_some() { "; RMSE of the filter | of the smoother" } else { "" }
    ));
    if failures.is_empty() { Ok(()) } else { Err(Stop::failed(failures.join("\nerror: "))) }
}

fn header(plan: &Plan) -> Vec<String> {
    let mut header: Vec<String> =
        ["method", "rows", "failed", "log-likelihood", "NIS/dof", "verdict", "µs/row"]
            .map(str::to_owned)
            .into();
    if let Some(truth) = &plan.truth {
        let known = plan.model.states.iter().zip(&truth.states).filter(|(_, column)| column.is_some());
        header.extend(known.map(|(name, _)| format!("{name} RMSE")));
        header.push("NEES/dof".into());
    }
    header
}

fn line(plan: &Plan, name: &str, choice: &Choice) -> (Vec<String>, Vec<String>) {
    let goals = |goal: Goal| vec![goal; plan.tracks.tracks.len()];
    let begun = Instant::now();
    let filtered = Session::run(plan, choice, &goals(Goal::Filter));
    let seconds = begun.elapsed().as_secs_f64();
    let rows: usize = filtered.estimates().map(givens::Estimates::len).sum();
    let log_likelihood: f64 = filtered.estimates().map(givens::Estimates::total_log_likelihood).sum();
    let consistency = Consistency::of(filtered.estimates());
    let verdict = match consistency.verdict() {
        Verdict::Unknown => "unknown",
        Verdict::Consistent => "consistent",
        Verdict::Overconfident => "overconfident",
        Verdict::Underconfident => "underconfident",
    };
    let name = if find(name).is_some_and(|entry| entry.name == name) {
        name.to_owned()
    } else {
        format!("{name} = {}", choice.name)
    };
    let mut line = vec![
        name,
        rows.to_string(),
        filtered.failures.len().to_string(),
        format!("{log_likelihood:.4}"),
        format!("{:.4}", consistency.ratio),
        verdict.to_owned(),
        format!("{:.2}", 1e6 * seconds / rows.max(1) as f64),
    ];
    let mut failures = filtered.failures.clone();
    if let Some(truth) = &plan.truth {
        let smoothed = Session::run(plan, choice, &goals(Goal::Interval));
        let (f, s) = (filtered.accuracy(plan), smoothed.accuracy(plan));
        if filtered.failures.is_empty() {
            failures.extend(smoothed.failures);
        }
        let pair = |f: Option<f64>, s: Option<f64>| {
            format!("{:.4} | {:.4}", f.unwrap_or(f64::NAN), s.unwrap_or(f64::NAN))
        };
        for i in (0..plan.model.states.len()).filter(|&i| truth.states[i].is_some()) {
            line.push(pair(f.as_ref().map(|f| f.rmse[i]), s.as_ref().map(|s| s.rmse[i])));
        }
        line.push(pair(f.map(|f| f.nees / f.nees_dof), s.map(|s| s.nees / s.nees_dof)));
    }
    (line, failures)
}

/// Columns as wide as their widest cell; the first one to the left, the others to the right.
fn aligned(out: &mut dyn std::io::Write, table: &[Vec<String>]) -> std::io::Result<()> {
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
