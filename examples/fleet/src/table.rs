//! The table. Its digits are fewer than the arithmetic's, so that every machine writes the same.

use core::fmt::Write;
use std::collections::HashSet;

use crate::geodesy::Local;
use crate::recording::{Heard, KNOT, Position};

/// A report in the flat frame.
pub struct Report {
    /// Which vessel.
    pub vessel: u32,
    /// s.
    pub time: u32,
    /// East and north, m.
    pub place: [f64; 2],
    /// The velocity that follows from speed and course, east and north, m/s.
    pub velocity: Option<[f64; 2]>,
    /// Speed over the ground, m/s.
    pub speed: f64,
    /// Whether the vessel moves at any time in the hour.
    pub moves: bool,
}

/// A vessel that is never faster, m/s, is moored: reports at the quay say up to half of it.
pub const STILL: f64 = 0.99 * KNOT;

/// The reports of all vessels, in order of time.
pub fn reports(heard: &[Heard], origin: &Position) -> Vec<Report> {
    let local = Local::at(origin);
    let moving = heard.iter().filter(|heard| heard.speed > STILL);
    let moving: HashSet<u32> = moving.map(|heard| heard.vessel).collect();
    let report = |heard: &Heard| {
        let [east, north, _] = local.of(&heard.position);
        // without speed a course is not needed
        let course = heard.course.or((heard.speed == 0.0).then_some(0.0));
        let velocity = course.map(|course| {
            let (sin, cos) = course.to_radians().sin_cos();
            [heard.speed * sin, heard.speed * cos]
        });
        let (vessel, time, speed) = (heard.vessel, heard.time, heard.speed);
        Report { vessel, time, place: [east, north], velocity, speed, moves: moving.contains(&vessel) }
    };
    let mut reports: Vec<Report> = heard.iter().map(report).collect();
    reports.sort_by_key(|report| (report.time, report.vessel));
    reports
}

/// All reports in s, m and m/s; an unknown velocity is two empty cells.
pub fn text(reports: &[Report]) -> String {
    let mut table = "time,track_id,east_fix,north_fix,vel_east_fix,vel_north_fix,u_moves\n".to_owned();
    for Report { vessel, time, place: [east, north], velocity, moves, .. } in reports {
        let velocity = velocity.map_or(",".to_owned(), |[east, north]| {
            // no −0.00
            let of = |v: f64| if v.abs() < 0.005 { 0.0 } else { v };
            format!("{:.2},{:.2}", of(east), of(north))
        });
        // writing to a string cannot fail
        let _ = writeln!(table, "{time},{vessel},{east:.1},{north:.1},{velocity},{}", u8::from(*moves));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::{reports, text};
    use crate::recording::{Heard, Position};

    #[test]
    fn vessels_are_mixed_in_order_of_time_and_those_that_move_are_told() {
        let heard = |vessel: u32, time: u32, speed: f64, course: Option<f64>| Heard {
            vessel,
            time,
            position: crate::ORIGIN,
            speed,
            course,
        };
        let all = [
            heard(1, 5, 0.0, None),
            heard(1, 70, 0.3, None),
            heard(2, 5, 0.2, Some(90.0)),
            heard(2, 60, 4.0, Some(180.0)),
        ];
        let origin = Position { latitude: 40.65, longitude: -74.04, height: 0.0 };
        let found = text(&reports(&all, &origin));
        let rows: Vec<&str> = found.lines().skip(1).collect();
        let expected = [
            "5,1,0.0,0.0,0.00,0.00,0",
            "5,2,0.0,0.0,0.20,0.00,1",
            "60,2,0.0,0.0,0.00,-4.00,1",
            "70,1,0.0,0.0,,,0",
        ];
        assert_eq!(rows, expected);
    }
}
