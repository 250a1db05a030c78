//! What a radar at the origin detects of a flight.

use givens::simulate::Stream;

/// Standard deviation of the range, m.
const RANGE_STD: f64 = 100.0;
/// Standard deviation of azimuth and elevation, rad.
const ANGLE_STD: f64 = 0.3_f64.to_radians();
/// Shortest and longest time between scans, s.
const INTERVAL: (f64, f64) = (4.0, 12.0);
/// Fraction of scans without a detection.
const LOST: f64 = 0.08;
/// Fraction of detections without an elevation.
const FLAT: f64 = 0.08;

/// One detection.
pub struct Detection {
    /// s.
    pub time: f64,
    /// Slant range, m.
    pub range: f64,
    /// Compass azimuth, clockwise from north, in (−π, π].
    pub azimuth: f64,
    /// Angle over the horizontal, where it was measured.
    pub elevation: Option<f64>,
}

/// Detections of a flight given by times and east-north-up positions. A scan takes the row nearest to its time, so
/// that no position is interpolated.
pub fn detections(flight: &[(f64, [f64; 3])], seed: u64) -> Vec<Detection> {
    // a stream for each kind of chance: changing one leaves the others as they are
    let [mut schedule, mut loss, mut noise] = [0, 1, 2].map(|run| Stream::new(seed, 0, run));
    let mut found = Vec::new();
    let Some(&(end, _)) = flight.last() else { return found };
    let mut scan = 0.0;
    while scan <= end {
        let nearest = flight.iter().min_by(|a, b| (a.0 - scan).abs().total_cmp(&(b.0 - scan).abs()));
        let (lost, flat) = (uniform(&mut loss) < LOST, uniform(&mut loss) < FLAT);
        let errors = [noise.normal(), noise.normal(), noise.normal()];
        if let (Some((time, position)), false) = (nearest, lost) {
            found.push(detect(*time, position, errors, flat));
        }
        scan += INTERVAL.0 + (INTERVAL.1 - INTERVAL.0) * uniform(&mut schedule);
    }
    found
}

fn detect(time: f64, &[east, north, up]: &[f64; 3], errors: [f64; 3], flat: bool) -> Detection {
    let ground = east.hypot(north);
    Detection {
        time,
        range: ground.hypot(up) + RANGE_STD * errors[0],
        azimuth: wrap(east.atan2(north) + ANGLE_STD * errors[1]),
        elevation: (!flat).then(|| up.atan2(ground) + ANGLE_STD * errors[2]),
    }
}

/// A number between 0 and 1: half the squared length of a normal pair is exponential.
fn uniform(stream: &mut Stream) -> f64 {
    let (a, b) = (stream.normal(), stream.normal());
    (-0.5 * (a * a + b * b)).exp()
}

fn wrap(angle: f64) -> f64 {
    angle - core::f64::consts::TAU * (angle / core::f64::consts::TAU).round()
}

#[cfg(test)]
mod tests {
    use super::{ANGLE_STD, FLAT, LOST, RANGE_STD, detections};

    /// A target at rest, due south of the radar.
    fn still(rows: usize) -> Vec<(f64, [f64; 3])> {
        (0..rows).map(|k| (k as f64, [0.0, -30_000.0, 5_000.0])).collect()
    }

    #[test]
    fn detections_stand_at_recorded_times_in_order() {
        let found = detections(&still(600), 1);
        assert!(found.windows(2).all(|pair| pair[0].time < pair[1].time));
        assert!(found.iter().all(|detection| detection.time.fract() == 0.0 && detection.time < 600.0));
    }

    #[test]
    fn losses_and_errors_are_as_frequent_and_as_large_as_they_say() {
        let rows = 16_000;
        let found = detections(&still(rows), 1);
        let (scans, count) = (rows as f64 / 8.0, found.len() as f64);
        assert!((count / scans - (1.0 - LOST)).abs() < 0.03, "{count} of about {scans} scans");
        let angles: Vec<f64> = found.iter().filter_map(|detection| detection.elevation).collect();
        assert!((1.0 - angles.len() as f64 / count - FLAT).abs() < 0.02);
        let rms = |sum: f64, count: f64| (sum / count).sqrt();
        let range = 30_000.0_f64.hypot(5_000.0);
        let ranges = rms(found.iter().map(|detection| (detection.range - range).powi(2)).sum(), count);
        assert!((ranges / RANGE_STD - 1.0).abs() < 0.06, "{ranges}");
        let elevation = 5_000.0_f64.atan2(30_000.0);
        let elevations =
            rms(angles.iter().map(|angle| (angle - elevation).powi(2)).sum(), angles.len() as f64);
        assert!((elevations / ANGLE_STD - 1.0).abs() < 0.06, "{elevations}");
    }

    #[test]
    fn azimuths_due_south_fall_on_both_sides_of_the_jump() {
        let found = detections(&still(600), 1);
        let (east, west): (Vec<f64>, Vec<f64>) =
            found.iter().map(|detection| detection.azimuth).partition(|azimuth| *azimuth > 0.0);
        assert!(!east.is_empty() && !west.is_empty());
        assert!(east.iter().chain(&west).all(|azimuth| (azimuth.abs() - core::f64::consts::PI).abs() < 0.03));
    }
}
