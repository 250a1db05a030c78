//! What can go wrong in a step: data, not words.

use super::quantity::Quantity;
use crate::rule::RuleError;
use crate::scalar::Shown;
use core::fmt;

/// A symmetric matrix that a step needs a root of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Matrix {
    /// The covariance of the initial belief.
    Prior,
    /// Q, the covariance of the process noise.
    ProcessNoise,
    /// R, the covariance of the measurement noise.
    MeasurementNoise,
    /// P⁻, the covariance of the predicted state.
    Predicted,
    /// P_zz, the covariance of the innovation.
    Innovation,
    /// P, the covariance of the filtered state.
    Posterior,
    /// The covariance of a state given the next one, that a square-root smoother needs.
    Conditional,
    /// Pˢ, the covariance of the smoothed state.
    Smoothed,
}

impl Matrix {
    /// Its name in a message.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Matrix::Prior => "initial covariance",
            Matrix::ProcessNoise => "process noise covariance",
            Matrix::MeasurementNoise => "measurement noise covariance",
            Matrix::Predicted => "predicted covariance",
            Matrix::Innovation => "innovation covariance",
            Matrix::Posterior => "posterior covariance",
            Matrix::Conditional => "covariance of a state given the next one",
            Matrix::Smoothed => "smoothed covariance",
        }
    }
}

/// Why a solver went no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halt {
    /// It took as many steps as a gap may have.
    StepLimit {
        /// How many.
        limit: usize,
    },
    /// No step that the rounding of time leaves meets the tolerance.
    StepTooSmall,
}

/// The kind of a failure, with the place inside the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// A covariance is not positive semidefinite (or not definite, where it is divided by).
    NotPositive {
        /// Which.
        matrix: Matrix,
        /// The first pivot at which its factorisation fails, from zero.
        pivot: usize,
    },
    /// A component of the innovation has no variance: it is known exactly from the components before it.
    SingularInnovation {
        /// Which, from zero, in the whole measurement.
        measure: usize,
    },
    /// A model gave, or a filter was given, a number that is not finite.
    NotFinite {
        /// What.
        quantity: Quantity,
        /// Which component, from zero.
        component: usize,
    },
    /// A number given to the filter that is too large, or too small, for the numbers that it computes with.
    Unrepresentable {
        /// What.
        quantity: Quantity,
        /// Which component, from zero.
        component: usize,
        /// The number.
        value: f64,
    },
    /// The points of the rule lose more than an eighth of their steps in a component of the state, beside its mean, or the
    /// mean is rounded to a part of it: its standard deviation is a few spacings of numbers there, or less.
    Indistinct {
        /// Which component, from zero.
        component: usize,
    },
    /// A prediction into the past.
    Backwards {
        /// The time asked for.
        to: f64,
    },
    /// A gap that is not a whole number of the model's steps.
    NotWholeSteps {
        /// Length of the gap.
        gap: f64,
        /// The model's step.
        period: f64,
    },
    /// A slice of the wrong length.
    Length {
        /// Of what.
        of: &'static str,
        /// The length it must have.
        expected: usize,
        /// The length it has.
        found: usize,
    },
    /// The model has controls, and they were never set.
    ControlsNotSet {
        /// How many it has.
        controls: usize,
    },
    /// A diffusion that depends on the state, for a time update that cannot serve it.
    StateDependentDiffusion,
    /// A covariance whose factor a time update divides by, and that has no inverse: a state is known exactly.
    SingularFactor {
        /// The pivot, from zero.
        pivot: usize,
    },
    /// Equal steps of a solver are too long for the way back of a smoother, which the belief itself need not show.
    Unresolved {
        /// The component of the state, from zero.
        component: usize,
    },
    /// The solver of a time update went no further.
    Solver {
        /// Why.
        why: Halt,
        /// The smallest step it tried.
        smallest: f64,
    },
    /// An option out of its range.
    Option(RuleError),
    /// Parts of a method, or a method and a model, that do not go together.
    Mismatch {
        /// Which, and why not.
        why: &'static str,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Fault::NotPositive { matrix, pivot } => {
                write!(f, "the {} is not positive definite (pivot {})", matrix.name(), pivot + 1)
            }
            Fault::SingularInnovation { measure } => write!(
                f,
                "the innovation covariance is singular (component {} has no variance of its own); give it measurement \
                 noise",
                measure + 1
            ),
            Fault::NotFinite { quantity, component } => {
                write!(f, "component {} of the {} is not a finite number", component + 1, quantity.name())?;
                match quantity {
                    Quantity::TransitionDerivative | Quantity::ObservationDerivative => f.write_str(
                        ": taken with respect to the state at the mean; use a method without derivatives (sr-ckf), or \
                         start off that point",
                    ),
                    Quantity::Measurement => f.write_str("; `update_present` takes missing components"),
                    Quantity::Innovation => f.write_str("; the measurement is far from what was expected"),
                    _ => Ok(()),
                }
            }
            Fault::Unrepresentable { quantity, component, value } => write!(
                f,
                "component {} of the {}, {}, is beyond what f32 can keep (1.2e-38 to 3.4e38); choose other units, or f64",
                component + 1,
                quantity.name(),
                Shown(value)
            ),
            Fault::Indistinct { component } => write!(
                f,
                "the standard deviation of component {} of the state is a few spacings of numbers at its mean, or less: \
                 rounding would decide what becomes of it; measure it from a nearer origin, or make its standard \
                 deviation zero if it is known",
                component + 1
            ),
            Fault::Backwards { to } => write!(f, "cannot predict back to t = {}", Shown(to)),
            Fault::NotWholeSteps { gap, period } => {
                write!(f, "a gap of {} is not a whole number of steps of {}", Shown(gap), Shown(period))
            }
            Fault::Length { of, expected, found } => {
                write!(f, "{of}: expected length {expected}, found {found}")
            }
            Fault::ControlsNotSet { controls } => {
                write!(
                    f,
                    "the model has {controls} controls that were never set; give them to `set_controls` first"
                )
            }
            Fault::StateDependentDiffusion => f.write_str(
                "the diffusion depends on the state; time updates for such a model: moment-ode, euler-maruyama",
            ),
            Fault::Unresolved { component } => write!(
                f,
                "the steps are too long for the way back of component {} of the state: take more of them, or a solver that \
                 chooses them",
                component + 1
            ),
            Fault::SingularFactor { pivot } => write!(
                f,
                "the factor of the covariance is singular (pivot {}): a state is known exactly, and this time update \
                 divides by the factor; time_update = ito-taylor does not",
                pivot + 1
            ),
            Fault::Solver { why: Halt::StepLimit { limit }, smallest } => write!(
                f,
                "the solver has used its {limit} steps, the smallest of {smallest:e}; the drift is likely stiff: solver = \
                 rodas4 is for that; or loosen rtol"
            ),
            Fault::Solver { why: Halt::StepTooSmall, smallest } => {
                write!(f, "no step of at least {smallest:e} meets the tolerance; loosen rtol, or set atol")
            }
            Fault::Option(error) => error.fmt(f),
            Fault::Mismatch { why } => f.write_str(why),
        }
    }
}

/// A failed step: what, when, and the how-manieth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepError {
    /// What went wrong.
    pub fault: Fault,
    /// The time the filter had reached, or was to reach by the failing prediction.
    pub time: f64,
    /// How many predictions and updates had been done before.
    pub step: usize,
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "step {}, t = {}: {}", self.step, Shown(self.time), self.fault)
    }
}

impl core::error::Error for StepError {}
