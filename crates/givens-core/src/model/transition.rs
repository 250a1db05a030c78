//! Discrete-time dynamics.

use super::map::{Linear, Moving, linear_by_duals, linear_scratch, points_one_by_one, points_scratch};
use super::{At, Noise};
use crate::kernels::{Health, cholesky};
use crate::scalar::Real;

/// x(t + dt) = f(x(t), t, dt, u) + w, w ~ N(0, Q).
///
/// Two bodies are required: the transition and its noise. The others follow from them and are there to be
/// overridden by those who evaluate many points at once faster, or have derivatives at hand.
///
/// ```
/// use givens_core::model::{At, Noise, Transition};
/// use givens_core::scalar::Real;
///
/// /// A position that drifts with a constant velocity.
/// struct Drift;
/// impl Transition for Drift {
///     fn states(&self) -> usize { 2 }
///     fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
///         out[0] = x[0] + at.dt * x[1];
///         out[1] = x[1];
///     }
///     fn noise(&self) -> Noise { Noise::Root(1) }
///     fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
///         out[0] = T::of(0.5) * at.dt * at.dt;
///         out[1] = at.dt;
///     }
/// }
/// ```
pub trait Transition {
    /// Length n of the state.
    fn states(&self) -> usize;

    /// The fixed length of a step, if the model has one: a gap in time is then that many steps, a whole number.
    /// Without one, a gap of any length is one step.
    fn period(&self) -> Option<f64> {
        None
    }

    /// Number of controls that [`At::u`] brings.
    fn controls(&self) -> usize {
        0
    }

    /// The parameters that [`At::p`] brings, with the values they have unless a filter is given others.
    fn parameters(&self) -> &[f64] {
        &[]
    }

    /// Writes f(x) to `out`; both have length n.
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]);

    /// The shape in which [`process_noise`](Self::process_noise) is written.
    fn noise(&self) -> Noise;

    /// Writes the noise of the step, row by row: a root, n × columns, or the covariance, n × n.
    fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]);

    /// Writes the root of the noise that filters work with, n × columns; health names the pivot of a covariance
    /// that is not positive semidefinite.
    #[inline(always)]
    fn noise_root<T: Real>(&self, at: &At<T>, root: &mut [T]) -> Health<T> {
        self.process_noise(at, root);
        match self.noise() {
            Noise::Root(_) => Health::good(),
            Noise::Covariance => cholesky(root, self.states()),
        }
    }

    /// Whether its functions serve packs, too: the points of a filter in `f64` then go through them side by side. A model that
    /// asks a function of `f64` elsewhere must say no.
    fn serves_packs(&self) -> bool {
        true
    }

    /// Scalars of scratch that the two methods below need for `points` points.
    fn transition_scratch(&self, points: usize) -> usize {
        let (n, beside) = (self.states(), self.controls() + self.parameters().len());
        let _ = points;
        points_scratch(n, n).max(linear_scratch(n, n, beside))
    }

    /// All points at once: `x` and `out` are n × `points`, component by component.
    #[inline(always)]
    fn transition_points<T: Real>(
        &self,
        at: &At<T>,
        points: usize,
        x: &[T],
        out: &mut [T],
        scratch: &mut [T],
    ) {
        let n = self.states();
        points_one_by_one(n, n, at, points, x, out, scratch, &Moving(self));
    }

    /// The first-order part: f(x), and J S with J = ∂f/∂x and `s` = S, n × n.
    #[inline(always)]
    fn transition_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let n = self.states();
        linear_by_duals(n, at, x, s, out, scratch, &Moving(self));
    }
}
