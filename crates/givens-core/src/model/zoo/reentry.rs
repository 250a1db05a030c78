//! A body that falls into the atmosphere, and the radar that measures its range.

use crate::model::{At, Noise, Observation, Sde, Varies};
use crate::scalar::Real;

/// A ballistic target on re-entry (2011 eq 42–44), in continuous time: altitude, speed downwards, ballistic coefficient
/// (m, m/s, 1/m). Drag is exp(−γ x₁) x₂² x₃, without the usual ½.
///
/// The paper steps the differential equation by Euler's method and has no process noise; here it stays an equation, and may
/// have noise in the speed and in the coefficient, which tumbling changes.
///
/// ```
/// use givens_core::filter::{Gaussian, Method, SrCdCkf};
/// use givens_core::model::zoo::{RangeAside, Reentry};
///
/// let model = Reentry { speed_noise: 5.0, ..Default::default() };
/// let prior = Gaussian::from_std(&[61e3, 3048.0, 4.49e-4], &[1e3, 100.0, 1e-4])?;
/// let mut f = SrCdCkf::default().start(&model, 0.0, prior)?;
/// f.predict(0.5)?;
/// f.update(&RangeAside::default(), &[59_400.0])?;
/// assert!((f.mean()[0] - 59_540.0).abs() < 100.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reentry {
    /// γ: how fast the air thins with altitude, 1/m.
    pub thinning: f64,
    /// g: m/s².
    pub gravity: f64,
    /// Noise of the speed, m/s per √s.
    pub speed_noise: f64,
    /// Noise of the ballistic coefficient, 1/m per √s.
    pub coefficient_noise: f64,
}

impl Default for Reentry {
    /// The values of 2011 eq 42–44: no noise.
    fn default() -> Self {
        Self { thinning: 1.49e-4, gravity: 9.81, speed_noise: 0.0, coefficient_noise: 0.0 }
    }
}

impl Sde for Reentry {
    fn states(&self) -> usize {
        3
    }

    fn noises(&self) -> usize {
        2
    }

    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        let drag = (-(T::of(self.thinning) * x[0])).exp() * x[1] * x[1] * x[2];
        dx[0] = -x[1];
        dx[1] = T::of(self.gravity) - drag;
        dx[2] = T::zero();
    }

    #[inline(always)]
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g.fill(T::zero());
        g[2] = T::of(self.speed_noise);
        g[5] = T::of(self.coefficient_noise);
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

/// A radar beside the line of fall that measures the range to a body at altitude x₁ (2011 eq 42–44).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeAside {
    /// Height of the radar, m.
    pub height: f64,
    /// Horizontal distance from the line of fall, m.
    pub distance: f64,
    /// Standard deviation of the range, m.
    pub std: f64,
}

impl Default for RangeAside {
    /// The values of 2011 eq 42–44: 1 km, 10 km, 30 m.
    fn default() -> Self {
        Self { height: 1e3, distance: 10e3, std: 30.0 }
    }
}

impl Observation for RangeAside {
    fn states(&self) -> usize {
        3
    }

    fn measures(&self) -> usize {
        1
    }

    #[inline(always)]
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        z[0] = T::of(self.distance).hypot(x[0] - T::of(self.height));
    }

    fn noise(&self) -> Noise {
        Noise::Root(1)
    }

    #[inline(always)]
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out[0] = T::of(self.std);
    }
}
