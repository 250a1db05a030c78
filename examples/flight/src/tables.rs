//! The two tables. Their digits are fewer than the arithmetic's, so that every machine writes the same.

use core::fmt::Write;

use crate::radar::Detection;

/// `time,range,azimuth,elevation` in s, m and rad; an empty cell where there was no elevation.
pub fn detections(detections: &[Detection]) -> String {
    let mut table = "time,range,azimuth,elevation\n".to_owned();
    for &Detection { time, range, azimuth, elevation } in detections {
        let elevation = elevation.map_or(String::new(), |angle| format!("{angle:.5}"));
        // writing to a string cannot fail
        let _ = writeln!(table, "{time},{range:.1},{azimuth:.5},{elevation}");
    }
    table
}

/// `time,east,north,up` in s and m.
pub fn truth(flight: &[(f64, [f64; 3])]) -> String {
    let mut table = "time,east,north,up\n".to_owned();
    for (time, [east, north, up]) in flight {
        let _ = writeln!(table, "{time},{east:.1},{north:.1},{up:.1}");
    }
    table
}
