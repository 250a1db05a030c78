//! The recorded flight: `time_s,latitude_deg,longitude_deg,altitude_m,groundspeed_mps,track_deg`.

/// A position over the WGS 84 ellipsoid.
pub struct Position {
    /// Degrees north.
    pub latitude: f64,
    /// Degrees east.
    pub longitude: f64,
    /// Height, m. The recording's is barometric and stands for the height over the ellipsoid.
    pub height: f64,
}

/// A row of the recording.
pub struct Recorded {
    /// Seconds from the first row.
    pub time: f64,
    /// Where the aircraft said it was.
    pub position: Position,
    /// Speed over the ground, m/s.
    pub speed: f64,
    /// Its direction, degrees clockwise from north.
    pub track: f64,
}

/// A row in the flat frame.
#[derive(Clone, Copy)]
pub struct Fix {
    /// s.
    pub time: f64,
    /// East, north and up, m.
    pub place: [f64; 3],
    /// The recorded velocity, east and north, m/s.
    pub velocity: [f64; 2],
}

impl Recorded {
    /// The row with its position in the flat frame.
    pub fn fix(&self, place: [f64; 3]) -> Fix {
        let (sin, cos) = self.track.to_radians().sin_cos();
        Fix { time: self.time, place, velocity: [self.speed * sin, self.speed * cos] }
    }
}

/// Reads the recording, from the first row on that has a speed.
pub fn read(text: &str) -> Result<Vec<Recorded>, String> {
    const HEADER: &str = "time_s,latitude_deg,longitude_deg,altitude_m,groundspeed_mps,track_deg";
    let mut lines = text.lines().enumerate();
    if lines.next().is_none_or(|(_, header)| header != HEADER) {
        return Err(format!("line 1: the columns must be {HEADER}"));
    }
    let mut rows = Vec::new();
    for (index, line) in lines {
        let cells: Result<Vec<f64>, _> = line.split(',').map(str::parse).collect();
        let cells = cells.map_err(|error| format!("line {}: {error}", index + 1))?;
        let &[time, latitude, longitude, height, speed, track] = cells.as_slice() else {
            return Err(format!("line {}: expected 6 numbers, found {}", index + 1, cells.len()));
        };
        if speed > 0.0 || !rows.is_empty() {
            rows.push(Recorded { time, position: Position { latitude, longitude, height }, speed, track });
        }
    }
    Ok(rows)
}
