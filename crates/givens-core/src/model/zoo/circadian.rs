//! The human clock, and the light that sets it.

use crate::model::{At, Sde, Varies};
use crate::scalar::Real;
use core::f64::consts::PI;

/// The pacemaker of Kronauer's kind, in its simpler form (Forger, Jewett & Kronauer 1999), with white noise. Time is in hours.
///
/// State: x, x_c, n. x and x_c go round a cycle of amplitude about 1 in 24.2 h (core body temperature is lowest about when x is);
/// n is the fraction of the eye's receptors that light has used up. Of an illuminance I (lux)
///
/// α = α₀ (I/I₀)^p, B = G (1 − n) α (1 − 0.4 x) (1 − 0.4 x_c),
/// dx = π/12 (x_c + B) dt, dx_c = π/12 (μ (x_c − 4/3 x_c³) − x ((24/(0.99669 τ))² + k B)) dt, dn = 60 (α (1 − n) − β n) dt.
///
/// The light is on from [`lights_on`](Self::lights_on) to [`lights_off`](Self::lights_off) on every day; t = 0 is midnight.
/// The paper has no noise. n forgets its beginning in some hours and nothing measures it: without noise of its own its standard
/// deviation would fall below the rounding of n in two days, and rules of points would refuse it (docs/algorithms.md R7).
///
/// ```
/// use givens_core::filter::{Gaussian, Method, SrCdCkf};
/// use givens_core::model::zoo::{Circadian, Components};
///
/// let model = Circadian::default();
/// let prior = Gaussian::from_std(&[0.0, -1.1, 0.5], &[0.5, 0.5, 0.1])?;
/// let mut f = SrCdCkf::default().start(&model, 0.0, prior)?;
/// let temperature = Components { states: 3, which: [0], std: [0.2] };
/// for (hour, z) in [(1.0, -0.2), (2.0, -0.6), (3.0, -0.7)] {
///     f.predict(hour)?;
///     f.update(&temperature, &[z])?;
/// }
/// assert!(f.cov()[0].sqrt() < 0.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circadian {
    /// τ: the period of the clock by itself, h.
    pub period: f64,
    /// μ: how strongly the cycle attracts.
    pub stiffness: f64,
    /// k: how much light changes the period.
    pub sensitivity: f64,
    /// G: the strength of the drive.
    pub gain: f64,
    /// α₀: at which rate light uses up receptors, at I₀, per minute.
    pub activation: f64,
    /// β: at which rate they recover, per minute.
    pub recovery: f64,
    /// p: the power of the illuminance.
    pub power: f64,
    /// I₀: lux.
    pub reference: f64,
    /// Illuminance while the light is on, lux.
    pub light: f64,
    /// When it goes on, hour of the day.
    pub lights_on: f64,
    /// When it goes off, hour of the day.
    pub lights_off: f64,
    /// Noise of x and x_c, per √h.
    pub noise: f64,
    /// Noise of n, per √h.
    pub receptor_noise: f64,
}

impl Default for Circadian {
    /// Values after Forger, Jewett & Kronauer 1999: τ = 24.2 h, μ = 0.23, k = 0.55, G = 33.75, α₀ = 0.05, β = 0.0075, p = 0.5,
    /// I₀ = 9500 lux. Ours: 500 lux from 7 to 23 o'clock, noise 0.02 of x and x_c and 0.005 of n.
    fn default() -> Self {
        Self {
            period: 24.2,
            stiffness: 0.23,
            sensitivity: 0.55,
            gain: 33.75,
            activation: 0.05,
            recovery: 0.0075,
            power: 0.5,
            reference: 9500.0,
            light: 500.0,
            lights_on: 7.0,
            lights_off: 23.0,
            noise: 0.02,
            receptor_noise: 0.005,
        }
    }
}

impl Circadian {
    /// α, per minute.
    #[inline(always)]
    fn rate<T: Real>(&self, t: T) -> T {
        let hour = t - T::of(24.0) * (t / T::of(24.0)).floor();
        let day = T::of(self.lights_on).le(hour) & hour.lt(T::of(self.lights_off));
        let lit = T::of(self.activation) * T::of(self.light / self.reference).pow(T::of(self.power));
        T::select(day, lit, T::zero())
    }
}

impl Sde for Circadian {
    fn states(&self) -> usize {
        3
    }

    fn noises(&self) -> usize {
        3
    }

    #[inline(always)]
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        let (rate, used) = (self.rate(at.t), x[2]);
        let tone = |x: T| T::one() - T::of(0.4) * x;
        let drive = T::of(self.gain) * (T::one() - used) * rate * tone(x[0]) * tone(x[1]);
        let cycle = T::of(self.stiffness) * (x[1] - T::of(4.0 / 3.0) * x[1] * x[1] * x[1]);
        let own = 24.0 / (0.99669 * self.period);
        let hourly = T::of(PI / 12.0);
        dx[0] = hourly * (x[1] + drive);
        dx[1] = hourly * (cycle - x[0] * (T::of(own * own) + T::of(self.sensitivity) * drive));
        dx[2] = T::of(60.0) * (rate * (T::one() - used) - T::of(self.recovery) * used);
    }

    #[inline(always)]
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g.fill(T::zero());
        g[0] = T::of(self.noise);
        g[4] = T::of(self.noise);
        g[8] = T::of(self.receptor_noise);
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}
