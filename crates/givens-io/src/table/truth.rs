//! Tables of true states.

use std::collections::HashMap;

use givens_expr::suggest;

use super::cell::{Cell, number, short};
use super::row::track_id;
use super::sheet::{Fields, Sheet};
use super::time::{Time, time};
use super::{Track, Tracks, header};
use crate::error::InputErrors;
use crate::findings::{Findings, list};
use crate::model_file::Model;
use crate::source::Source;

/// True states at some times, for comparison with estimates.
#[derive(Clone, Debug)]
pub struct Truth {
    /// Time of each row, counted as those of its track.
    pub times: Vec<f64>,
    /// The track of each row, as an index into [`Tracks::tracks`].
    pub tracks: Vec<usize>,
    /// For each state of the model its column, if the table has it; NaN where a cell is empty.
    pub states: Vec<Option<Vec<f64>>>,
    /// Line of each row in the file, from one.
    pub lines: Vec<usize>,
    /// Columns that are neither time nor states.
    pub ignored: Vec<String>,
    /// Tells the text of the table from others.
    pub fingerprint: String,
}

/// Reads true states from a CSV file with the columns `time`, states of the model, and `track_id` if `tracks` has
/// several.
///
/// # Errors
/// Everything that is wrong with the table, by line, column and name.
pub fn read_truth(path: &str, model: &Model, tracks: &Tracks) -> Result<Truth, InputErrors> {
    read(&Source::read(path)?, model, tracks)
}

/// [`read_truth`] from a text; errors call it `name`.
///
/// # Errors
/// As [`read_truth`].
pub fn parse_truth(text: &str, name: &str, model: &Model, tracks: &Tracks) -> Result<Truth, InputErrors> {
    read(&Source::new(name, text.to_owned()), model, tracks)
}

fn read(source: &Source, model: &Model, tracks: &Tracks) -> Result<Truth, InputErrors> {
    let findings = Findings::new(source);
    let truth = truth(&findings, model, tracks);
    findings.finish(truth)
}

fn truth(findings: &Findings, model: &Model, tracks: &Tracks) -> Option<Truth> {
    let mut sheet = Sheet::open(findings, "time and the states", |name| {
        ["time", "track_id"].contains(&name) || model.states.iter().any(|state| state == name)
    })?;
    let time_column = header::time(&sheet);
    let columns: Vec<Option<usize>> = model.states.iter().map(|name| sheet.column(name)).collect();
    if columns.iter().all(Option::is_none) {
        let names = list(model.states.iter().map(String::as_str));
        let near = model.states.iter().find_map(|name| {
            let other = suggest(name, sheet.header.iter().map(String::as_str))?;
            Some(format!("rename `{other}` to `{name}`; the states are {names}"))
        });
        let help = near.unwrap_or_else(|| format!("the columns bear the names of the states: {names}"));
        findings.wrong_help(&sheet.header_span(), "the table has no column of a state", help);
    }
    let ids = sheet.column("track_id");
    unlike(&sheet, ids, tracks);
    let time_column = time_column.filter(|_| findings.none())?;
    let known = |column| column == time_column || Some(column) == ids || columns.contains(&Some(column));
    let ignored =
        sheet.header.iter().enumerate().filter(|(column, _)| !known(*column)).map(|(_, name)| name.clone());
    let mut truth = Truth {
        fingerprint: findings.source.fingerprint(),
        times: Vec::new(),
        tracks: Vec::new(),
        states: columns.iter().map(|column| column.map(|_| Vec::new())).collect(),
        lines: Vec::new(),
        ignored: ignored.collect(),
    };
    let named = tracks.tracks.iter().enumerate();
    let named = named.filter_map(|(index, track)| Some((track.id.as_deref()?, index))).collect();
    let mut latest: Vec<Option<(f64, usize)>> = vec![None; tracks.tracks.len()];
    while let Some(fields) = sheet.next_row() {
        let Some(index) = track(findings, &fields, ids, &named) else { continue };
        let Some(track) = tracks.tracks.get(index) else { continue };
        let Some(time) = on_axis(findings, &fields, time_column, track) else { continue };
        if let Some(latest) = latest.get_mut(index) {
            if let Some((before, line)) = latest.filter(|(before, _)| *before >= time) {
                let how = if before > time { "stands after a later one" } else { "is there twice" };
                let message = format!("the time {} {how} (line {line})", fields.text(time_column));
                findings.wrong_help(
                    &fields.span(time_column),
                    message,
                    "sort the rows of each track by time",
                );
            }
            *latest = Some((time, fields.line()));
        }
        truth.times.push(time);
        truth.tracks.push(index);
        truth.lines.push(fields.line());
        for (state, column) in truth.states.iter_mut().zip(&columns) {
            if let (Some(state), Some(column)) = (state, *column) {
                let Cell::Number(value) = number(findings, &fields, column) else {
                    state.push(f64::NAN);
                    continue;
                };
                state.push(value);
            }
        }
    }
    if truth.times.is_empty() && findings.none() {
        findings.push(
            findings
                .source
                .whole("the table has a header but no rows")
                .with_help("each row is one true state"),
        );
    }
    Some(truth)
}

/// Whether the truth names tracks must be as the data do.
fn unlike(sheet: &Sheet, ids: Option<usize>, tracks: &Tracks) {
    match ids {
        Some(column) if !tracks.has_track_id => {
            let help = "remove it here, or add it to the data";
            sheet.findings.wrong_help(&sheet.name_span(column), "the data have no column `track_id`", help);
        }
        None if tracks.tracks.len() > 1 => {
            let message = "the table has no column `track_id`, but the data have several tracks";
            sheet.findings.wrong_help(
                &sheet.header_span(),
                message,
                "name the track of each row as the data do",
            );
        }
        _ => {}
    }
}

/// The index of a row's track, by its name among those of the data.
fn track(
    findings: &Findings,
    fields: &Fields,
    ids: Option<usize>,
    named: &HashMap<&str, usize>,
) -> Option<usize> {
    let Some(column) = ids else { return Some(0) };
    let id = track_id(findings, fields, column)?;
    let found = named.get(id).copied();
    if found.is_none() {
        let near = suggest(id, named.keys().copied());
        let help = near.map(|near| format!("did you mean `{near}`?"));
        findings.wrong_maybe(&fields.span(column), format!("the data have no track `{}`", short(id)), help);
    }
    found
}

/// The time of a row, on the axis of its track.
fn on_axis(findings: &Findings, fields: &Fields, column: usize, track: &Track) -> Option<f64> {
    // The track tells the kind, so that a mixture is found at the first row that differs.
    let kind = track.origin.map_or(Time::Seconds(0.0), Time::Calendar);
    match (time(findings, fields, column, Some(kind))?, track.origin) {
        (Time::Calendar(instant), Some(origin)) => Some(instant.since(origin)),
        (Time::Seconds(seconds), None) => Some(seconds),
        _ => None,
    }
}
