//! Rows of a table in columns.

use arrow_array::{Array, RecordBatch};

use super::cell::{Cell, short};
use super::cells::Cells;
use super::header::Columns;
use super::time::{Calendar, Time};
use crate::decode::{Kind, floats, integers, kind, texts, unsigned};
use crate::findings::Findings;
use givens_core::scalar::Shown;

/// Rows that lie together in columns, of which those are read that mean something to the model.
pub(super) struct Block<'a> {
    header: &'a [String],
    columns: Vec<Values>,
    /// Rows of the table before.
    before: usize,
    rows: usize,
}

/// What a column holds.
enum Values {
    /// Nothing that is read.
    Nothing,
    /// NaN where there is none.
    Numbers(Vec<f64>),
    /// Nanoseconds since 1970.
    Instants(Vec<Option<i128>>),
    Words(Vec<Option<String>>),
    /// Of a type that says nothing to us.
    Other(String),
}

/// A row of them.
#[derive(Clone, Copy)]
pub(super) struct RowOf<'a> {
    block: &'a Block<'a>,
    row: usize,
}

impl<'a> Block<'a> {
    /// The columns that were `read` of a table with this header, behind so many rows.
    pub fn read(
        header: &'a [String],
        batch: &RecordBatch,
        read: &[usize],
        columns: &Columns,
        before: usize,
    ) -> Self {
        let mut values: Vec<Values> = header.iter().map(|_| Values::Nothing).collect();
        for (&column, array) in read.iter().zip(batch.columns()) {
            if let Some(to) = values.get_mut(column) {
                *to = if columns.names(column) { words(array) } else { numbers(array) };
            }
        }
        Self { header, columns: values, before, rows: batch.num_rows() }
    }

    /// Its rows.
    pub fn rows(&self) -> impl Iterator<Item = RowOf<'_>> {
        (0..self.rows).map(|row| RowOf { block: self, row })
    }
}

/// Names: texts, or whole numbers.
fn words(array: &dyn Array) -> Values {
    let whole = |k: usize, text: String| (!array.is_null(k)).then_some(text);
    match kind(array.data_type()) {
        Kind::Text => Values::Words(texts(array)),
        Kind::Whole => {
            Values::Words(integers(array).into_iter().map(|id| id.map(|id| id.to_string())).collect())
        }
        Kind::Unsigned => Values::Words(
            unsigned(array).into_iter().enumerate().map(|(k, id)| whole(k, id.to_string())).collect(),
        ),
        _ => Values::Other(array.data_type().to_string()),
    }
}

fn numbers(array: &dyn Array) -> Values {
    let each = |unit: &str| -> i128 {
        match unit {
            "D" => 86_400_000_000_000,
            "s" => 1_000_000_000,
            "ms" => 1_000_000,
            "us" => 1_000,
            _ => 1,
        }
    };
    match kind(array.data_type()) {
        Kind::Number | Kind::Whole | Kind::Unsigned => Values::Numbers(floats(array)),
        Kind::Date(unit, _) => {
            let nanoseconds = |count: Option<i64>| count.map(|count| i128::from(count) * each(unit));
            Values::Instants(integers(array).into_iter().map(nanoseconds).collect())
        }
        Kind::Duration(unit) => {
            let second = 1e9 / each(unit) as f64;
            let seconds = |count: Option<i64>| count.map_or(f64::NAN, |count| count as f64 / second);
            Values::Numbers(integers(array).into_iter().map(seconds).collect())
        }
        Kind::Text => Values::Words(texts(array)),
        Kind::Other => Values::Other(array.data_type().to_string()),
    }
}

impl RowOf<'_> {
    fn values(&self, column: usize) -> &Values {
        self.block.columns.get(column).unwrap_or(&Values::Nothing)
    }

    /// A column that holds no numbers.
    fn other(&self, findings: &Findings, column: usize, of: &str) -> Cell {
        let message = format!("{} holds {of}, not numbers", self.column(column));
        self.wrong(findings, column, message, "write it as numbers, with null where there is no value");
        Cell::Wrong
    }
}

