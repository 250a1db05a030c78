//! Time updates of run time: any of those for continuous models, so that the rest of a filter is compiled once for all.

use crate::filter::predict::{
    Backward, EulerMaruyama, Given, ItoTaylor, LevelSet, MomentOde, Plan, Stopped, TimeUpdate,
};
use crate::filter::{Belief, Fault, Form, Sizes};
use crate::model::{At, Sde};
use crate::ode::Work;
use crate::rule::{Rule, Shape};
use crate::scalar::Real;

/// Any time update of a continuous model.
#[derive(Clone, Copy, Debug)]
pub(super) enum AnyTime {
    ItoTaylor(ItoTaylor),
    EulerMaruyama(EulerMaruyama),
    MomentOde(MomentOde),
    LevelSet(LevelSet),
}

/// A level set has no covariance form: none is compiled.
pub(super) const LEVEL_SET_IN_COVARIANCE: Fault = Fault::Mismatch {
    why: "time_update = level-set is a square root by nature; form = covariance is not for it",
};

macro_rules! each {
    ($self:ident, $time:ident => $body:expr) => {
        match $self {
            AnyTime::ItoTaylor($time) => $body,
            AnyTime::EulerMaruyama($time) => $body,
            AnyTime::MomentOde($time) => $body,
            AnyTime::LevelSet($time) => $body,
        }
    };
}

impl<M: Sde> TimeUpdate<M> for AnyTime {
    fn check(&self, model: &M) -> Result<(), Fault> {
        each!(self, time => time.check(model))
    }

    fn resolves(&self, epsilon: f64) -> Result<(), Fault> {
        each!(self, time => TimeUpdate::<M>::resolves(time, epsilon))
    }

    fn states(&self, model: &M) -> usize {
        model.states()
    }

    fn sizes(&self, model: &M, shape: Shape) -> Sizes {
        each!(self, time => time.sizes(model, shape))
    }

    fn probe<T: Real>(&self, model: &M, at: &At<T>, mean: &[T], scratch: &mut [T]) -> Result<(), Fault> {
        each!(self, time => time.probe(model, at, mean, scratch))
    }

    fn lockstep(&self, smoothing: bool) -> bool {
        each!(self, time => TimeUpdate::<M>::lockstep(time, smoothing))
    }

    fn parameters<'m>(&self, model: &'m M) -> &'m [f64] {
        model.parameters()
    }

    fn scratch(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        each!(self, time => TimeUpdate::<M>::scratch(time, sizes, shape, smoothing))
    }

    fn plan(&self, model: &M, from: f64, to: f64) -> Result<Plan, Fault> {
        each!(self, time => time.plan(model, from, to))
    }

    fn moves_root(&self) -> bool {
        each!(self, time => TimeUpdate::<M>::moves_root(time))
    }

    fn step<T: Real, R: Rule, F: Form>(
        &self,
        given: &mut Given<T, M, R>,
        belief: &mut Belief<T>,
        back: Option<&mut Backward<T>>,
        work: &mut Work,
        scratch: &mut [T],
    ) -> Result<T::Mask, Stopped> {
        match self {
            AnyTime::ItoTaylor(time) => time.step::<T, R, F>(given, belief, back, work, scratch),
            AnyTime::EulerMaruyama(time) => time.step::<T, R, F>(given, belief, back, work, scratch),
            AnyTime::MomentOde(time) => time.step::<T, R, F>(given, belief, back, work, scratch),
            AnyTime::LevelSet(time) if F::SQUARE_ROOT => {
                time.step::<T, R, F>(given, belief, back, work, scratch)
            }
            AnyTime::LevelSet(_) => Err(LEVEL_SET_IN_COVARIANCE.into()),
        }
    }
}
