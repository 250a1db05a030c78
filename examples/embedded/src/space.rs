//! A target that turns in space, in continuous time, seen by a radar at the origin.

use givens_core::model::{At, Noise, Observation, Sde, Varies};
use givens_core::scalar::Real;

/// State e, ve, n, vn, z, vz, ω: m and m/s by axis, rad/s. The horizontal velocity turns at the rate ω.
#[derive(Clone, Copy, Debug)]
pub struct Turn;

impl Sde for Turn {
    fn states(&self) -> usize {
        7
    }

    fn noises(&self) -> usize {
        4
    }

    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        dx[0] = x[1];
        dx[1] = -(x[6] * x[3]);
        dx[2] = x[3];
        dx[3] = x[6] * x[1];
        dx[4] = x[5];
        dx[5] = T::zero();
        dx[6] = T::zero();
    }

    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g.fill(T::zero());
        // √0.2 m/s per √s of each velocity, 7e-4 rad/s per √s of the rate
        let noises = [0.447_213_595_499_957_9, 0.447_213_595_499_957_9, 0.447_213_595_499_957_9, 7e-4];
        for (noise, (state, value)) in [1, 3, 5, 6].into_iter().zip(noises).enumerate() {
            g[state * 4 + noise] = T::of(value);
        }
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

/// Range (m), azimuth and elevation (rad).
#[derive(Clone, Copy, Debug)]
pub struct Radar;

impl Observation for Radar {
    fn states(&self) -> usize {
        7
    }

    fn measures(&self) -> usize {
        3
    }

    fn angle(&self, i: usize) -> Option<f64> {
        (i == 1).then_some(core::f64::consts::TAU)
    }

    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        let ground = (x[0] * x[0] + x[2] * x[2]).sqrt();
        z[0] = (ground * ground + x[4] * x[4]).sqrt();
        z[1] = x[2].atan2(x[0]);
        z[2] = x[4].atan2(ground);
    }

    fn noise(&self) -> Noise {
        Noise::Root(3)
    }

    fn measurement_noise<T: Real>(&self, _: &At<T>, root: &mut [T]) {
        root.fill(T::zero());
        // 50 m, a tenth of a degree
        for (i, std) in [50.0, 0.1_f64.to_radians(), 0.1_f64.to_radians()].into_iter().enumerate() {
            root[4 * i] = T::of(std);
        }
    }
}
