//! Sensors.

use super::map::{Linear, Sensed, linear_by_duals, linear_scratch, points_one_by_one, points_scratch};
use super::{At, Noise};
use crate::kernels::{Health, cholesky};
use crate::scalar::Real;

/// z = h(x, t, u) + v, v ~ N(0, R).
///
/// As for [`Transition`](super::Transition), the body and its noise are required and the rest follows.
///
/// ```
/// use givens_core::model::{At, Noise, Observation};
/// use givens_core::scalar::Real;
///
/// /// Range and bearing of a point in the plane, seen from the origin.
/// struct Radar;
/// impl Observation for Radar {
///     fn states(&self) -> usize { 2 }
///     fn measures(&self) -> usize { 2 }
///     fn angle(&self, i: usize) -> Option<f64> { (i == 1).then_some(core::f64::consts::TAU) }
///     fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
///         out[0] = x[0].hypot(x[1]);
///         out[1] = x[1].atan2(x[0]);
///     }
///     fn noise(&self) -> Noise { Noise::Root(2) }
///     fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
///         out.copy_from_slice(&[10.0, 0.0, 0.0, 0.003].map(T::of));
///     }
/// }
/// ```
pub trait Observation {
    /// Length n of the state.
    fn states(&self) -> usize;

    /// Length d of the measurement.
    fn measures(&self) -> usize;

    /// The period of component `i` if it is an angle: 2π for radians, 360 for degrees. An angle is wrapped in
    /// the mean, the spread and the innovation.
    fn angle(&self, i: usize) -> Option<f64> {
        let _ = i;
        None
    }

    /// Number of controls that [`At::u`] brings.
    fn controls(&self) -> usize {
        0
    }

    /// Number of parameters that [`At::p`] brings: the transition's own, or none.
    fn parameters(&self) -> usize {
        0
    }

    /// Writes h(x) to `out`; `x` has length n, `out` length d.
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]);

    /// The shape in which [`measurement_noise`](Self::measurement_noise) is written.
    fn noise(&self) -> Noise;

    /// Writes the noise of the measurement, row by row: a root, d × columns, or the covariance, d × d.
    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]);

    /// Writes the root of the noise that filters work with, d × columns; health names the pivot of a covariance
    /// that is not positive semidefinite.
    #[inline(always)]
    fn noise_root<T: Real>(&self, at: &At<T>, root: &mut [T]) -> Health<T> {
        self.measurement_noise(at, root);
        match self.noise() {
            Noise::Root(_) => Health::good(),
            Noise::Covariance => cholesky(root, self.measures()),
        }
    }

    /// Whether its functions serve packs, too: the points of a filter in `f64` then go through them side by side. A model that
    /// asks a function of `f64` elsewhere must say no.
    fn serves_packs(&self) -> bool {
        true
    }

    /// Scalars of scratch that the two methods below need for `points` points.
    fn observe_scratch(&self, points: usize) -> usize {
        let (n, d) = (self.states(), self.measures());
        let _ = points;
        points_scratch(n, d).max(linear_scratch(n, d, self.controls() + self.parameters()))
    }

    /// All points at once: `x` is n × `points` and `out` d × `points`, component by component.
    #[inline(always)]
    fn observe_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        let (n, d) = (self.states(), self.measures());
        points_one_by_one(n, d, at, points, x, out, scratch, &Sensed(self));
    }

    /// The first-order part: h(x), and H S with H = ∂h/∂x and `s` = S, n × n.
    #[inline(always)]
    fn observe_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let d = self.measures();
        linear_by_duals(d, at, x, s, out, scratch, &Sensed(self));
    }
}
