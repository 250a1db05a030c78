//! How far the fixes held out lie from the estimates at their times, along the track and across it.

use core::fmt::Write;
use std::collections::HashMap;

use crate::recording::Fix;
use crate::tables::is_held_out;

/// A table of quantiles: of the estimates, and of the straight line between the neighbouring fixes.
pub fn report(fixes: &[Fix], every: usize, smoothed: &str) -> Result<String, String> {
    let estimates = estimates(smoothed)?;
    let (mut by_model, mut by_line) = (Vec::new(), Vec::new());
    for (k, fix) in fixes.iter().enumerate().filter(|(k, _)| is_held_out(*k, every)) {
        let Some(&[east, north, v_east, v_north]) = estimates.get(&fix.time.to_string()) else {
            return Err(format!("there is no row at t = {}", fix.time));
        };
        // neither the first nor, without a neighbour, the last
        let (Some(before), Some(after)) = (k.checked_sub(1).and_then(|k| fixes.get(k)), fixes.get(k + 1))
        else {
            continue;
        };
        let part = (fix.time - before.time) / (after.time - before.time);
        let line = [0, 1].map(|i| before.place[i] + part * (after.place[i] - before.place[i]));
        // both are parted along the same direction
        let split = |place: [f64; 2]| {
            let off = [fix.place[0] - place[0], fix.place[1] - place[1]];
            let speed = v_east.hypot(v_north);
            [(off[0] * v_east + off[1] * v_north) / speed, (off[0] * v_north - off[1] * v_east) / speed]
        };
        by_model.push(split([east, north]));
        by_line.push(split(line));
    }
    let mut report = format!(
        "{} fixes held out; |fix - estimate|, m     half   68 %   90 %   95 %    rms\n",
        by_model.len()
    );
    for (name, errors) in [("smoothed", &by_model), ("straight line", &by_line)] {
        for (axis, way) in ["along", "across"].into_iter().enumerate() {
            let off: Vec<f64> = errors.iter().map(|error| error[axis]).collect();
            // writing to a string cannot fail
            let _ = writeln!(report, "{:<38}{}", format!("  {name}, {way} the track"), quantiles(&off));
        }
    }
    Ok(report)
}

fn quantiles(errors: &[f64]) -> String {
    let mut sizes: Vec<f64> = errors.iter().map(|error| error.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let count = sizes.len() as f64;
    let mut cells: Vec<f64> = [0.5, 0.68, 0.9, 0.95]
        .iter()
        .filter_map(|part| sizes.get((part * count) as usize).copied())
        .collect();
    cells.push((sizes.iter().map(|size| size * size).sum::<f64>() / count).sqrt());
    cells.iter().fold(String::new(), |mut line, cell| {
        let _ = write!(line, "{cell:7.1}");
        line
    })
}

/// East, north and their rates by time, as the command writes them.
fn estimates(text: &str) -> Result<HashMap<String, [f64; 4]>, String> {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let mut columns = [0; 4];
    for (column, name) in columns.iter_mut().zip(["east", "north", "vel_east", "vel_north"]) {
        let place = header.iter().position(|cell| *cell == name);
        *column = place.ok_or_else(|| format!("line 1: there is no column `{name}`"))?;
    }
    let mut found = HashMap::new();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |column: usize| cells.get(column).and_then(|cell| cell.parse().ok());
        // rows before the start have no estimates
        if let [Some(east), Some(north), Some(v_east), Some(v_north)] = columns.map(number) {
            found.insert(cells[0].to_owned(), [east, north, v_east, v_north]);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::{Fix, report};

    #[test]
    fn off_the_track_and_along_it_are_told_apart() {
        let fix =
            |time: f64, east: f64, north: f64| Fix { time, place: [east, north, 0.0], velocity: [10.0, 0.0] };
        let flight = [fix(0.0, 0.0, 0.0), fix(10.0, 107.0, -2.0), fix(20.0, 200.0, 0.0)];
        let smoothed = "time,east,vel_east,north,vel_north\n0,,,,\n10,101,10,1,0\n";
        let said = report(&flight, 2, smoothed).unwrap();
        let row = |k: usize| said.lines().nth(k).unwrap().split_whitespace().last().unwrap().to_owned();
        assert_eq!([row(1), row(2), row(3), row(4)], ["6.0", "3.0", "7.0", "2.0"], "{said}");
        let missing = report(&flight, 2, "time,east,vel_east,north,vel_north\n0,1,1,1,1\n").unwrap_err();
        assert_eq!(missing, "there is no row at t = 10");
    }
}
