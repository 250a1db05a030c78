//! What the columns of a table mean to a model.

use std::path::Path;

use givens_expr::suggest;

use super::sheet::Sheet;
use crate::findings::{count, list};
use crate::scheme::Scheme;

/// Which column brings what; indices are of columns.
#[derive(Debug)]
pub(super) struct Columns {
    pub time: usize,
    pub track: Option<usize>,
    pub sensor: Option<usize>,
    /// One for each control of the model.
    pub controls: Vec<usize>,
    /// One for each measure of the stack; none for the sensors that the table lacks.
    pub measures: Vec<Option<usize>>,
    /// Whether the measures were looked for.
    pub measured: bool,
    /// For each measure, whether another sensor of the table has the same column.
    pub shared: Vec<bool>,
    /// Names of the columns that mean nothing to the model.
    pub ignored: Vec<String>,
}

impl Columns {
    /// Whether names are read from a column: of tracks or sensors.
    pub fn names(&self, column: usize) -> bool {
        self.track == Some(column) || self.sensor == Some(column)
    }

    /// Whether a column is read.
    pub fn reads(&self, column: usize) -> bool {
        let one_of = |columns: &[usize]| columns.contains(&column);
        self.time == column
            || self.names(column)
            || one_of(&self.controls)
            || self.measures.contains(&Some(column))
    }
}

/// Finds the columns of measurements, or only those of times and controls; what is missing is found wrong.
pub(super) fn columns(sheet: &Sheet, scheme: &Scheme, measured: bool) -> Option<Columns> {
    let time = time(sheet);
    if time.is_none() && is_model(sheet) {
        return None;
    }
    let controls: Vec<usize> = scheme.controls.iter().filter_map(|name| control(sheet, name)).collect();
    let sensor = sheet.column("sensor");
    let track = sheet.column("track_id");
    let (measures, complete) = if measured {
        measures(sheet, scheme)
    } else {
        (vec![None; scheme.sensors.iter().map(|sensor| sensor.columns.len()).sum()], true)
    };
    let shared = shared(&measures);
    let ambiguous = sensor.is_none() && ambiguous(sheet, scheme, &measures, &shared);
    let names_measure = |name: &String| scheme.sensors.iter().any(|sensor| sensor.columns.contains(name));
    let ignored = sheet.header.iter().enumerate().filter(|&(column, name)| {
        let read = Some(column) == time || Some(column) == sensor || Some(column) == track;
        !(read || controls.contains(&column) || names_measure(name))
    });
    let ignored = ignored.map(
        |(column, name)| {
            if name.is_empty() { format!("column {}", column + 1) } else { name.clone() }
        },
    );
    let ignored = ignored.collect();
    let found = complete && !ambiguous && controls.len() == scheme.controls.len();
    time.filter(|_| found).map(|time| Columns {
        time,
        track,
        sensor,
        controls,
        measures,
        measured,
        shared,
        ignored,
    })
}

/// Whether a column of this name means something to the model.
pub(super) fn means(scheme: &Scheme, name: &str) -> bool {
    let measure = || scheme.sensors.iter().any(|sensor| sensor.columns.iter().any(|column| column == name));
    ["time", "track_id", "sensor"].contains(&name)
        || scheme.controls.iter().any(|control| control == name)
        || measure()
}

/// Whether a column bears the name of a measure.
pub(super) fn names_measures(sheet: &Sheet, scheme: &Scheme) -> bool {
    let mut columns = scheme.sensors.iter().flat_map(|sensor| &sensor.columns);
    columns.any(|name| sheet.column(name).is_some())
}

/// The column `time`.
pub(super) fn time(sheet: &Sheet) -> Option<usize> {
    let found = sheet.column("time");
    if found.is_none() && is_model(sheet) {
        let help = "the model comes first, then the data";
        sheet.findings.wrong_help(&sheet.header_span(), "this is a model file, not a table", help);
    } else if found.is_none() {
        let help = separator(sheet).unwrap_or_else(|| near(sheet, "time"));
        sheet.findings.wrong_help(&sheet.header_span(), "the table has no column `time`", help);
    }
    found
}

/// Whether the table begins as model files do: with the title of a section.
fn is_model(sheet: &Sheet) -> bool {
    let first = sheet.header.first().map_or("", String::as_str);
    let named = Path::new(&sheet.findings.source.name).extension().is_some_and(|ending| ending == "toml");
    first.starts_with('[') || (first.starts_with('#') && named)
}

