//! Two-point differencing: the initial belief from the first two measurements (docs/algorithms.md B2).

use super::runs::Start;
use crate::Trouble;
use crate::radar::Scene;
use givens::filter::Gaussian;
use givens::model::Observation;
use givens::simulate::Stream;

/// Position from range, azimuth and elevation, and the covariance of its noise, 3 × 3.
fn placed(scene: &Scene, z: &[f64; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    let [range, azimuth, elevation] = *z;
    let ((sin_a, cos_a), (sin_e, cos_e)) = (azimuth.sin_cos(), elevation.sin_cos());
    let at = scene.radar.at;
    let position = [at[0] + range * cos_e * cos_a, at[1] + range * cos_e * sin_a, at[2] + range * sin_e];
    let jacobian = [
        [cos_e * cos_a, -range * cos_e * sin_a, -range * sin_e * cos_a],
        [cos_e * sin_a, range * cos_e * cos_a, -range * sin_e * sin_a],
        [sin_e, 0.0, range * cos_e],
    ];
    let mut root = [0.0; 9];
    let at = givens::model::At { t: 0.0, dt: 0.0, u: &[], p: &[] };
    scene.radar.measurement_noise(&at, &mut root);
    let of = |i: usize, j: usize| {
        (0..3).map(|k| jacobian[i][k] * jacobian[j][k] * root[4 * k] * root[4 * k]).sum::<f64>()
    };
    (position, core::array::from_fn(|i| core::array::from_fn(|j| of(i, j))))
}

/// The belief at the second of two measurements; the turn rate, of which they say nothing, is drawn about the truth or
/// taken as nought.
pub(super) fn two_points(
    scene: &Scene,
    z: [&[f64; 3]; 2],
    start: Start,
    stream: &mut Stream,
) -> Result<Gaussian, Trouble> {
    let ((c0, r0), (c1, r1)) = (placed(scene, z[0]), placed(scene, z[1]));
    let interval = scene.interval;
    let (mut mean, mut cov) = ([0.0; 7], [0.0; 49]);
    for i in 0..3 {
        mean[2 * i] = c1[i];
        mean[2 * i + 1] = (c1[i] - c0[i]) / interval;
        for j in 0..3 {
            let mut put =
                |row: usize, column: usize, value: f64| cov[(2 * i + row) * 7 + 2 * j + column] = value;
            put(0, 0, r1[i][j]);
            put(0, 1, r1[i][j] / interval);
            put(1, 0, r1[i][j] / interval);
            put(1, 1, (r0[i][j] + r1[i][j]) / (interval * interval));
        }
    }
    let (rate, std) = match start {
        Start::Drawn => (scene.omega + stream.normal(), 1.0f64),
        Start::Nought => (0.0, 6.0),
    };
    mean[6] = rate.to_radians();
    cov[48] = std.to_radians().powi(2);
    Ok(Gaussian::from_cov(&mean, &cov)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arasaratnam2010continuous::runs::scene;

    #[test]
    fn two_exact_points_give_position_and_mean_velocity() {
        let scene = scene(7e-4, 3.0, 2.0);
        let see = |x: [f64; 3]| {
            let ground = x[0].hypot(x[1]);
            [ground.hypot(x[2]), x[1].atan2(x[0]), x[2].atan2(ground)]
        };
        let (a, b) = (see([1000.0, 2650.0, 200.0]), see([900.0, 2900.0, 220.0]));
        let belief = two_points(&scene, [&a, &b], Start::Nought, &mut Stream::new(1, 0, 0)).unwrap();
        let wanted = [900.0, -50.0, 2900.0, 125.0, 220.0, 10.0, 0.0];
        for (x, wanted) in belief.mean().iter().zip(wanted) {
            assert!((x - wanted).abs() < 1e-9, "{:?}", belief.mean());
        }
        // along the line of sight the position is as uncertain as the range
        let n = [900.0, 2900.0, 220.0].map(|x: f64| x / see([900.0, 2900.0, 220.0])[0]);
        let along: f64 = (0..9).map(|k| n[k / 3] * belief.cov()[k / 3 * 14 + k % 3 * 2] * n[k % 3]).sum();
        assert!((along - 2500.0).abs() < 1e-6, "{along}");
    }
}