impl Cells for RowOf<'_> {
    fn line(&self) -> usize {
        self.block.before + self.row + 1
    }

    fn counted(&self) -> &'static str {
        "row"
    }

    fn name(&self, column: usize) -> &str {
        self.block.header.get(column).map_or("", String::as_str)
    }

    fn column(&self, column: usize) -> String {
        format!("`{}`", self.name(column))
    }

    fn is_empty(&self, column: usize) -> bool {
        match self.values(column) {
            Values::Nothing => true,
            Values::Numbers(numbers) => numbers[self.row].is_nan(),
            Values::Instants(instants) => instants[self.row].is_none(),
            Values::Words(words) => words[self.row].as_deref().is_none_or(|word| word.trim().is_empty()),
            Values::Other(_) => false,
        }
    }

    fn word(&self, column: usize) -> &str {
        match self.values(column) {
            Values::Words(words) => words[self.row].as_deref().unwrap_or("").trim(),
            _ => "",
        }
    }

    fn number(&self, findings: &Findings, column: usize) -> Cell {
        match self.values(column) {
            Values::Nothing => Cell::Empty,
            Values::Numbers(numbers) => match numbers[self.row] {
                number if number.is_nan() => Cell::Empty,
                number if number.is_finite() => Cell::Number(number),
                number => {
                    let message =
                        format!("{} in {} is not a finite number", Shown(number), self.column(column));
                    self.wrong(findings, column, message, "write null where there is no value");
                    Cell::Wrong
                }
            },
            Values::Words(words) => match words[self.row].as_deref().map(str::trim) {
                None | Some("") => Cell::Empty,
                Some(text) => match text.parse::<f64>() {
                    Ok(number) if number.is_finite() => Cell::Number(number),
                    _ => {
                        let message = format!("`{}` in {} is not a number", short(text), self.column(column));
                        self.wrong(findings, column, message, "write null where there is no value");
                        Cell::Wrong
                    }
                },
            },
            Values::Instants(_) => self.other(findings, column, "dates"),
            Values::Other(of) => self.other(findings, column, of),
        }
    }

    fn time(&self, findings: &Findings, column: usize, before: Option<Time>) -> Option<(Time, String)> {
        if self.is_empty(column) {
            self.wrong(findings, column, "a row has no time", "every row states its `time`");
            return None;
        }
        let calendar = match self.values(column) {
            Values::Instants(instants) => {
                let instant = instants[self.row].and_then(Calendar::of_nanoseconds);
                if instant.is_none() {
                    let message =
                        format!("the date in {} is beyond those that can be counted", self.column(column));
                    self.wrong(findings, column, message, "the last one is 9999-12-30T22:00:00Z");
                    return None;
                }
                instant
            }
            Values::Words(words) => {
                let text = words[self.row].as_deref().unwrap_or("").trim();
                match (text.parse::<f64>(), Calendar::parse(text)) {
                    (Ok(_), _) => None,
                    (_, Ok(instant)) => Some(instant),
                    (_, Err(error)) => {
                        let message =
                            format!("`{}` in {} is not a time: {error}", short(text), self.column(column));
                        let help = "write seconds (12.5), or RFC 3339 with its offset (2026-03-01T12:00:00Z)";
                        self.wrong(findings, column, message, help);
                        return None;
                    }
                }
            }
            _ => None,
        };
        if let Some(instant) = calendar {
            if let Some(Time::Seconds(_)) = before {
                self.wrong(
                    findings,
                    column,
                    "a date, but the rows before give seconds",
                    "write all times alike",
                );
                return None;
            }
            return Some((Time::Calendar(instant), instant.to_string()));
        }
        let Cell::Number(seconds) = self.number(findings, column) else { return None };
        if let Some(Time::Calendar(_)) = before {
            self.wrong(findings, column, "seconds, but the rows before give dates", "write all times alike");
            return None;
        }
        Some((Time::Seconds(seconds), Shown(seconds).to_string()))
    }

    fn wrong_by(&self, findings: &Findings, _: usize, told: impl FnOnce() -> (String, String)) {
        findings.wrong_in_row(self.line(), told);
    }
}
