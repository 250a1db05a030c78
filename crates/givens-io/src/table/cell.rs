//! Numbers in cells.

use super::sheet::Fields;
use crate::findings::Findings;

/// What stands in a cell that holds a number or nothing.
pub(super) enum Cell {
    Empty,
    Number(f64),
    /// Neither; it was found wrong.
    Wrong,
}

/// Reads the cell of a column; what is neither empty nor a finite number is found wrong.
pub(super) fn number(findings: &Findings, row: &Fields, column: usize) -> Cell {
    let text = row.text(column);
    if text.is_empty() {
        return Cell::Empty;
    }
    let (message, help) = match text.parse::<f64>() {
        Ok(number) if number.is_finite() => return Cell::Number(number),
        Ok(_) if text.bytes().any(|byte| byte.is_ascii_digit()) => (
            format!("{} in {} is too large for a number", short(text), row.column(column)),
            "check the units",
        ),
        Ok(_) => (
            format!("`{}` in {} is not a finite number", short(text), row.column(column)),
            "leave the cell empty where there is no value",
        ),
        Err(_) => (
            format!("`{}` in {} is not a number", short(text), row.column(column)),
            "numbers are written as 12, -0.5 or 1e-3; leave the cell empty where there is no value",
        ),
    };
    findings.wrong_help(&row.span(column), message, help);
    Cell::Wrong
}

/// The beginning of a text that is too long for a message.
pub(super) fn short(text: &str) -> String {
    const LONG: usize = 40;
    match text.char_indices().nth(LONG) {
        Some((end, _)) => format!("{}…", text.get(..end).unwrap_or(text)),
        None => text.to_string(),
    }
}
