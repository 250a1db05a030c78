//! Scenes for the tests: a simulated turn, tracked by a constant-velocity Kalman filter for each axis.

use super::track::{NisSeries, PlaneTrack, StateSeries, Track, TrackFigure};

/// Numbers that look random and are the same everywhere: standard normal, roughly.
pub(super) struct Noise(pub u64);

impl Noise {
    pub fn next(&mut self) -> f64 {
        let uniform = |state: &mut u64| {
            *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (*state >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..12).map(|_| uniform(&mut self.0)).sum::<f64>() - 6.0
    }
}

/// One axis: position and velocity, its covariance, from positions measured with deviation `r`.
struct AxisFilter {
    x: [f64; 2],
    p: [f64; 3],
}

impl AxisFilter {
    /// One step; returns the normalised innovation squared.
    fn step(&mut self, z: f64, dt: f64, q: f64, r: f64) -> f64 {
        let [a, b, c] = self.p;
        self.x[0] += dt * self.x[1];
        let a = a + 2.0 * dt * b + dt * dt * c + q * dt.powi(3) / 3.0;
        let (b, c) = (b + dt * c + q * dt * dt / 2.0, c + q * dt);
        let (nu, s) = (z - self.x[0], a + r * r);
        self.x = [self.x[0] + a / s * nu, self.x[1] + b / s * nu];
        self.p = [a - a * a / s, b - a * b / s, c - b * b / s];
        nu * nu / s
    }
}

/// A turn of `rows` rows, tracked.
pub(super) fn turn(name: &str, rows: usize, seed: u64) -> Track {
    let (dt, r, rate) = (1.0, 40.0, 0.035);
    let mut noise = Noise(seed);
    // Each name starts in a direction of its own.
    let (sin, cos) = (name.len() as f64 * 0.3 + seed as f64).sin_cos();
    let mut truth = [1000.0, 60.0 * cos, 1000.0, 60.0 * sin];
    let mut filters = [
        AxisFilter { x: [1150.0, 20.0], p: [200.0 * 200.0, 0.0, 100.0 * 100.0] },
        AxisFilter { x: [900.0, 20.0], p: [200.0 * 200.0, 0.0, 100.0 * 100.0] },
    ];
    let mut states: Vec<StateSeries> = ["x", "vx", "y", "vy", "w"]
        .iter()
        .map(|n| StateSeries { name: (*n).to_owned(), truth: Some(vec![]), ..StateSeries::default() })
        .collect();
    let mut plane = PlaneTrack { truth: Some(vec![]), ..PlaneTrack::default() };
    let mut nis = NisSeries::default();
    for k in 1..=rows {
        let time = k as f64 * dt;
        let omega = if (k / 60) % 2 == 0 { rate } else { -0.5 * rate };
        let (vx, vy) = (truth[1], truth[3]);
        truth = [
            truth[0] + dt * vx,
            vx * (omega * dt).cos() - vy * (omega * dt).sin(),
            truth[2] + dt * vy,
            vx * (omega * dt).sin() + vy * (omega * dt).cos(),
        ];
        let z = [truth[0] + r * noise.next(), truth[2] + r * noise.next()];
        let total = filters[0].step(z[0], dt, 25.0, r) + filters[1].step(z[1], dt, 25.0, r);
        let [fx, fy] = &filters;
        let omega_std = 0.03 / (1.0 + 0.05 * k as f64) + 0.006;
        let rows = [
            (fx.x[0], fx.p[0].sqrt(), truth[0]),
            (fx.x[1], fx.p[2].sqrt(), truth[1]),
            (fy.x[0], fy.p[0].sqrt(), truth[2]),
            (fy.x[1], fy.p[2].sqrt(), truth[3]),
            (omega + omega_std * noise.next(), omega_std, omega),
        ];
        for (state, (mean, std, truth)) in states.iter_mut().zip(rows) {
            state.time.push(time);
            state.mean.push(mean);
            state.std.push(std);
            state.truth.as_mut().unwrap().push(truth);
        }
        plane.estimate.push([fx.x[0], fy.x[0]]);
        plane.covariance.push([fx.p[0], 0.4 * (fx.p[0] * fy.p[0]).sqrt(), fy.p[0]]);
        plane.measurements.push(z);
        plane.truth.as_mut().unwrap().push([truth[0], truth[2]]);
        nis.time.push(time);
        nis.nis.push(total);
        nis.lower.push(0.050_635_6);
        nis.upper.push(7.377_759);
    }
    Track { name: name.to_owned(), plane: Some(plane), states, nis: Some(nis) }
}

/// A figure of some tracks.
pub(super) fn figure(tracks: Vec<Track>) -> TrackFigure {
    TrackFigure {
        title: "Coordinated turn, tracked by sr-cd-ckf".into(),
        notes: vec!["180 rows of radar.csv; log-likelihood −1843.2; 8 substeps".into()],
        plane_labels: ["x (m)".into(), "y (m)".into()],
        tracks,
        ..TrackFigure::default()
    }
}
