//! A mass on a spring, pushed by noise.

use crate::model::{At, Sde, Varies};
use crate::scalar::Real;

/// The harmonic oscillator driven by white noise (Jazwinski 1970; Särkkä & Solin 2019): d²x/dt² + 2 ζ ω dx/dt + ω² x = σ × white
/// noise.
///
/// State: x, v (any unit, and that per s). With ζ > 0 the variances tend to σ²/(4 ζ ω³) and σ²/(4 ζ ω), and x and v to being
/// uncorrelated. (The oscillator of 2021 §3.5 has a third state and as printed, with its jerk −ε, is another one: it grows.)
///
/// ```
/// use givens_core::filter::{Gaussian, Method, SrCdCkf2};
/// use givens_core::model::zoo::HarmonicOscillator;
///
/// let model = HarmonicOscillator { frequency: 2.0, damping: 0.1, noise: 0.5 };
/// let prior = Gaussian::from_std(&[1.0, 0.0], &[0.1, 0.1])?;
/// let mut f = SrCdCkf2::default().start(&model, 0.0, prior)?;
/// f.predict(100.0)?;
/// assert!((f.cov()[0] - 0.25 / (4.0 * 0.1 * 8.0)).abs() < 1e-5);
/// assert!((f.cov()[3] - 0.25 / (4.0 * 0.1 * 2.0)).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HarmonicOscillator {
    /// ω: angular frequency without damping, rad/s.
    pub frequency: f64,
    /// ζ: the damping as a fraction of the critical one; 0 for none.
    pub damping: f64,
    /// σ: of the acceleration, the unit of v per √s.
    pub noise: f64,
}

impl Default for HarmonicOscillator {
    /// One swing in 2π s, a twentieth of the critical damping, σ = 0.1.
    fn default() -> Self {
        Self { frequency: 1.0, damping: 0.05, noise: 0.1 }
    }
}

impl Sde for HarmonicOscillator {
    fn states(&self) -> usize {
        2
    }

    fn noises(&self) -> usize {
        1
    }

    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        let w = self.frequency;
        dx[0] = x[1];
        dx[1] = -(T::of(w * w) * x[0]) - T::of(2.0 * self.damping * w) * x[1];
    }

    #[inline(always)]
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g[0] = T::zero();
        g[1] = T::of(self.noise);
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}
