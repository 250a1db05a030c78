//! W3, P1, P2: a turn in space in continuous time, seen by a radar.

use givens_core::model::{At, Noise, Observation, Sde, Transition, Varies};
use givens_core::scalar::Real;

/// State e, ve, n, vn, z, vz, turn rate; accelerations and rate are driven by noise.
pub struct SpaceTurn;

/// Of the accelerations, m/s per √s; of the rate, rad/s per √s.
const NOISES: [f64; 4] = [0.447_213_595_499_957_9, 0.447_213_595_499_957_9, 0.447_213_595_499_957_9, 7e-4];

#[inline(always)]
fn drift<T: Real>(x: &[T], dx: &mut [T]) {
    dx[0] = x[1];
    dx[1] = -(x[6] * x[3]);
    dx[2] = x[3];
    dx[3] = x[6] * x[1];
    dx[4] = x[5];
    dx[5] = T::zero();
    dx[6] = T::zero();
}

impl Sde for SpaceTurn {
    fn states(&self) -> usize {
        7
    }

    fn noises(&self) -> usize {
        4
    }

    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        drift(x, dx);
    }

    #[inline(always)]
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g.fill(T::zero());
        for (noise, (state, value)) in [1, 3, 5, 6].into_iter().zip(NOISES).enumerate() {
            g[state * 4 + noise] = T::of(value);
        }
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

/// The same in discrete time: the drift alone, by 16 steps of the classic Runge–Kutta method, and the noise of the
/// linear part.
pub struct SpaceStep;

impl Transition for SpaceStep {
    fn states(&self) -> usize {
        7
    }

    #[inline(always)]
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let h = at.dt / T::of(16.0);
        let (half, sixth, two) = (T::of(0.5) * h, h / T::of(6.0), T::of(2.0));
        let [mut k1, mut k2, mut k3, mut k4, mut y] = [[T::zero(); 7]; 5];
        out.copy_from_slice(x);
        for _ in 0..16 {
            drift(out, &mut k1);
            ahead(&mut y, out, half, &k1);
            drift(&y, &mut k2);
            ahead(&mut y, out, half, &k2);
            drift(&y, &mut k3);
            ahead(&mut y, out, h, &k3);
            drift(&y, &mut k4);
            for i in 0..7 {
                out[i] = sixth.mul_add(k1[i] + two * (k2[i] + k3[i]) + k4[i], out[i]);
            }
        }
    }

    fn noise(&self) -> Noise {
        Noise::Covariance
    }

    #[inline(always)]
    fn process_noise<T: Real>(&self, at: &At<T>, q: &mut [T]) {
        q.fill(T::zero());
        let (dt, intensity) = (at.dt, T::of(0.2));
        for i in [0, 2, 4] {
            q[8 * i] = intensity * dt * dt * dt / T::of(3.0);
            q[8 * i + 1] = intensity * dt * dt / T::of(2.0);
            q[8 * i + 7] = q[8 * i + 1];
            q[8 * i + 8] = intensity * dt;
        }
        q[48] = T::of(4.9e-7) * dt;
    }
}

/// to = x + by k.
#[inline(always)]
fn ahead<T: Real>(to: &mut [T], x: &[T], by: T, k: &[T]) {
    for i in 0..7 {
        to[i] = by.mul_add(k[i], x[i]);
    }
}

/// Range, azimuth and elevation.
pub struct SpaceRadar;

impl Observation for SpaceRadar {
    fn states(&self) -> usize {
        7
    }

    fn measures(&self) -> usize {
        3
    }

    #[inline(always)]
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        let ground = (x[0] * x[0] + x[2] * x[2]).sqrt();
        z[0] = (ground * ground + x[4] * x[4]).sqrt();
        z[1] = x[2].atan2(x[0]);
        z[2] = x[4].atan2(ground);
    }

    fn noise(&self) -> Noise {
        Noise::Root(3)
    }

    #[inline(always)]
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.fill(T::zero());
        for (i, std) in [50.0, 0.1_f64.to_radians(), 0.1_f64.to_radians()].into_iter().enumerate() {
            out[4 * i] = T::of(std);
        }
    }
}
