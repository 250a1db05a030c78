//! The recorded flight: `time_s,latitude_deg,longitude_deg,altitude_m`.

/// A position over the WGS 84 ellipsoid.
pub struct Position {
    /// Degrees north.
    pub latitude: f64,
    /// Degrees east.
    pub longitude: f64,
    /// Height, m. The recording's is barometric and stands for the height over the ellipsoid.
    pub height: f64,
}

/// A recorded position.
pub struct Recorded {
    /// Seconds from the first row.
    pub time: f64,
    /// Where the aircraft was.
    pub position: Position,
}

/// Reads the recording.
pub fn read(text: &str) -> Result<Vec<Recorded>, String> {
    const HEADER: &str = "time_s,latitude_deg,longitude_deg,altitude_m";
    let mut lines = text.lines().enumerate();
    if lines.next().is_none_or(|(_, header)| header != HEADER) {
        return Err(format!("line 1: the columns must be {HEADER}"));
    }
    let mut rows = Vec::new();
    let mut first = None;
    for (index, line) in lines {
        let cells: Result<Vec<f64>, _> = line.split(',').map(str::parse).collect();
        let cells = cells.map_err(|error| format!("line {}: {error}", index + 1))?;
        let &[time, latitude, longitude, height] = cells.as_slice() else {
            return Err(format!("line {}: expected 4 numbers, found {}", index + 1, cells.len()));
        };
        let time = time - *first.get_or_insert(time);
        rows.push(Recorded { time, position: Position { latitude, longitude, height } });
    }
    Ok(rows)
}
