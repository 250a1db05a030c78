//! `[state]`: names, and the initial belief.

use super::context::{Context, MANY};
use super::covariance::covariance;
use super::document::{Entry, Kind, Value};
use super::names::{Names, Use};
use super::section::{Named, Section, texts};
use super::vocabulary::Role;
use crate::findings::{Findings, list};
use crate::table::Calendar;

/// Keys of the section.
pub(super) const KEYS: &[&str] = &["names", "time", "mean", "std", "cov", "start"];

/// What is believed of the state before any measurement, but for the states that `start` finds.
#[derive(Clone, Debug, PartialEq)]
pub struct Prior {
    /// The mean of each state; none for those that `start` finds.
    pub mean: Vec<Option<f64>>,
    /// The covariance, n × n, row by row; zero in the rows and columns of the states that `start` finds.
    pub cov: Vec<f64>,
}

/// Reads the names of the states.
pub(super) fn names(findings: &Findings, section: &Section, taken: &mut Names) -> Option<Vec<String>> {
    let entry = section.need(findings, "names", "name the states: names = [\"x\", \"vx\"]")?;
    let names = texts(findings, &entry.value, "`names`")?;
    if names.is_empty() {
        findings.wrong_help(&entry.value.span, "the model has no state", "name at least one");
        return None;
    }
    if names.len() > MANY {
        findings.wrong(&entry.value.span, format!("there are {} states, more than {MANY}", names.len()));
        return None;
    }
    let mut good = true;
    for (name, span) in &names {
        good &= taken.take(name, Use::State, span);
    }
    let deviation =
        |name: &str| name.strip_suffix("_std").is_some_and(|of| names.iter().any(|(other, _)| *other == of));
    for (name, span) in names.iter().filter(|(name, _)| deviation(name)) {
        let message = format!("`{name}` is the column of a standard deviation in every output");
        findings.wrong_help(span, message, "choose another name");
        good = false;
    }
    good.then(|| names.into_iter().map(|(name, _)| name.to_string()).collect())
}

/// Reads the time at which the initial belief holds: a number, or an instant of which `t` is zero.
pub(super) fn time(context: &mut Context, section: &Section) -> Option<(Option<f64>, Option<Calendar>)> {
    let Some(entry) = section.get("time") else { return Some((None, None)) };
    if section.get("start").is_some() {
        let help = "remove `time`: with `start` the belief begins at the track's first row";
        context.findings.wrong_help(&entry.span, "`time` stands beside `start`", help);
        return None;
    }
    let text = match &entry.value.kind {
        Kind::Moment(text) => text,
        Kind::Text(text, _) if is_date(text) => text,
        _ => {
            let scope = context.scope(Role::Fixed);
            return context.number(&scope, &entry.value, "`time`").map(|time| (Some(time), None));
        }
    };
    match Calendar::parse(text) {
        Ok(instant) => Some((Some(0.0), Some(instant))),
        Err(error) => {
            let help = "write seconds (12.5), or RFC 3339 with its offset (2026-03-01T12:00:00Z)";
            context.findings.wrong_help(&entry.value.span, format!("`time` is not a time: {error}"), help);
            None
        }
    }
}

/// Whether a text is meant as a date or time: no expression has a colon, and nobody subtracts as in 2026-03-01.
fn is_date(text: &str) -> bool {
    let shape: String = text.chars().take(10).map(|c| if c.is_ascii_digit() { '0' } else { c }).collect();
    text.contains(':') || shape == "0000-00-00"
}

