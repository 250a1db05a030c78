//! Rows: cells become measures and controls.

use givens_expr::suggest;

use super::Row;
use super::cell::{Cell, short};
use super::cells::Cells;
use super::header::Columns;
use super::time::Time;
use crate::findings::{Findings, list};
use crate::scheme::Scheme;

/// A row with its time as the table gives it.
pub(super) struct Raw {
    pub row: Row,
    pub time: Time,
}

/// The cell of `track_id`.
pub(super) fn track_id<'f>(findings: &Findings, fields: &'f impl Cells, column: usize) -> Option<&'f str> {
    let id = fields.word(column);
    if id.is_empty() {
        let help = "name its track, or remove the column if all rows are of one";
        fields.wrong(findings, column, "a row has no `track_id`", help);
        return None;
    }
    Some(id)
}

/// Reads a row; what is wrong is found so.
pub(super) fn row(
    findings: &Findings,
    fields: &impl Cells,
    columns: &Columns,
    scheme: &Scheme,
    before: Option<Time>,
    index: usize,
) -> Option<Raw> {
    let time = fields.time(findings, columns.time, before);
    let u: Vec<f64> = columns
        .controls
        .iter()
        .filter_map(|&column| match fields.number(findings, column) {
            Cell::Number(value) => Some(value),
            Cell::Wrong => None,
            Cell::Empty => {
                let message = format!("the control {} is missing", fields.column(column));
                fields.wrong(findings, column, message, "every row states its controls");
                None
            }
        })
        .collect();
    let sensor = sensor(findings, fields, columns, scheme).ok()?;
    let z = if columns.measured {
        measures(findings, fields, columns, scheme, sensor)
    } else {
        asked(findings, fields, scheme, sensor)
    };
    let (time, time_text) = time?;
    let row = Row {
        line: fields.line(),
        index,
        // The seconds of a calendar time are known when its track is.
        time: if let Time::Seconds(seconds) = time { seconds } else { 0.0 },
        time_text,
        sensor,
        z,
        u,
    };
    Some(Raw { row, time })
}

/// What was wrong was found so.
struct Found;

/// The sensor that a row names, if it names one; a name that cannot stand is found wrong.
fn sensor(
    findings: &Findings,
    fields: &impl Cells,
    columns: &Columns,
    scheme: &Scheme,
) -> Result<Option<usize>, Found> {
    let Some((column, name)) = columns.sensor.map(|column| (column, fields.word(column))) else {
        return Ok(None);
    };
    if name.is_empty() {
        return Ok(None);
    }
    let found = scheme.sensors.iter().position(|sensor| sensor.name == name);
    let names = || scheme.sensors.iter().map(|sensor| sensor.name.as_str());
    let Some(index) = found else {
        fields.wrong_by(findings, column, || {
            let help = match suggest(name, names()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the model has {}", list(names())),
            };
            (format!("unknown sensor `{}`", short(name)), help)
        });
        return Err(Found);
    };
    Ok(Some(index))
}

/// A zero for each measure that a row of a table of times asks for: those of its sensor, or all.
fn asked(findings: &Findings, fields: &impl Cells, scheme: &Scheme, sensor: Option<usize>) -> Vec<f64> {
    let own = sensor.and_then(|index| scheme.sensors.get(index));
    if let (None, Some(name)) = (own, shared_column(scheme)) {
        let message = format!("the sensors share the column `{name}`, and this row names none");
        fields.wrong(findings, 0, message, "name a `sensor` in each row");
    }
    let asks = |index: &usize| own.is_none_or(|own| own.measures.contains(index));
    (0..scheme.measures()).map(|index| if asks(&index) { 0.0 } else { f64::NAN }).collect()
}

/// A column that belongs to several sensors.
fn shared_column(scheme: &Scheme) -> Option<&str> {
    let mut seen = std::collections::HashSet::new();
    let mut names = scheme.sensors.iter().flat_map(|sensor| &sensor.columns);
    names.find(|name| !seen.insert(name.as_str())).map(String::as_str)
}

/// The measures that a row brings; values that its sensor does not have are found wrong.
fn measures(
    findings: &Findings,
    fields: &impl Cells,
    columns: &Columns,
    scheme: &Scheme,
    sensor: Option<usize>,
) -> Vec<f64> {
    let mut z = vec![f64::NAN; columns.measures.len()];
    let own = sensor.and_then(|index| scheme.sensors.get(index));
    let mut told = Vec::new();
    for (index, (&column, &shared)) in columns.measures.iter().zip(&columns.shared).enumerate() {
        let Some(column) = column else { continue };
        if own.is_some_and(|own| !own.measures.contains(&index)) {
            let other = own.is_some_and(|own| own.columns.iter().any(|name| fields.name(column) == name));
            if !other && !fields.is_empty(column) && !told.contains(&column) {
                told.push(column);
                let name = own.map_or("", |own| own.name.as_str());
                let message =
                    format!("{} is no measure of the sensor `{name}` of this row", fields.column(column));
                fields.wrong(findings, column, message, "give each sensor a row of its own");
            }
            continue;
        }
        if shared && own.is_none() {
            if !fields.is_empty(column) && !told.contains(&column) {
                told.push(column);
                let message =
                    format!("{} belongs to several sensors, and the row names none", fields.column(column));
                fields.wrong(findings, column, message, "fill in its `sensor`");
            }
            continue;
        }
        if let (Cell::Number(value), Some(slot)) = (fields.number(findings, column), z.get_mut(index)) {
            *slot = value;
        }
    }
    if let (Some(own), Some(column)) = (own, columns.sensor) {
        let absent =
            own.measures.clone().all(|index| columns.measures.get(index).is_none_or(Option::is_none));
        if absent && columns.measures.iter().any(Option::is_some) {
            let message = format!("the table has no columns of the sensor `{}`", own.name);
            let help = format!("its measures are {}", list(own.columns.iter().map(String::as_str)));
            fields.wrong(findings, column, message, help);
        }
    }
    z
}
