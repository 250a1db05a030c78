//! An oscillator that keeps its amplitude.

use crate::model::{At, Sde, Varies};
use crate::scalar::Real;

/// Van der Pol's oscillator (van der Pol 1926), driven by white noise: d²x/dt² = μ (1 − x²) dx/dt − x + σ × white noise.
///
/// State: x, v. From anywhere but rest it tends to a cycle of amplitude about 2, the slower the larger μ is; a large μ makes it
/// stiff (`solver = rodas4`). The drift is cubic, so that rules of third degree differ.
///
/// ```
/// use givens_core::filter::{Gaussian, Method, SrCdCkf};
/// use givens_core::model::zoo::{Components, VanDerPol};
///
/// let model = VanDerPol::default();
/// let prior = Gaussian::from_std(&[2.0, 0.0], &[0.3, 0.3])?;
/// let mut f = SrCdCkf::default().start(&model, 0.0, prior)?;
/// let sensor = Components { states: 2, which: [0], std: [0.1] };
/// f.predict(0.2)?;
/// f.update(&sensor, &[1.95])?;
/// assert!(f.cov()[0] < 0.1 * 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VanDerPol {
    /// μ: how strongly the cycle attracts.
    pub stiffness: f64,
    /// σ: of v, per √ of the unit of time.
    pub noise: f64,
}

impl Default for VanDerPol {
    /// μ = 2, at which the free root of the level set differs from the triangular one; σ = 0.3.
    fn default() -> Self {
        Self { stiffness: 2.0, noise: 0.3 }
    }
}

impl Sde for VanDerPol {
    fn states(&self) -> usize {
        2
    }

    fn noises(&self) -> usize {
        1
    }

    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        dx[0] = x[1];
        dx[1] = T::of(self.stiffness) * (T::one() - x[0] * x[0]) * x[1] - x[0];
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