/// A header of one column that holds other separators was not written as CSV.
fn separator(sheet: &Sheet) -> Option<String> {
    let [only] = sheet.header.as_slice() else { return None };
    let found = [(';', "semicolons"), ('\t', "tabs")].into_iter().find(|(c, _)| only.contains(*c))?;
    Some(format!("the columns are separated by {}: write commas", found.1))
}

/// The remedy for a column that is missing.
pub(super) fn near(sheet: &Sheet, name: &str) -> String {
    // a control's column without its prefix
    let bare = name.strip_prefix("u_").filter(|bare| sheet.column(bare).is_some());
    match bare.or_else(|| suggest(name, sheet.header.iter().map(String::as_str))) {
        Some(other) => format!("rename `{other}` to `{name}`"),
        None => format!("the table has {}", list(sheet.header.iter().map(String::as_str))),
    }
}

fn control(sheet: &Sheet, name: &str) -> Option<usize> {
    let found = sheet.column(name);
    if found.is_none() {
        let message = format!("the table has no column `{name}`, a control that the model uses");
        sheet.findings.wrong_help(&sheet.header_span(), message, near(sheet, name));
    }
    found
}

/// The columns of all measures, and whether they can be used.
fn measures(sheet: &Sheet, scheme: &Scheme) -> (Vec<Option<usize>>, bool) {
    let (mut found, mut complete, mut any) = (Vec::new(), true, false);
    for (index, sensor) in scheme.sensors.iter().enumerate() {
        let columns: Vec<Option<usize>> = sensor.columns.iter().map(|name| sheet.column(name)).collect();
        let elsewhere = |name: &String| {
            scheme.sensors.iter().enumerate().any(|(other, s)| other != index && s.columns.contains(name))
        };
        // A column shared with another sensor does not show that this one is there, unless it has no other.
        let own = |i: usize| sensor.columns.get(i).is_some_and(|name| !elsewhere(name));
        let has_own = (0..columns.len()).any(own);
        let present = columns.iter().enumerate().any(|(i, column)| column.is_some() && (own(i) || !has_own));
        if !present {
            found.extend(vec![None; columns.len()]);
            continue;
        }
        any = true;
        for (name, _) in sensor.columns.iter().zip(&columns).filter(|(_, column)| column.is_none()) {
            complete = false;
            let message =
                format!("the table has no column `{name}`, a measure of the sensor `{}`", sensor.name);
            let help = format!("{}; a sensor may be absent as a whole, not in part", near(sheet, name));
            sheet.findings.wrong_help(&sheet.header_span(), message, help);
        }
        found.extend(columns);
    }
    if !any {
        complete = false;
        let names = || scheme.sensors.iter().flat_map(|sensor| sensor.columns.iter().map(String::as_str));
        let message = format!(
            "the table has none of the model's {}: {}",
            count(names().count(), "measure"),
            list(names())
        );
        let near = names().find_map(|name| {
            let other = suggest(name, sheet.header.iter().map(String::as_str))?;
            Some(format!("rename `{other}` to `{name}`"))
        });
        let help = near.unwrap_or_else(|| "the columns bear the names of the measures".into());
        sheet.findings.wrong_help(&sheet.header_span(), message, separator(sheet).unwrap_or(help));
    }
    (found, complete)
}

fn shared(measures: &[Option<usize>]) -> Vec<bool> {
    let times = |column| measures.iter().filter(|other| **other == Some(column)).count();
    measures.iter().map(|column| column.is_some_and(|column| times(column) > 1)).collect()
}

/// Without a column `sensor`, a value in a shared column could be of either sensor.
fn ambiguous(sheet: &Sheet, scheme: &Scheme, measures: &[Option<usize>], shared: &[bool]) -> bool {
    let Some((column, _)) = measures.iter().zip(shared).find(|(_, shared)| **shared) else { return false };
    let column = column.unwrap_or(0);
    let name = sheet.header.get(column).map_or("", String::as_str);
    let owners = scheme.sensors.iter().filter(|sensor| sensor.columns.iter().any(|other| other == name));
    let message =
        format!("the column `{name}` belongs to the sensors {}", list(owners.map(|s| s.name.as_str())));
    sheet.findings.wrong_help(
        &sheet.name_span(column),
        message,
        "add a column `sensor` that names the one of each row",
    );
    true
}
