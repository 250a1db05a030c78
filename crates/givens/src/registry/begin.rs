//! A chosen method, begun from a belief or from a snapshot, to be stepped by hand.

use super::any_filter::AnyFilter;
use super::choice::Choice;
use super::dispatch::{Computing, Job};
use crate::filter::{Gaussian, Snapshot, StepError};
use crate::gate;
use crate::model::{Observation, Sde, Transition};
use crate::run::{Start, start_own};

impl Choice {
    /// Starts a filter of a discrete method from `prior`, the belief at time `t0`, to be stepped by hand. Several sensors
    /// are a tuple.
    ///
    /// # Errors
    /// A continuous method, an option out of its range, a prior of another length than the model's state.
    pub fn start<'m, M: Transition + Sync, H: Observation + Sync>(
        &self,
        model: &'m M,
        sensors: &'m H,
        t0: f64,
        prior: &Gaussian,
    ) -> Result<AnyFilter<'m>, StepError> {
        let start = Start::Prior(t0, prior);
        self.discrete(Begin { model, sensors, start }).map_err(|fault| start.fail(fault))?
    }

    /// Starts a filter of a continuous method from `prior`, the belief at time `t0`, to be stepped by hand. Several sensors
    /// are a tuple.
    ///
    /// # Errors
    /// A discrete method, an option out of its range, a prior of another length than the model's state, a model that the
    /// time update cannot serve.
    pub fn start_continuous<'m, M: Sde + Sync, H: Observation + Sync>(
        &self,
        model: &'m M,
        sensors: &'m H,
        t0: f64,
        prior: &Gaussian,
    ) -> Result<AnyFilter<'m>, StepError> {
        let start = Start::Prior(t0, prior);
        self.continuous(Begin { model, sensors, start }).map_err(|fault| start.fail(fault))?
    }

    /// Starts a filter of a discrete method where another one of the same method, model and sensors was when the snapshot
    /// was taken: it goes on with the same numbers to the bit.
    ///
    /// # Errors
    /// Those of [`start`](Self::start), and of [`Filter::resume_in`](crate::filter::Filter::resume_in).
    pub fn resume<'m, M: Transition + Sync, H: Observation + Sync>(
        &self,
        model: &'m M,
        sensors: &'m H,
        snapshot: &Snapshot,
    ) -> Result<AnyFilter<'m>, StepError> {
        let start = Start::Snapshot(snapshot);
        self.discrete(Begin { model, sensors, start }).map_err(|fault| start.fail(fault))?
    }

    /// The same of a continuous method.
    ///
    /// # Errors
    /// Those of [`start_continuous`](Self::start_continuous), and of
    /// [`Filter::resume_in`](crate::filter::Filter::resume_in).
    pub fn resume_continuous<'m, M: Sde + Sync, H: Observation + Sync>(
        &self,
        model: &'m M,
        sensors: &'m H,
        snapshot: &Snapshot,
    ) -> Result<AnyFilter<'m>, StepError> {
        let start = Start::Snapshot(snapshot);
        self.continuous(Begin { model, sensors, start }).map_err(|fault| start.fail(fault))?
    }
}

struct Begin<'s, 'm, M, H> {
    model: &'m M,
    sensors: &'m H,
    start: Start<'s>,
}

impl<'m, M: Sync, H: Observation + Sync> Job<M> for Begin<'_, 'm, M, H> {
    type Done = Result<AnyFilter<'m>, StepError>;
    fn with<X: Computing<M>>(self, method: X) -> Self::Done {
        let Self { model, sensors, start } = self;
        let limits = gate::limits(method.gate(), sensors.measures()).map_err(|fault| start.fail(fault))?;
        let filter = start_own::<X::Method, M, H, X::Number>(method.method(), model, sensors, start, false)?;
        Ok(AnyFilter::of(filter, sensors, limits))
    }
}
