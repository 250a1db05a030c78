//! The order of rows in time.

use givens_core::scalar::Shown;

use super::cell::short;
use super::row::Raw;
use super::time::{Calendar, Time, differ, time_text};
use super::{Row, Track};
use crate::findings::Findings;
use crate::model_file::Model;

/// A gap is a whole number of steps if it is so to this part of one.
const WHOLE: f64 = 1e-6;
/// More steps between two rows than anyone means.
const MANY: f64 = 1e9;

/// Rows in time order become a track; none only where a finding was left.
pub(super) fn track(
    findings: &Findings,
    model: &Model,
    id: Option<String>,
    rows: Vec<Raw>,
    column: usize,
) -> Option<Track> {
    let first = rows.first()?;
    let (origin, start) = origin(findings, model, first, column)?;
    let starts: Vec<usize> = rows.iter().map(|raw| raw.start).collect();
    let rows: Vec<Row> = rows.into_iter().map(|raw| on_axis(raw, origin)).collect();
    let start = start.unwrap_or_else(|| rows.first().map_or(0.0, |row| row.time));
    let check = Check { findings, model, start, origin, column, rows: &rows, starts: &starts };
    check.begin();
    for k in 1..rows.len() {
        if !findings.room() {
            break;
        }
        check.follow(k);
    }
    Some(Track { id, start, rows, origin })
}

/// Seconds from the origin of the track.
fn on_axis(raw: Raw, origin: Option<Calendar>) -> Row {
    let time = match (raw.time, origin) {
        (Time::Calendar(instant), Some(origin)) => instant.since(origin),
        _ => raw.row.time,
    };
    Row { time, ..raw.row }
}

/// The instant from which the track counts, and the time of the initial belief where the model states it.
fn origin(
    findings: &Findings,
    model: &Model,
    first: &Raw,
    column: usize,
) -> Option<(Option<Calendar>, Option<f64>)> {
    match (first.time, model.epoch) {
        (Time::Seconds(_), None) => Some((None, model.time)),
        (Time::Calendar(_), Some(epoch)) => Some((Some(epoch), model.time)),
        (Time::Calendar(instant), None) => Some((Some(instant), model.time)),
        (Time::Seconds(_), Some(epoch)) => {
            let message = format!("the table gives times in seconds, but the model's `time` is {epoch}");
            let span = super::sheet::field_span(&findings.source.text, first.start, column);
            findings.wrong_help(&span, message, "write both as seconds, or both as RFC 3339");
            None
        }
    }
}

struct Check<'a> {
    findings: &'a Findings<'a>,
    model: &'a Model,
    start: f64,
    origin: Option<Calendar>,
    column: usize,
    rows: &'a [Row],
    starts: &'a [usize],
}

impl Check<'_> {
    fn wrong(&self, k: usize, message: String, help: &str) {
        let start = self.starts.get(k).copied().unwrap_or(0);
        let span = super::sheet::field_span(&self.findings.source.text, start, self.column);
        self.findings.wrong_help(&span, message, help);
    }

    /// The first row against the initial belief.
    fn begin(&self) {
        let Some(row) = self.rows.first() else { return };
        if row.time < self.start {
            let message = format!(
                "the row at {} lies before the initial belief, which holds at {}",
                short(&row.time_text),
                time_text(self.origin, self.start)
            );
            self.wrong(0, message, "set `time` in [state] to the first row's or earlier, or leave it out");
            return;
        }
        let from = format!("the initial belief at {}", time_text(self.origin, self.start));
        self.steps(0, row.time - self.start, self.start, &from);
    }

    /// Row `k` against the one before.
    fn follow(&self, k: usize) {
        let (Some(before), Some(row)) = (self.rows.get(k - 1), self.rows.get(k)) else { return };
        let there = format!("the row at {} (line {})", short(&before.time_text), before.line);
        if row.time < before.time {
            let message = format!("the row at {} stands after {there}", short(&row.time_text));
            self.wrong(k, message, "sort the rows of each track by time");
        } else if row.time > before.time {
            self.steps(k, row.time - before.time, before.time, &there);
        } else if differ(&row.time_text, &before.time_text) {
            let (here, line) = (short(&row.time_text), before.line);
            let message =
                format!("the time {here} cannot be told from that of line {line}, in seconds to 16 digits");
            self.wrong(k, message, "count the times from an instant near the data");
        } else if let Some(twin) = self.twin(k, row) {
            let message = format!("two rows at {}: this one and line {}", short(&row.time_text), twin.line);
            self.wrong(k, message, "write them as one row, or name a different `sensor` in each");
        }
    }

    /// An earlier row at the same time and of the same sensor.
    fn twin(&self, k: usize, row: &Row) -> Option<&Row> {
        let same_time = self.rows.iter().take(k).rev().take_while(|other| other.time == row.time);
        same_time.filter(|other| other.sensor == row.sensor).last()
    }

    /// With a fixed step, a gap is a whole number of them.
    fn steps(&self, k: usize, gap: f64, from: f64, there: &str) {
        let Some(step) = self.model.step() else { return };
        let Some(row) = self.rows.get(k) else { return };
        let steps = gap / step;
        let here = short(&row.time_text);
        // Times that are large against the step bring their own rounding.
        let rounding = 4.0 * f64::EPSILON * from.abs().max(row.time.abs()) / step;
        if steps > MANY {
            let message = format!("from {there} to {here} are {steps:.3e} steps of {}", Shown(step));
            self.wrong(k, message, "`step` and the times are in the same unit");
        } else if (steps - steps.round()).abs() > WHOLE.max(rounding) {
            let message = format!(
                "from {there} to {here} (line {}) are {} steps of {}, not a whole number",
                row.line,
                fraction(steps),
                Shown(step)
            );
            self.wrong(k, message, "leave `step` out of the model to allow any gap, or choose one that fits");
        }
    }
}

/// A number that is not whole, in six digits, or as a whole one and what is beside it.
fn fraction(x: f64) -> String {
    let near: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    if near.fract() != 0.0 {
        return Shown(near).to_string();
    }
    let (whole, beside) = (x.round(), x - x.round());
    format!("{} {} {:.1e}", Shown(whole), if beside < 0.0 { '-' } else { '+' }, beside.abs())
}
