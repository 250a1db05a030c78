//! Why an integration ended early.

use core::fmt;

/// An integration that did not reach the end of its gap. The state is left at the time reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop<F> {
    /// The time reached: the end of the last accepted step.
    pub time: f64,
    /// The length of the smallest step tried (of the gap, if none was).
    pub smallest: f64,
    /// Why it went no further.
    pub why: Why<F>,
}

/// What ended an integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Why<F> {
    /// The system has no derivative just beyond the time reached.
    System(F),
    /// As many steps as a gap may take were tried, or would be needed. An explicit solver on a stiff system ends so.
    StepLimit {
        /// How many.
        limit: usize,
    },
    /// A state or its derivative is not a finite number just beyond the time reached.
    NotFinite {
        /// Which component of y, from zero.
        component: usize,
    },
    /// A step that meets the tolerance would be lost in the rounding of time. Also a gap that is no finite number.
    StepTooSmall,
}

impl<F: fmt::Display> fmt::Display for Stop<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stop { time, smallest, .. } = *self;
        match &self.why {
            Why::System(fault) => write!(f, "{fault}, just beyond t = {time} (smallest step {smallest:e})"),
            Why::StepLimit { limit } => write!(
                f,
                "the solver's limit of {limit} steps is reached at t = {time}, the smallest step being {smallest:e}; if \
                 the drift is stiff, use solver rodas4; if not, loosen rtol or atol, or shorten the gap"
            ),
            Why::NotFinite { component } => write!(
                f,
                "component {} of the solver's state is not a finite number just beyond t = {time} (smallest step \
                 {smallest:e})",
                component + 1
            ),
            Why::StepTooSmall => write!(
                f,
                "no step of at least {smallest:e} from t = {time} meets the tolerance; loosen rtol or atol"
            ),
        }
    }
}

impl<F: fmt::Debug + fmt::Display> core::error::Error for Stop<F> {}
