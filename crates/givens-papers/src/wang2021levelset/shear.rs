//! The quadratic flow of Appendix A: (x, y)' = (0, x²), without noise, from x and y independent of variance 1.

use super::convergence::{Moments, predicted};
use crate::Trouble;
use givens::filter::predict::Velocity;
use givens::filter::{Gaussian, Lskf};
use givens::model::{At, Sde, Varies};
use givens::ode::Solver;
use givens::scalar::Real;

/// The flow in coordinates Q⁻¹(x, y). The level set moves with its coordinates, and begins in them from the root I; in
/// (x, y) that is to begin from the root Q.
pub(super) struct Shear {
    /// Q, orthogonal.
    pub root: [[f64; 2]; 2],
}

impl Sde for Shear {
    fn states(&self) -> usize {
        2
    }
    fn noises(&self) -> usize {
        0
    }
    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        let [[a, b], below] = self.root;
        let across = T::of(a) * x[0] + T::of(b) * x[1];
        dx[0] = T::of(below[0]) * (across * across);
        dx[1] = T::of(below[1]) * (across * across);
    }
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], _: &mut [T]) {}
    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

impl Shear {
    /// Any rotation, and as likely as not a mirror: from three normal numbers.
    pub fn random(mut normal: impl FnMut() -> f64) -> Self {
        let (sin, cos) = normal().atan2(normal()).sin_cos();
        let side = if normal() < 0.0 { -1.0 } else { 1.0 };
        Self { root: [[cos, -side * sin], [sin, side * cos]] }
    }

    /// The moments of (x, y) that the level set predicts for `t`.
    pub fn predicted(&self, velocity: Velocity, t: f64) -> Result<Moments, Trouble> {
        let prior = Gaussian::from_std(&[0.0, 0.0], &[1.0, 1.0])?;
        // all of it is linear in time, so that a few steps are exact
        let method = Lskf { velocity, solver: Solver::Rk4, substeps: 2, ..Lskf::default() };
        let (mean, cov) = predicted(&method, self, &prior, t)?;
        let q = self.root;
        let turned = |row: usize, of: &[f64]| q[row][0] * of[0] + q[row][1] * of[1];
        let rows = [0, 1].map(|row| [turned(row, &[cov[0], cov[2]]), turned(row, &[cov[1], cov[3]])]);
        let cov = vec![turned(0, &rows[0]), turned(1, &rows[0]), turned(0, &rows[1]), turned(1, &rows[1])];
        Ok((vec![turned(0, &mean), turned(1, &mean)], cov))
    }
}

/// The true mean and covariance at `t`.
pub(super) fn truth(t: f64) -> Moments {
    (vec![0.0, t], vec![1.0, 0.0, 0.0, 1.0 + 2.0 * t * t])
}

/// √∫ (g − u)², g the Gaussian of these moments and u the true density at `t`: x is normal, and y given x is
/// N(t x², 1).
pub(super) fn density_error((mean, cov): &Moments, t: f64) -> f64 {
    const STEP: f64 = 0.05;
    let normal =
        |x: f64, variance: f64| (-0.5 * x * x / variance).exp() / (core::f64::consts::TAU * variance).sqrt();
    let slope = cov[2] / cov[0];
    let rest = cov[3] - slope * cov[2];
    let both: f64 = (-160..=160)
        .map(|k| {
            let x = STEP * f64::from(k);
            let y = t * x * x - mean[1] - slope * (x - mean[0]);
            STEP * normal(x, 1.0) * normal(x - mean[0], cov[0]) * normal(y, rest + 1.0)
        })
        .sum();
    let half = 0.25 / core::f64::consts::PI;
    // the flow keeps areas, and so the integral of u²
    (half / (cov[0] * rest).sqrt() - 2.0 * both + half).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned() -> Shear {
        let (sin, cos) = 0.7f64.sin_cos();
        Shear { root: [[cos, sin], [sin, -cos]] }
    }

    #[test]
    fn at_the_cubature_radius_the_mean_is_exact_whatever_the_root() {
        let (mean, cov) = turned().predicted(Velocity::Cubature, 1.0).unwrap();
        assert!(mean[0].abs() < 1e-12 && (mean[1] - 1.0).abs() < 1e-12, "{mean:?}");
        assert!((cov[0] - 1.0).abs() < 1e-12 && cov[1].abs() < 1e-12);
        let (mean, _) = turned().predicted(Velocity::Averaged, 1.0).unwrap();
        assert!((mean[1] - 0.5).abs() < 1e-12);
        let (mean, _) = turned().predicted(Velocity::Standard, 1.0).unwrap();
        assert!(mean[1].abs() < 1e-12);
    }

    #[test]
    fn a_standard_root_moves_by_its_own_squares() {
        // M(t) = Q + t (0; x₁² x₂²), with x₁, x₂ the first row of Q
        let (shear, t) = (turned(), 0.5);
        let [[a, b], [c, d]] = shear.root;
        let below = [c + t * a * a, d + t * b * b];
        let (_, cov) = shear.predicted(Velocity::Standard, t).unwrap();
        assert!((cov[2] - (a * below[0] + b * below[1])).abs() < 1e-12);
        assert!((cov[3] - (below[0].powi(2) + below[1].powi(2))).abs() < 1e-12);
    }

    #[test]
    fn the_density_is_exact_before_the_flow_sets_in() {
        assert!(density_error(&(vec![0.0, 0.0], vec![1.0, 0.0, 0.0, 1.0]), 0.0) < 1e-7);
        // N(0, I) and N(0, 2 I): ∫ = 1/8π − 2/6π + 1/4π
        let found = density_error(&(vec![0.0, 0.0], vec![2.0, 0.0, 0.0, 2.0]), 0.0);
        assert!((found.powi(2) - (0.125 - 1.0 / 3.0 + 0.25) / core::f64::consts::PI).abs() < 1e-12);
    }
}
