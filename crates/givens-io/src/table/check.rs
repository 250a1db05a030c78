//! The order of rows in time.

use givens_core::scalar::Shown;

use super::cell::short;
use super::cells::Cells;
use super::row::Raw;
use super::rows::Rows;
use super::time::{Calendar, Time, differ, time_text};
use super::{Row, Track};
use crate::findings::Findings;
use crate::scheme::Scheme;

/// A gap is a whole number of steps if it is so to this part of one.
const WHOLE: f64 = 1e-6;
/// More steps between two rows than anyone means, as of a filter.
const MANY: f64 = 1e7;

/// A track to which rows are added, each checked against those before.
pub(super) struct Growing {
    pub track: Track,
    /// The line and the sensor of each row at the time of the last one.
    latest: Vec<(usize, Option<usize>)>,
}

/// What is checked: a row, and where its time stands.
pub(super) struct Check<'a, C> {
    pub findings: &'a Findings<'a>,
    pub scheme: &'a Scheme,
    /// The column of times.
    pub column: usize,
    /// The row.
    pub cells: &'a C,
}

impl Growing {
    /// A track with its first row; none where its times are not those of the model, which is found so.
    pub fn begin(check: &Check<impl Cells>, id: Option<String>, raw: Raw) -> Option<Self> {
        let (origin, start) = check.origin(raw.time)?;
        let row = on_axis(raw, origin);
        let start = start.unwrap_or(row.time);
        check.first(&row, start, origin);
        let latest = vec![(row.line, row.sensor)];
        Some(Self { track: Track { id, start, rows: Rows::from(vec![row]), origin }, latest })
    }

    /// Adds a row behind the others.
    pub fn push(&mut self, check: &Check<impl Cells>, raw: Raw) {
        let row = on_axis(raw, self.track.origin);
        if let Some(before) = self.track.rows.last() {
            check.follows(&row, before, &self.latest);
            if row.time != before.time {
                self.latest.clear();
            }
        }
        self.latest.push((row.line, row.sensor));
        self.track.rows.push(row);
    }
}

/// Seconds from the origin of the track.
fn on_axis(raw: Raw, origin: Option<Calendar>) -> Row {
    let time = match (raw.time, origin) {
        (Time::Calendar(instant), Some(origin)) => instant.since(origin),
        _ => raw.row.time,
    };
    Row { time, ..raw.row }
}

impl<C: Cells> Check<'_, C> {
    fn wrong(&self, message: String, help: &str) {
        self.cells.wrong(self.findings, self.column, message, help);
    }

    /// The instant from which a track with this first time counts, and the time of the initial belief where the model states it.
    fn origin(&self, first: Time) -> Option<(Option<Calendar>, Option<f64>)> {
        let scheme = self.scheme;
        match (first, scheme.epoch) {
            (Time::Seconds(_), None) => Some((None, scheme.time)),
            (Time::Calendar(_), Some(epoch)) => Some((Some(epoch), scheme.time)),
            (Time::Calendar(instant), None) => Some((Some(instant), scheme.time)),
            (Time::Seconds(_), Some(epoch)) => {
                let message = format!("the table gives times in seconds, but the model's `time` is {epoch}");
                self.wrong(message, "write both as seconds, or both as RFC 3339");
                None
            }
        }
    }

    /// The first row against the initial belief.
    fn first(&self, row: &Row, start: f64, origin: Option<Calendar>) {
        if row.time < start {
            let message = format!(
                "the row at {} lies before the initial belief, which holds at {}",
                short(&row.time_text),
                time_text(origin, start)
            );
            self.wrong(message, self.scheme.late);
            return;
        }
        let from = format!("the initial belief at {}", time_text(origin, start));
        self.steps(row, row.time - start, start, || from);
    }

    /// A row against the one before, and all at the time of that.
    fn follows(&self, row: &Row, before: &Row, latest: &[(usize, Option<usize>)]) {
        let counted = self.cells.counted();
        let there = || format!("the row at {} ({counted} {})", short(&before.time_text), before.line);
        if row.time < before.time {
            let message = format!("the row at {} stands after {}", short(&row.time_text), there());
            self.wrong(message, "sort the rows of each track by time");
        } else if row.time > before.time {
            self.steps(row, row.time - before.time, before.time, there);
        } else if differ(&row.time_text, &before.time_text) {
            let (here, line) = (short(&row.time_text), before.line);
            let message = format!(
                "the time {here} cannot be told from that of {counted} {line}, in seconds to 16 digits"
            );
            self.wrong(message, "count the times from an instant near the data");
        } else if let Some((line, _)) = latest.iter().find(|(_, sensor)| *sensor == row.sensor) {
            let message = format!("two rows at {}: this one and {counted} {line}", short(&row.time_text));
            self.wrong(message, "write them as one row, or name a different `sensor` in each");
        }
    }

    /// With a fixed step, a gap is a whole number of them.
    fn steps(&self, row: &Row, gap: f64, from: f64, there: impl FnOnce() -> String) {
        let Some(step) = self.scheme.step else { return };
        let steps = gap / step;
        // Times that are large against the step bring their own rounding.
        let rounding = 4.0 * f64::EPSILON * from.abs().max(row.time.abs()) / step;
        if steps > MANY {
            let (there, here) = (there(), short(&row.time_text));
            let message = format!("from {there} to {here} are {steps:.3e} steps of {}", Shown(step));
            self.wrong(message, "`step` and the times are in the same unit");
        } else if (steps - steps.round()).abs() > WHOLE.max(rounding) {
            let message = format!(
                "from {} to {} ({} {}) are {} steps of {}, not a whole number",
                there(),
                short(&row.time_text),
                self.cells.counted(),
                row.line,
                fraction(steps),
                Shown(step)
            );
            self.wrong(message, "leave `step` out of the model to allow any gap, or choose one that fits");
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
