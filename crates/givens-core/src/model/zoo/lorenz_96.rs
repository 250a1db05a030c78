//! A quantity around a circle of latitude, with as many states as one likes.

use crate::model::{At, Sde, Varies};
use crate::scalar::Real;

/// Lorenz's model of predictability (Lorenz 1996; Lorenz & Emanuel 1998), with white noise on each state:
/// dxᵢ = ((xᵢ₊₁ − xᵢ₋₂) xᵢ₋₁ − xᵢ + F) dt, the indices taken round a circle of n.
///
/// State: x₁ … xₙ. A unit of time stands for five days. All xᵢ = F is a rest, unstable for the F = 8 of the paper; from n = 4 on
/// the terms of an equation are different states, below it they coincide.
///
/// ```
/// use givens_core::filter::{Gaussian, Method, SrCdCkf};
/// use givens_core::model::zoo::{Components, Lorenz96};
///
/// let model = Lorenz96 { states: 12, ..Default::default() };
/// let prior = Gaussian::from_std(&[8.0; 12], &[1.0; 12])?;
/// let mut f = SrCdCkf::default().start(&model, 0.0, prior)?;
/// f.predict(0.05)?;
/// f.update(&Components { states: 12, which: [0, 4, 8], std: [0.5; 3] }, &[8.6, 7.1, 8.3])?;
/// assert!(f.mean()[0] > f.mean()[4]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lorenz96 {
    /// n.
    pub states: usize,
    /// F: the forcing.
    pub forcing: f64,
    /// Noise of each state, per √ of the unit of time.
    pub noise: f64,
}

impl Default for Lorenz96 {
    /// n = 40 and F = 8 of Lorenz & Emanuel 1998, who have no noise; here it is 0.5.
    fn default() -> Self {
        Self { states: 40, forcing: 8.0, noise: 0.5 }
    }
}

impl Sde for Lorenz96 {
    fn states(&self) -> usize {
        self.states
    }

    fn noises(&self) -> usize {
        self.states
    }

    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        let n = x.len();
        for (i, dx) in dx.iter_mut().enumerate() {
            let [after, before, second] = [1, n - 1, 2 * n - 2].map(|by| x[(i + by) % n]);
            *dx = (after - second) * before - x[i] + T::of(self.forcing);
        }
    }

    #[inline(always)]
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g.fill(T::zero());
        for g in g.iter_mut().step_by(self.states + 1) {
            *g = T::of(self.noise);
        }
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}
