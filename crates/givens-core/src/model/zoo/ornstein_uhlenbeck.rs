//! A quantity that is drawn back to a level and pushed away from it by noise.

use crate::model::{At, Sde, Varies};
use crate::scalar::Real;

/// The Ornstein–Uhlenbeck process (Uhlenbeck & Ornstein 1930): dx = −θ (x − μ) dt + σ dβ.
///
/// State: x. It is linear and its answers are known: from x₀ the mean tends to μ as e^(−θ t), and the variance to σ²/(2 θ).
///
/// ```
/// use givens_core::filter::{Gaussian, Method, SrCdCkf2};
/// use givens_core::model::zoo::OrnsteinUhlenbeck;
///
/// let model = OrnsteinUhlenbeck { rate: 0.5, level: 1.0, noise: 0.3 };
/// let prior = Gaussian::from_std(&[3.0], &[0.0001])?;
/// let mut f = SrCdCkf2::default().start(&model, 0.0, prior)?;
/// f.predict(30.0)?;
/// assert!((f.mean()[0] - 1.0).abs() < 1e-5);
/// assert!((f.cov()[0] - 0.3 * 0.3 / (2.0 * 0.5)).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrnsteinUhlenbeck {
    /// θ: how fast it is drawn back, per unit of time.
    pub rate: f64,
    /// μ: the level, in the unit of x.
    pub level: f64,
    /// σ: the unit of x per √ of the unit of time.
    pub noise: f64,
}

impl Default for OrnsteinUhlenbeck {
    /// θ = 1, μ = 0, σ = 1: variance ½ in the long run.
    fn default() -> Self {
        Self { rate: 1.0, level: 0.0, noise: 1.0 }
    }
}

impl Sde for OrnsteinUhlenbeck {
    fn states(&self) -> usize {
        1
    }

    fn noises(&self) -> usize {
        1
    }

    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        dx[0] = T::of(self.rate) * (T::of(self.level) - x[0]);
    }

    #[inline(always)]
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g[0] = T::of(self.noise);
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}
