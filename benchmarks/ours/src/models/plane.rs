//! W1, W2, W4: a turn in the plane, seen by a radar.

use givens_core::model::{At, Noise, Observation, Transition};
use givens_core::scalar::Real;

/// State x, vx, y, vy, turn rate.
pub struct PlaneTurn;

impl Transition for PlaneTurn {
    fn states(&self) -> usize {
        5
    }

    #[inline(always)]
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let w = x[4];
        let (s, c) = (w * at.dt).sin_cos();
        let (a, b) = (s / w, (T::one() - c) / w);
        out[0] = x[0] + a * x[1] - b * x[3];
        out[1] = c * x[1] - s * x[3];
        out[2] = x[2] + b * x[1] + a * x[3];
        out[3] = s * x[1] + c * x[3];
        out[4] = w;
    }

    fn noise(&self) -> Noise {
        Noise::Covariance
    }

    #[inline(always)]
    fn process_noise<T: Real>(&self, at: &At<T>, q: &mut [T]) {
        q.fill(T::zero());
        let (dt, intensity) = (at.dt, T::of(0.1));
        for i in [0, 2] {
            q[6 * i] = intensity * dt * dt * dt / T::of(3.0);
            q[6 * i + 1] = intensity * dt * dt / T::of(2.0);
            q[6 * i + 5] = q[6 * i + 1];
            q[6 * i + 6] = intensity * dt;
        }
        q[24] = T::of(1e-7) * dt;
    }
}

/// Range and bearing.
pub struct PlaneRadar;

impl Observation for PlaneRadar {
    fn states(&self) -> usize {
        5
    }

    fn measures(&self) -> usize {
        2
    }

    #[inline(always)]
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        z[0] = (x[0] * x[0] + x[2] * x[2]).sqrt();
        z[1] = x[2].atan2(x[0]);
    }

    fn noise(&self) -> Noise {
        Noise::Root(2)
    }

    #[inline(always)]
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&[T::of(10.0), T::zero(), T::zero(), T::of(1e-5).sqrt()]);
    }
}
