//! How the innovations of the filter keep to their covariances: of moored vessels, and of moving ones at rest and under way.

use core::fmt::Write;

use crate::table::{Report, STILL};

/// A kind of report: its name, and which are of it.
type Kind = (&'static str, fn(&Report) -> bool);

/// A table of NIS over its degrees of freedom, one row for each kind of vessel.
pub fn report(reports: &[Report], filtered: &str) -> Result<String, String> {
    let mut lines = filtered.lines();
    let header: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let mut columns = [0; 4];
    for (column, name) in columns.iter_mut().zip(["nis", "nis_dof", "vel_east", "vel_north"]) {
        let place = header.iter().position(|cell| *cell == name);
        *column = place.ok_or_else(|| format!("line 1: there is no column `{name}`"))?;
    }
    let kinds: [Kind; 3] = [
        ("moored for the hour", |report| !report.moves),
        ("others, below one knot", |report| report.moves && report.speed <= STILL),
        ("others, under way", |report| report.moves && report.speed > STILL),
    ];
    let mut rows: [Vec<[f64; 3]>; 3] = Default::default();
    for (index, report) in reports.iter().enumerate() {
        let line =
            lines.next().ok_or_else(|| format!("line {}: the row of a report is missing", index + 2))?;
        let cells: Vec<&str> = line.split(',').collect();
        let number = |column: usize| cells.get(column).and_then(|cell| cell.parse::<f64>().ok());
        // rows up to the start of a vessel have no NIS
        let [Some(nis), Some(dof), Some(east), Some(north)] = columns.map(number) else { continue };
        if let Some(kind) = kinds.iter().position(|(_, is)| is(report)) {
            rows[kind].push([nis, dof, east.hypot(north)]);
        }
    }
    let mut report =
        "                          rows  mean NIS/dof   half below   95 % below   half slower than\n"
            .to_owned();
    for ((name, _), rows) in kinds.iter().zip(&rows) {
        let sum = |i: usize| rows.iter().map(|row| row[i]).sum::<f64>();
        let per = sorted(rows.iter().map(|row| row[0] / row[1]));
        let speed = sorted(rows.iter().map(|row| row[2]));
        let part =
            |of: &[f64], part: f64| of.get((part * of.len() as f64) as usize).copied().unwrap_or(f64::NAN);
        // writing to a string cannot fail
        let _ = writeln!(
            report,
            "{name:<24}{:>6}{:>14.2}{:>13.2}{:>13.2}{:>15.3} m/s",
            rows.len(),
            sum(0) / sum(1),
            part(&per, 0.5),
            part(&per, 0.95),
            part(&speed, 0.5),
        );
    }
    Ok(report)
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}
