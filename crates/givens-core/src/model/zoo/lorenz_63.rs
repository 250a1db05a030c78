//! Three states that never repeat.

use crate::model::{At, Sde, Varies};
use crate::scalar::Real;

/// Lorenz's model of convection (Lorenz 1963), with white noise on each state:
/// dx = σ (y − x) dt, dy = (x (ρ − z) − y) dt, dz = (x y − β z) dt.
///
/// State: x, y, z. With the values of the paper it is chaotic: two states close together part about e-fold in a unit of time.
/// The drift is quadratic.
///
/// ```
/// use givens_core::filter::{Gaussian, Method, SrCdCkf};
/// use givens_core::model::zoo::{Components, Lorenz63};
///
/// let model = Lorenz63::default();
/// let prior = Gaussian::from_std(&[1.5, -1.5, 25.5], &[1.0, 1.0, 1.0])?;
/// let mut f = SrCdCkf::default().start(&model, 0.0, prior)?;
/// f.predict(0.05)?;
/// f.update(&Components { states: 3, which: [0, 2], std: [0.5, 0.5] }, &[0.9, 22.0])?;
/// assert!(f.cov()[4] < 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lorenz63 {
    /// σ: the Prandtl number.
    pub sigma: f64,
    /// ρ: the Rayleigh number over its critical value.
    pub rho: f64,
    /// β: of the geometry.
    pub beta: f64,
    /// Noise of each state, per √ of the unit of time.
    pub noise: f64,
}

impl Default for Lorenz63 {
    /// σ = 10, ρ = 28, β = 8/3 as in the paper, which has no noise; here it is 0.5.
    fn default() -> Self {
        Self { sigma: 10.0, rho: 28.0, beta: 8.0 / 3.0, noise: 0.5 }
    }
}

impl Sde for Lorenz63 {
    fn states(&self) -> usize {
        3
    }

    fn noises(&self) -> usize {
        3
    }

    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        dx[0] = T::of(self.sigma) * (x[1] - x[0]);
        dx[1] = x[0] * (T::of(self.rho) - x[2]) - x[1];
        dx[2] = x[0] * x[1] - T::of(self.beta) * x[2];
    }

    #[inline(always)]
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g.fill(T::zero());
        for g in g.iter_mut().step_by(4) {
            *g = T::of(self.noise);
        }
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}
