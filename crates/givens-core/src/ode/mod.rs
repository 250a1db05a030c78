//! Solvers of ordinary differential equations y' = f(t, y): what carries the moments of a continuous model over a gap
//! (docs/algorithms.md §9).
//!
//! A [`System`] gives the derivative and says how large an error is, in its own units; an [`Integrator`] is the user's
//! choice of solver, steps and tolerance. Memory is lent by the caller; nothing is carried from gap to gap, so that the
//! same gap gives the same bits.

mod adaptive;
mod adaptive_solver;
mod control;
mod explicit;
mod field;
mod fixed;
mod integrator;
mod rodas4;
mod rosenbrock;
mod segment;
mod stop;
mod tableau;

pub use adaptive_solver::AdaptiveSolver;
pub use integrator::{Integrator, Solver, Steps, Work};
pub use segment::Segment;
pub use stop::{Stop, Why};

use crate::model::At;
use crate::scalar::Real;

/// y' = f(t, y): what a time update integrates.
///
/// ```
/// use givens_core::model::At;
/// use givens_core::ode::{Integrator, System, Tolerance, Work};
/// use givens_core::scalar::Real;
///
/// /// y' = −p y.
/// struct Decay;
/// impl System for Decay {
///     type Fault = ();
///     fn len(&self) -> usize { 1 }
///     fn scratch(&self) -> usize { 0 }
///     fn derivative<T: Real>(
///         &self, at: &At<T>, _: &[T], y: &[T], dy: &mut [T], _: &mut [T],
///     ) -> Result<(), ()> {
///         dy[0] = -at.p[0] * y[0];
///         Ok(())
///     }
///     fn error<T: Real>(&self, tolerance: Tolerance, before: &[T], after: &[T], error: &[T]) -> f64 {
///         error[0].first().abs() / tolerance.of(before[0].first().abs().max(after[0].first().abs()))
///     }
/// }
///
/// let integrator = Integrator::default();
/// let mut memory = [0.0; 32];
/// assert!(memory.len() >= integrator.scratch(1, 0, 1, 0));
/// let at = At { t: 0.0, dt: 2.0, u: &[], p: &[0.5] };
/// let (mut y, mut work) = ([1.0], Work::default());
/// integrator.advance(&Decay, &at, &[], &mut y, &mut work, &mut memory).unwrap();
/// assert!((y[0] - (-1.0_f64).exp()).abs() < 1e-6);
/// ```
#[allow(clippy::len_without_is_empty)] // a system without state is none
pub trait System {
    /// Why a derivative does not exist at a state: a covariance without a root, say.
    type Fault: Copy;

    /// Length N of y.
    fn len(&self) -> usize;

    /// Scalars of scratch of [`derivative`](Self::derivative), of its own scalar type.
    fn scratch(&self) -> usize;

    /// Writes f(t, y) to `dy`; both have length N.
    ///
    /// [`At::t`] is the time and [`At::dt`] is zero. `table` is data of the system's own, nodes and weights of a rule
    /// say; with the controls and parameters it is lifted where `T` is a dual.
    ///
    /// # Errors
    /// Why there is no derivative at this state.
    fn derivative<T: Real>(
        &self,
        at: &At<T>,
        table: &[T],
        y: &[T],
        dy: &mut [T],
        scratch: &mut [T],
    ) -> Result<(), Self::Fault>;

    /// The size of `error`, made in a step from `before` to `after`, in units of the tolerance: a step is accepted up
    /// to one. Proportional to `error`. (Moments are scaled by their own standard deviations.)
    fn error<T: Real>(&self, tolerance: Tolerance, before: &[T], after: &[T], error: &[T]) -> f64;
}

/// How large an error of one step may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Relative to the size that the system gives a component.
    pub rtol: f64,
    /// Absolute, in the component's unit.
    pub atol: f64,
}

impl Tolerance {
    /// A millionth of the size, as a constant.
    pub const DEFAULT: Self = Self { rtol: 1e-6, atol: 0.0 };

    /// The error allowed in a quantity of this size.
    #[must_use]
    pub const fn of(self, size: f64) -> f64 {
        self.atol + self.rtol * size
    }
}

impl Default for Tolerance {
    fn default() -> Self {
        Self::DEFAULT
    }
}
