//! A target that turns at a nearly constant rate in the plane.

use crate::model::{At, Noise, Transition};
use crate::scalar::Real;

/// The discrete coordinated turn with unknown turn rate (2009 §VIII-B; Bar-Shalom, Li & Kirubarajan 2001, §11.7).
///
/// State: x, vx, y, vy, ω (m, m/s, m, m/s, rad/s). Over a step T the velocity turns by ω T; white acceleration of
/// intensity `q1` and a random walk of the rate of intensity `q2` are added.
#[derive(Clone, Copy, Debug)]
pub struct CoordinatedTurn {
    /// Intensity of the acceleration noise, m²/s³.
    pub q1: f64,
    /// Intensity of the turn-rate noise, rad²/s³.
    pub q2: f64,
}

impl Default for CoordinatedTurn {
    /// The intensities of 2009 §VIII-B.
    fn default() -> Self {
        Self { q1: 0.1, q2: 1.75e-4 }
    }
}

impl Transition for CoordinatedTurn {
    fn states(&self) -> usize {
        5
    }

    #[inline(always)]
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let (angle, half) = (x[4] * at.dt, T::of(0.5) * x[4] * at.dt);
        let (s, c) = angle.sin_cos();
        // sin(θ)/ω and (1 − cos θ)/ω = 2 sin²(θ/2)/ω, with their limits as ω → 0
        let straight = half.abs().lt(T::of(1e-9));
        let w = T::select(straight, T::one(), x[4]);
        let sh = half.sin();
        let along = T::select(straight, at.dt, s / w);
        let across = T::select(straight, half * at.dt, T::of(2.0) * sh * sh / w);
        out[0] = x[0] + along * x[1] - across * x[3];
        out[1] = c * x[1] - s * x[3];
        out[2] = x[2] + across * x[1] + along * x[3];
        out[3] = s * x[1] + c * x[3];
        out[4] = x[4];
    }

    fn noise(&self) -> Noise {
        Noise::Covariance
    }

    #[inline(always)]
    fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        out.fill(T::zero());
        let (q1, dt) = (T::of(self.q1), at.dt);
        for axis in [0, 2] {
            out[axis * 5 + axis] = q1 * dt * dt * dt / T::of(3.0);
            out[axis * 5 + axis + 1] = q1 * dt * dt / T::of(2.0);
            out[(axis + 1) * 5 + axis] = q1 * dt * dt / T::of(2.0);
            out[(axis + 1) * 5 + axis + 1] = q1 * dt;
        }
        out[24] = T::of(self.q2) * dt;
    }
}
