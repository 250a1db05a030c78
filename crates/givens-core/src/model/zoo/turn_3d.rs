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
}
