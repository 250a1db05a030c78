//! Models: what moves the state and what measures it, written once over [`Real`](crate::scalar::Real).

mod erased;
mod expanded;
mod flow;
mod map;
mod observation;
mod sde;
mod side_by_side;
mod stack;
mod transition;
pub mod zoo;

pub use erased::{
    AnyObservation, AnySde, AnyTransition, ObservationCalls, Question, SdeCalls, TransitionCalls,
};
pub use expanded::Expanded;
pub(crate) use expanded::expanded_scratch;
pub use flow::Flow;
pub(crate) use flow::flow_scratch;
pub use map::{
    AtPoint, Linear, Map, Moving, Sensed, linear_by_duals, linear_scratch, points_one_by_one, points_scratch,
};
pub use observation::Observation;
pub(crate) use sde::drift_scratch;
pub use sde::{Sde, Varies, expansion_by_duals, expansion_scratch};
pub(crate) use side_by_side::{
    SLACK, evaluate_side_by_side, filled, misaligned, scratch_for, side_by_side_scratch,
};
pub use transition::Transition;

/// Where a model is evaluated: time, step, controls and parameters, all of the scalar's type, so that they
/// may differ from lane to lane and carry derivatives.
#[derive(Clone, Copy, Debug)]
pub struct At<'a, T> {
    /// Time, in the model's unit: the start of a transition, the measurement's own time for an observation.
    pub t: T,
    /// Length of the step; zero for an observation.
    pub dt: T,
    /// Controls.
    pub u: &'a [T],
    /// Parameters.
    pub p: &'a [T],
}

/// The shape in which a model states a noise covariance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noise {
    /// A root with this many columns: C = B Bᵀ, B of size dimension × columns. None: no noise.
    Root(usize),
    /// The covariance itself, dimension × dimension, positive semidefinite.
    Covariance,
}

impl Noise {
    /// Columns of the root that a filter works with, for a noise of dimension `n`.
    #[must_use]
    pub const fn columns(self, n: usize) -> usize {
        match self {
            Noise::Root(columns) => columns,
            Noise::Covariance => n,
        }
    }
}
