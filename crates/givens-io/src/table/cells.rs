//! One row of a table, as text or in columns: what its cells hold, and how an error about one tells its place.

use super::cell::{Cell, number};
use super::sheet::Fields;
use super::time::{Time, time};
use crate::findings::Findings;

/// The cells of a row.
pub(super) trait Cells {
    /// The line, from one; of a table in columns the row.
    fn line(&self) -> usize;
    /// What that number is of.
    fn counted(&self) -> &'static str;
    /// The name of a column.
    fn name(&self, column: usize) -> &str;
    /// A column in words: its name and its number.
    fn column(&self, column: usize) -> String;
    /// Whether nothing stands there.
    fn is_empty(&self, column: usize) -> bool;
    /// A name that stands there, without the space around it; empty where there is none.
    fn word(&self, column: usize) -> &str;
    /// A number; what is neither empty nor a finite number is found wrong.
    fn number(&self, findings: &Findings, column: usize) -> Cell;
    /// The time, of the same kind as `before` if that is known, and as it is to be written; one that is wrong has left a finding.
    fn time(&self, findings: &Findings, column: usize, before: Option<Time>) -> Option<(Time, String)>;
    /// An error about a cell, and its remedy, made where there is room for it.
    fn wrong_by(&self, findings: &Findings, column: usize, told: impl FnOnce() -> (String, String));
    /// An error about a cell, and its remedy.
    fn wrong(&self, findings: &Findings, column: usize, message: impl Into<String>, help: impl Into<String>) {
        self.wrong_by(findings, column, || (message.into(), help.into()));
    }
}

impl Cells for Fields<'_> {
    fn line(&self) -> usize {
        Fields::line(self)
    }
    fn counted(&self) -> &'static str {
        "line"
    }
    fn name(&self, column: usize) -> &str {
        Fields::name(self, column)
    }
    fn column(&self, column: usize) -> String {
        Fields::column(self, column)
    }
    fn is_empty(&self, column: usize) -> bool {
        self.text(column).is_empty()
    }
    fn word(&self, column: usize) -> &str {
        self.text(column)
    }
    fn number(&self, findings: &Findings, column: usize) -> Cell {
        number(findings, self, column)
    }
    fn time(&self, findings: &Findings, column: usize, before: Option<Time>) -> Option<(Time, String)> {
        Some((time(findings, self, column, before)?, self.text(column).to_owned()))
    }
    fn wrong_by(&self, findings: &Findings, column: usize, told: impl FnOnce() -> (String, String)) {
        findings.wrong_by(&self.span(column), told);
    }
}
