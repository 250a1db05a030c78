//! An aircraft that turns at a nearly constant rate at a nearly constant height.

use crate::model::{At, Sde, Varies};
use crate::scalar::Real;

/// The coordinated turn of air-traffic control in continuous time (2010 §VI; 2012 §4; 2021 §4).
///
/// State: ε, ε̇, η, η̇, ζ, ζ̇, ω (m, m/s in turn, rad/s). The velocity in the plane turns at the rate ω; accelerations and the
/// rate are driven by white noise.
///
/// ```
/// use givens_core::filter::{Gaussian, Method, SrCdCkf};
/// use givens_core::model::zoo::{Radar3d, Turn3d};
///
/// let model = Turn3d::default();
/// let mean = [1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.1];
/// let prior = Gaussian::from_std(&mean, &[100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 0.02])?;
/// let mut f = SrCdCkf::default().start(&model, 0.0, prior)?;
/// f.predict(4.0)?;
/// f.update(&Radar3d::default(), &[3350.0, 1.32, 0.06])?;
/// assert!(f.cov()[0].sqrt() < 60.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn3d {
    /// σ₁: of the velocities, m/s per √s.
    pub velocity: f64,
    /// σ₂: of the turn rate, rad/s per √s.
    pub rate: f64,
}

impl Default for Turn3d {
    /// The values of 2010 §VI.
    fn default() -> Self {
        Self { velocity: 0.447_213_595_499_957_9, rate: 7e-3 }
    }
}

impl Sde for Turn3d {
    fn states(&self) -> usize {
        7
    }

    fn noises(&self) -> usize {
        4
    }

    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        dx[0] = x[1];
        dx[1] = -(x[6] * x[3]);
        dx[2] = x[3];
        dx[3] = x[6] * x[1];
        dx[4] = x[5];
        dx[5] = T::zero();
        dx[6] = T::zero();
    }

    #[inline(always)]
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g.fill(T::zero());
        for (noise, state) in [1, 3, 5].into_iter().enumerate() {
            g[state * 4 + noise] = T::of(self.velocity);
        }
        g[6 * 4 + 3] = T::of(self.rate);
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }

    #[inline(always)]
    fn drift_points<T: Real>(&self, _: &At<T>, points: usize, x: &[T], dx: &mut [T], _: &mut [T]) {
        let row = |i: usize| &x[i * points..(i + 1) * points];
        let (vx, vy, vz, rate) = (row(1), row(3), row(5), row(6));
        for (i, dx) in dx.chunks_exact_mut(points.max(1)).enumerate() {
            match i {
                0 => dx.copy_from_slice(vx),
                1 => turned(dx, -T::one(), rate, vy),
                2 => dx.copy_from_slice(vy),
                3 => turned(dx, T::one(), rate, vx),
                4 => dx.copy_from_slice(vz),
                _ => dx.fill(T::zero()),
            }
        }
    }

    /// L₀f = J f, as the drift has no curvature along a noise.
    #[inline(always)]
    fn expansion_points<T: Real>(
        &self,
        at: &At<T>,
        points: usize,
        x: &[T],
        f: &mut [T],
        l0: &mut [T],
        lf: &mut [T],
        scratch: &mut [T],
    ) {
        self.drift_points(at, points, x, f, scratch);
        let (first, second) = (T::of(self.velocity), T::of(self.rate));
        let row = |i: usize| &x[i * points..(i + 1) * points];
        let (vx, vy, rate) = (row(1), row(3), row(6));
        let rows = l0.chunks_exact_mut(points.max(1));
        for (i, l0) in rows.enumerate() {
            match i {
                0 => turned(l0, -T::one(), rate, vy),
                1 => turned_twice(l0, rate, vx),
                2 => turned(l0, T::one(), rate, vx),
                3 => turned_twice(l0, rate, vy),
                _ => l0.fill(T::zero()),
            }
        }
        for (at, lf) in lf.chunks_exact_mut(points.max(1)).enumerate() {
            match (at / 4, at % 4) {
                (0, 0) | (2, 1) | (4, 2) => lf.fill(first),
                (1, 1) => scaled(lf, -first, rate),
                (1, 3) => scaled(lf, -second, vy),
                (3, 0) => scaled(lf, first, rate),
                (3, 3) => scaled(lf, second, vx),
                _ => lf.fill(T::zero()),
            }
        }
    }
}

#[inline(always)]
fn scaled<T: Real>(to: &mut [T], by: T, of: &[T]) {
    for (to, &x) in to.iter_mut().zip(of) {
        *to = by * x;
    }
}

/// ± ω v.
#[inline(always)]
fn turned<T: Real>(to: &mut [T], sign: T, rate: &[T], v: &[T]) {
    for ((to, &w), &v) in to.iter_mut().zip(rate).zip(v) {
        *to = sign * (w * v);
    }
}

/// −ω² v.
#[inline(always)]
fn turned_twice<T: Real>(to: &mut [T], rate: &[T], v: &[T]) {
    for ((to, &w), &v) in to.iter_mut().zip(rate).zip(v) {
        *to = -(w * (w * v));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::expansion_by_duals;

    #[test]
    fn the_expansion_in_closed_form_is_that_of_the_derivatives() {
        const POINTS: usize = 3;
        let turn = Turn3d { velocity: 0.4, rate: 0.03 };
        let at = At { t: 0.0, dt: 0.5, u: &[], p: &[] };
        let x: [f64; 7 * POINTS] = core::array::from_fn(|k| (k as f64 * 1.7).sin() + 0.2);
        let (mut f, mut l0, mut lf) = ([1.0; 21], [1.0; 21], [1.0; 84]);
        let (mut g, mut m0, mut mf) = ([2.0; 21], [2.0; 21], [2.0; 84]);
        let mut scratch = [0.0; 200];
        turn.expansion_points(&at, POINTS, &x, &mut f, &mut l0, &mut lf, &mut scratch);
        expansion_by_duals(&turn, &at, POINTS, &x, &mut g, &mut m0, &mut mf, &mut scratch);
        for (a, b) in f.iter().chain(&l0).chain(&lf).zip(g.iter().chain(&m0).chain(&mf)) {
            assert!((a - b).abs() < 1e-15, "{a} {b}");
        }
    }
}
