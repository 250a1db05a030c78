//! Times in cells: seconds, or RFC 3339.

use givens_core::scalar::Shown;
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
        shaped(text)?;
        let instant: Timestamp = text.parse().map_err(|error: jiff::Error| {
            if text.starts_with("9999-12-3") {
                "the last instant that can be counted is 9999-12-30T22:00:00Z".to_owned()
            } else {
                error.to_string()
            }
        })?;
        Ok(Self(instant))
    }

    /// The instant so many nanoseconds after 1970-01-01T00:00:00Z, if the calendar goes so far.
    pub(super) fn of_nanoseconds(nanoseconds: i128) -> Option<Self> {
        Timestamp::from_nanosecond(nanoseconds).ok().map(Self)
    }

    /// Nanoseconds since 1970-01-01T00:00:00Z.
    pub(crate) fn nanoseconds(self) -> i128 {
        self.0.as_nanosecond()
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

/// Whether a text has the shape of RFC 3339. What another reader would bend to it is refused: a leap second would
/// become the second before.
fn shaped(text: &str) -> Result<(), String> {
    let form = || Err("it is not of the form 2026-03-01T12:00:00Z".to_owned());
    let shape = |text: &str| text.replace(|c: char| c.is_ascii_digit(), "0");
    let Some((moment, rest)) = text.split_at_checked(19) else {
        return match shape(text).as_str() {
            "0000-00-00" => Err("its time of day is missing".into()),
            _ => form(),
        };
    };
    let separated = moment.replacen(['t', ' '], "T", 1);
    if shape(&separated) != "0000-00-00T00:00:00" {
        return form();
    }
    if moment.ends_with(":60") {
        return Err("a leap second cannot be told from its neighbours here".into());
    }
    let fraction =
        rest.strip_prefix('.').map_or(0, |rest| rest.bytes().take_while(u8::is_ascii_digit).count());
    let offset = if fraction == 0 { rest } else { rest.get(fraction + 1..).unwrap_or("") };
    if fraction > 9 {
        return Err("it has more than nine digits behind the point of its seconds".into());
    }
    match (offset, shape(offset).as_str()) {
        ("", _) => Err("its offset from UTC is missing, such as Z or +01:00".into()),
        ("Z" | "z", _) => Ok(()),
        (_, "+00:00" | "-00:00") if &offset[1..3] < "24" && &offset[4..] < "60" => Ok(()),
        _ => Err(format!("`{offset}` is no offset from UTC, such as Z or +01:00")),
    }
}

/// A time in words: RFC 3339 if times count from such an origin, else seconds.
pub(super) fn time_text(origin: Option<Calendar>, time: f64) -> String {
    match origin.and_then(|origin| origin.after(time)) {
        Some(instant) => instant.to_string(),
        None => Shown(time).to_string(),
    }
}

/// Whether two texts, of times that are the same number of seconds, mean different times all the same.
pub(super) fn differ(a: &str, b: &str) -> bool {
    match (Calendar::parse(a), Calendar::parse(b)) {
        (Ok(a), Ok(b)) => a != b,
        _ => decimal(a) != decimal(b),
    }
}

/// A decimal number without its rounding: its digits from the first to the last that is not zero, its sign, and the
/// power of ten of the first.
fn decimal(text: &str) -> (String, bool, i64) {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let whole = mantissa.split('.').next().unwrap_or("").trim_start_matches(['+', '-', '0']);
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let kept = digits.trim_matches('0');
    if kept.is_empty() {
        return (String::new(), false, 0);
    }
    // below one, the zeros behind the point
    let behind = mantissa.split_once('.').map_or("", |(_, part)| part);
    let zeros = behind.len() - behind.trim_start_matches('0').len();
    let length = |text: usize| i64::try_from(text).unwrap_or(i64::MAX);
    let first = if whole.is_empty() { -length(zeros) } else { length(whole.len()) };
    (kept.to_owned(), mantissa.starts_with('-'), exponent.parse().unwrap_or(0_i64).saturating_add(first))
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
    let letters = !text.bytes().any(|byte| byte.is_ascii_digit());
    if letters && text.parse::<f64>().is_ok() {
        let message = format!("`{}` in {} is not a finite number", short(text), row.column(column));
        findings.wrong_help(&row.span(column), message, "every row states its `time`");
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
