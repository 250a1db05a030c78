//! The recorded reports: `track_id,time_s,lat_deg,lon_deg,sog_kt,cog_deg`.

/// A position over the WGS 84 ellipsoid.
pub struct Position {
    /// Degrees north.
    pub latitude: f64,
    /// Degrees east.
    pub longitude: f64,
    /// Height, m.
    pub height: f64,
}

/// What a vessel reported.
pub struct Heard {
    /// Which vessel.
    pub vessel: u32,
    /// Seconds from the beginning of the hour.
    pub time: u32,
    /// Where it said it was.
    pub position: Position,
    /// Speed over the ground, m/s.
    pub speed: f64,
    /// Its direction, degrees clockwise from north; none if the vessel did not know.
    pub course: Option<f64>,
}

/// One knot, m/s.
pub const KNOT: f64 = 1852.0 / 3600.0;

/// What the recording takes off courses above 204.7°: they are kept in tenths, in too few bits.
const LAP: f64 = 409.6;

/// The course that says there is none.
const UNKNOWN: f64 = 360.0;

/// Reads the recording. A report that repeats the one before it is left out.
pub fn read(text: &str) -> Result<Vec<Heard>, String> {
    const HEADER: &str = "track_id,time_s,lat_deg,lon_deg,sog_kt,cog_deg";
    let mut lines = text.lines().enumerate();
    if lines.next().is_none_or(|(_, header)| header != HEADER) {
        return Err(format!("line 1: the columns must be {HEADER}"));
    }
    let (mut all, mut before) = (Vec::new(), "");
    for (index, line) in lines {
        if line == before {
            continue;
        }
        before = line;
        all.push(report(line).ok_or_else(|| format!("line {}: expected 6 numbers", index + 1))?);
    }
    Ok(all)
}

fn report(line: &str) -> Option<Heard> {
    let cells: Vec<&str> = line.split(',').collect();
    let [vessel, time, rest @ ..] = cells.as_slice() else { return None };
    let rest: Option<Vec<f64>> = rest.iter().map(|cell| cell.parse().ok()).collect();
    let [latitude, longitude, knots, course] = rest?.try_into().ok()?;
    let course = if course < 0.0 { course + LAP } else { course };
    Some(Heard {
        vessel: vessel.parse().ok()?,
        time: time.parse().ok()?,
        position: Position { latitude, longitude, height: 0.0 },
        speed: knots * KNOT,
        // in tenths: the sum above is not exact
        course: (course < UNKNOWN - 0.05).then_some(course),
    })
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn courses_come_round_and_some_are_unknown() {
        let rows =
            "7,10,40.7,-74,1,-204.8\n7,80,40.7,-74,1,-49.6\n7,80,40.7,-74,1,-49.6\n7,90,40.7,-74,1,90\n";
        let found = read(&format!("track_id,time_s,lat_deg,lon_deg,sog_kt,cog_deg\n{rows}")).unwrap();
        let courses: Vec<Option<f64>> =
            found.iter().map(|heard| heard.course.map(|course| (10.0 * course).round() / 10.0)).collect();
        assert_eq!(courses, [Some(204.8), None, Some(90.0)]);
        assert!(read("a,b\n").is_err());
    }
}
