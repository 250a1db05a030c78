//! From latitude, longitude and height to a flat frame about a point, without approximation.

use crate::recording::Position;

/// Semi-major axis of the WGS 84 ellipsoid, m.
const AXIS: f64 = 6_378_137.0;
/// Its flattening.
const FLATTENING: f64 = 1.0 / 298.257_223_563;

/// Earth-centred, earth-fixed coordinates of a position, m.
fn earth_centred(position: &Position) -> [f64; 3] {
    let (sin_lat, cos_lat) = position.latitude.to_radians().sin_cos();
    let (sin_lon, cos_lon) = position.longitude.to_radians().sin_cos();
    let squared_eccentricity = FLATTENING * (2.0 - FLATTENING);
    // the radius of curvature across the meridian
    let normal = AXIS / (1.0 - squared_eccentricity * sin_lat * sin_lat).sqrt();
    let outward = (normal + position.height) * cos_lat;
    let along_axis = (normal * (1.0 - squared_eccentricity) + position.height) * sin_lat;
    [outward * cos_lon, outward * sin_lon, along_axis]
}

/// The east-north-up frame of a point: its third axis is normal to the ellipsoid there.
pub struct Local {
    origin: [f64; 3],
    axes: [[f64; 3]; 3],
}

impl Local {
    /// The frame about `position`.
    pub fn at(position: &Position) -> Self {
        let (sin_lat, cos_lat) = position.latitude.to_radians().sin_cos();
        let (sin_lon, cos_lon) = position.longitude.to_radians().sin_cos();
        let axes = [
            [-sin_lon, cos_lon, 0.0],
            [-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat],
            [cos_lat * cos_lon, cos_lat * sin_lon, sin_lat],
        ];
        Self { origin: earth_centred(position), axes }
    }

    /// East, north and up of a position, m.
    pub fn of(&self, position: &Position) -> [f64; 3] {
        let point = earth_centred(position);
        self.axes.map(|axis| (0..3).map(|i| axis[i] * (point[i] - self.origin[i])).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::{Local, Position, earth_centred};

    const fn position(latitude: f64, longitude: f64, height: f64) -> Position {
        Position { latitude, longitude, height }
    }

    fn close(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
        for (f, e) in found.iter().zip(expected) {
            assert!((f - e).abs() < tolerance, "{found:?} is not {expected:?}");
        }
    }

    #[test]
    fn the_ellipsoid_has_its_axes() {
        close(earth_centred(&position(0.0, 0.0, 10.0)), [6_378_147.0, 0.0, 0.0], 1e-8);
        close(earth_centred(&position(0.0, 90.0, 0.0)), [0.0, 6_378_137.0, 0.0], 1e-8);
        close(earth_centred(&position(-90.0, 0.0, 0.0)), [0.0, 0.0, -6_356_752.314_245], 1e-6);
    }

    #[test]
    fn a_point_overhead_is_up_and_a_distant_one_below_the_horizon() {
        let here = position(48.05, -2.97, 120.0);
        let local = Local::at(&here);
        close(local.of(&here), [0.0; 3], 1e-12);
        close(local.of(&position(48.05, -2.97, 6120.0)), [0.0, 0.0, 6000.0], 1e-8);
        let [east, north, up] = local.of(&position(48.5, -2.97, 120.0));
        // an arc of 0.45° falls away by its length squared over the diameter of the earth
        let drop = north * north / 12_756_000.0;
        assert!(east.abs() < 1e-8 && (up + drop).abs() < 0.01 * drop, "east {east}, up {up}");
        assert!((north - 50_040.0).abs() < 30.0, "north {north}");
    }
}