/// Reads the initial belief of the states that `start` leaves out; `started` tells for each state whether it does
/// not.
pub(super) fn prior(
    context: &mut Context,
    section: &Section,
    states: &[String],
    started: &[bool],
) -> Option<Prior> {
    let findings = context.findings;
    let left = (0..states.len()).filter(|&i| !started.get(i).is_some_and(|&s| s));
    let (which, names): (Vec<usize>, Vec<String>) =
        left.filter_map(|i| Some((i, states.get(i)?.clone()))).unzip();
    let (mean, std, cov) = (section.get("mean"), section.get("std"), section.get("cov"));
    let overlap = [mean, std].into_iter().flatten().any(|entry| twice(findings, entry, states, started));
    if overlap || complete(findings, section, &names).is_none() {
        return None;
    }
    let of = if names.len() == states.len() { "" } else { " of the states that `start` leaves out" };
    let mut prior = Prior { mean: vec![None; states.len()], cov: vec![0.0; states.len() * states.len()] };
    let means = mean.map(|entry| numbers(context, &entry.value, &names, &format!("`mean`{of}")));
    let matrix = match (std, cov) {
        (Some(std), _) => diagonal(context, &std.value, &names, &format!("`std`{of}")),
        (_, Some(cov)) => full(context, &cov.value, &names, &format!("`cov`{of}")),
        _ => Some(Vec::new()),
    };
    let means = means.unwrap_or_else(|| Some(Vec::new()))?;
    let matrix = matrix?;
    for (a, (&i, mean)) in which.iter().zip(means).enumerate() {
        prior.mean[i] = Some(mean);
        for (b, &j) in which.iter().enumerate() {
            prior.cov[i * states.len() + j] = matrix[a * which.len() + b];
        }
    }
    Some(prior)
}

/// Finds what the initial belief lacks, or has twice.
fn complete(findings: &Findings, section: &Section, names: &[String]) -> Option<()> {
    if let (Some(_), Some(cov)) = (section.get("std"), section.get("cov")) {
        findings.wrong_help(&cov.span, "[state] has both `std` and `cov`", "remove one of them");
        return None;
    }
    if names.is_empty() {
        return Some(());
    }
    let all = list(names.iter().map(String::as_str));
    let mean = section.need(findings, "mean", &format!("write the initial mean of {all}"));
    if section.get("std").or(section.get("cov")).is_none() {
        let help = format!("write the initial standard deviation of {all}, or the covariance");
        findings.wrong_help(section.span, "[state] has neither `std` nor `cov`", help);
        return None;
    }
    mean.map(|_| ())
}

/// A table by name must not give what `start` finds.
fn twice(findings: &Findings, entry: &Entry, states: &[String], started: &[bool]) -> bool {
    let Kind::Table(entries) = &entry.value.kind else { return false };
    let in_start = |name: &str| states.iter().zip(started).any(|(state, &started)| started && state == name);
    let mut any = false;
    for other in entries.iter().filter(|other| in_start(&other.key)) {
        any = true;
        let message = format!("`{}` stands in both `start` and `{}`", other.key, entry.key);
        findings.wrong_help(&other.span, message, "remove it from one of them");
    }
    any
}

fn numbers(context: &mut Context, value: &Value, names: &[String], what: &str) -> Option<Vec<f64>> {
    let values = Named { noun: "state", names }.values(context.findings, value, what)?;
    let scope = context.scope(Role::Fixed);
    let numbers: Vec<Option<f64>> = values
        .iter()
        .zip(names)
        .map(|(value, name)| context.number(&scope, value, &format!("{what} of `{name}`")))
        .collect();
    numbers.into_iter().collect()
}

/// The covariance of independent states, row by row.
fn diagonal(context: &mut Context, value: &Value, names: &[String], what: &str) -> Option<Vec<f64>> {
    let values = Named { noun: "state", names }.values(context.findings, value, what)?;
    let scope = context.scope(Role::Fixed);
    let nodes = context.deviations(&scope, &values, names, what)?;
    let n = names.len();
    let mut matrix = vec![0.0; n * n];
    for (i, node) in nodes.into_iter().enumerate() {
        let deviation = context.known(node)?;
        let variance = deviation * deviation;
        if variance.is_infinite() || (deviation > 0.0 && !variance.is_normal()) {
            let message = format!(
                "{what} of `{}`: the square of {deviation:e} is beyond the range of numbers",
                names[i]
            );
            context.findings.wrong_help(&values[i].span, message, "choose another unit for the state");
            return None;
        }
        matrix[i * n + i] = variance;
    }
    Some(matrix)
}

/// A covariance as given, made symmetric to the last digit.
fn full(context: &mut Context, value: &Value, names: &[String], what: &str) -> Option<Vec<f64>> {
    let scope = context.scope(Role::Fixed);
    let nodes = covariance(context, &scope, value, names, what)?;
    let n = names.len();
    let mut matrix = context.all_known(&nodes).into_iter().collect::<Option<Vec<f64>>>()?;
    for i in 0..n {
        for j in 0..i {
            matrix[j * n + i] = matrix[i * n + j];
        }
    }
    Some(matrix)
}
