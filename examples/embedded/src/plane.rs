//! A target that turns in the plane, seen by a radar at the origin.

use givens_core::model::{At, Noise, Observation, Transition};
use givens_core::scalar::Real;

/// State x, vx, y, vy, ω: m, m/s, m, m/s, rad/s. The velocity turns by ω dt.
#[derive(Clone, Copy, Debug)]
pub struct Turn;

impl Transition for Turn {
    fn states(&self) -> usize {
        5
    }

    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let half = T::of(0.5) * x[4] * at.dt;
        let (sine, cosine) = half.sin_cos();
        // sin θ and 1 − cos θ by the half angle, since 1 − cos θ has few digits in single precision
        let (s, turned) = (T::of(2.0) * sine * cosine, T::of(2.0) * sine * sine);
        let straight = half.abs().lt(T::of(1e-9));
        let rate = T::select(straight, T::one(), x[4]);
        let along = T::select(straight, at.dt, s / rate);
        let across = T::select(straight, T::zero(), turned / rate);
        out[0] = x[0] + along * x[1] - across * x[3];
        out[1] = x[1] - turned * x[1] - s * x[3];
        out[2] = x[2] + across * x[1] + along * x[3];
        out[3] = x[3] + s * x[1] - turned * x[3];
        out[4] = x[4];
    }

    fn noise(&self) -> Noise {
        Noise::Covariance
    }

    fn process_noise<T: Real>(&self, at: &At<T>, q: &mut [T]) {
        q.fill(T::zero());
        // white acceleration, 0.1 m²/s³, and a rate that drifts, 1e-7 rad²/s³
        let (dt, acceleration) = (at.dt, T::of(0.1));
        for i in [0, 2] {
            q[6 * i] = acceleration * dt * dt * dt / T::of(3.0);
            q[6 * i + 1] = acceleration * dt * dt / T::of(2.0);
            q[6 * i + 5] = q[6 * i + 1];
            q[6 * i + 6] = acceleration * dt;
        }
        q[24] = T::of(1e-7) * dt;
    }
}

/// Range (m) and bearing (rad).
#[derive(Clone, Copy, Debug)]
pub struct Radar;

impl Observation for Radar {
    fn states(&self) -> usize {
        5
    }

    fn measures(&self) -> usize {
        2
    }

    fn angle(&self, i: usize) -> Option<f64> {
        (i == 1).then_some(core::f64::consts::TAU)
    }

    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        z[0] = (x[0] * x[0] + x[2] * x[2]).sqrt();
        z[1] = x[2].atan2(x[0]);
    }

    fn noise(&self) -> Noise {
        Noise::Root(2)
    }

    fn measurement_noise<T: Real>(&self, _: &At<T>, root: &mut [T]) {
        root.copy_from_slice(&[10.0, 0.0, 0.0, 3.162_277_660_168_379e-3].map(T::of));
    }
}
