//! Times in cells: seconds, or RFC 3339.

use jiff::{SignedDuration, Timestamp};

use super::cell::{Cell, number, short};
use super::sheet::Fields;
use crate::findings::Findings;

/// An instant of the calendar, from which a model or a track counts its seconds.
///
/// ```
/// let noon = givens_io::Calendar::parse("2026-03-01T12:00:00Z").unwrap();
/// assert_eq!(givens_io::Calendar::parse("2026-03-01T13:00:01.5+01:00").unwrap().since(noon), 1.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Calendar(Timestamp);

impl Calendar {
    /// Reads RFC 3339 with its offset from UTC: `2026-03-01T12:00:00Z`, `2026-03-01T13:00:00.5+01:00`.
    ///
    /// # Errors
    /// What is missing or wrong, in words.
    pub fn parse(text: &str) -> Result<Self, String> {
        // What a date is shall be told before what the library makes of it.
        let digits = text.bytes().take_while(u8::is_ascii_digit).count();
        if digits != 4 || text.as_bytes().get(4) != Some(&b'-') || text.contains('[') {
            return Err("it is not of the form 2026-03-01T12:00:00Z".into());
        }
        text.parse().map(Self).map_err(|error| error.to_string())
    }

    /// Seconds from `earlier` to `self`.
    pub fn since(self, earlier: Self) -> f64 {
        let nanoseconds = self.0.as_nanosecond() - earlier.0.as_nanosecond();
        nanoseconds as f64 / 1e9
    }

    /// The instant `seconds` later, if the calendar goes so far.
    pub fn after(self, seconds: f64) -> Option<Self> {
        let step = SignedDuration::try_from_secs_f64(seconds).ok()?;
        self.0.checked_add(step).ok().map(Self)
    }
}

impl core::fmt::Display for Calendar {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.0.fmt(f)
    }
}

/// A time as a table gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Time {
    Seconds(f64),
    Calendar(Calendar),
}

/// Reads the time of a row, of the same kind as `before` if that is known; a time that is wrong has left a finding.
pub(super) fn time(findings: &Findings, row: &Fields, column: usize, before: Option<Time>) -> Option<Time> {
    let text = row.text(column);
    if text.is_empty() {
        findings.wrong_help(&row.span(column), "a row has no time", "every row states its `time`");
        return None;
    }
    let calendar = match before {
        Some(Time::Seconds(_)) => false,
        Some(Time::Calendar(_)) => true,
        None => text.parse::<f64>().is_err() && text.starts_with(|c: char| c.is_ascii_digit()),
    };
    let other = if calendar { text.parse::<f64>().is_ok() } else { Calendar::parse(text).is_ok() };
    if other && before.is_some() {
        let (here, there) = if calendar { ("seconds", "RFC 3339") } else { ("RFC 3339", "seconds") };
        let message = format!("the time `{}` is in {here}, but the rows before give {there}", short(text));
        findings.wrong_help(&row.span(column), message, "write all times alike");
        return None;
    }
    if !calendar {
        let Cell::Number(seconds) = number(findings, row, column) else { return None };
        return Some(Time::Seconds(seconds));
    }
    match Calendar::parse(text) {
        Ok(instant) => Some(Time::Calendar(instant)),
        Err(error) => {
            let message = format!("`{}` in {} is not a time: {error}", short(text), row.column(column));
            let help = "write seconds (12.5), or RFC 3339 with its offset (2026-03-01T12:00:00Z)";
            findings.wrong_help(&row.span(column), message, help);
            None
        }
    }
}
