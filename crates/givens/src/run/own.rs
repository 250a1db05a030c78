//! A filter with memory of its own, for one model and its sensors.

use crate::filter::{Carried, Fault, Filter, Gaussian, Grow, Innovation, Over, Prior, Snapshot, StepError};
use crate::model::Observation;
use crate::rule::Rule;
use crate::scalar::Real;

pub(crate) type OwnFilter<'m, X, M, T> = Filter<'m, X, M, T, Vec<T>>;

/// What a filter starts from.
#[derive(Clone, Copy)]
pub(crate) enum Start<'s> {
    /// A belief, and when it holds.
    Prior(f64, &'s Gaussian),
    /// Where another one was.
    Snapshot(&'s Snapshot),
}

impl Start<'_> {
    /// A failure before the first step.
    pub fn fail(&self, fault: Fault) -> StepError {
        match *self {
            Start::Prior(time, _) => StepError { fault, time, step: 0 },
            Start::Snapshot(&Snapshot { time, step, .. }) => StepError { fault, time, step },
        }
    }
}

/// Starts a filter with room for these sensors.
pub(crate) fn start_own<'m, X: Over<M>, M, H: Observation, T: Real>(
    method: X,
    model: &'m M,
    sensors: &H,
    start: Start,
    smoothing: bool,
) -> Result<OwnFilter<'m, X, M, T>, StepError> {
    let sizes = method.sizes(model).map_err(|fault| start.fail(fault))?;
    let sizes = sizes.with_sensor(sensors, method.rule().shape(sizes.states));
    let mut memory = Vec::new();
    memory.grow(OwnFilter::<X, M, T>::memory_len(&method, sizes, smoothing));
    match start {
        Start::Prior(time, prior) => {
            let prior = Prior { time, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
            Filter::start_in(method, model, sizes, smoothing, prior, memory)
        }
        Start::Snapshot(snapshot) => Filter::resume_in(
            method,
            model,
            sizes,
            smoothing,
            of_kind::<f64, T>(snapshot.carried()).carried(),
            memory,
        ),
    }
}

/// What a filter carries, in numbers of another kind.
pub(crate) fn of_kind<T: Real, U: Real>(from: Carried<T>) -> Snapshot<U> {
    let all = |of: &[T]| of.iter().map(|x| U::of(x.first())).collect();
    Snapshot {
        time: from.time,
        step: from.step,
        mean: all(from.mean),
        factor: all(from.factor),
        cov: all(from.cov),
        moved: all(from.moved),
        floor: all(from.floor),
        controls: from.controls.map(all),
        parameters: all(from.parameters),
        work: from.work,
    }
}

/// Writes ν of length d and P_zz, d × d, where a component was `present`; the rest stays.
pub(crate) fn scatter<T: Real>(
    innovation: &Innovation<T>,
    present: &[bool],
    nu: &mut [f64],
    cov: &mut [f64],
) {
    let d = present.len();
    let there = |k: &usize| present[*k];
    for (i, row) in (0..d).filter(there).enumerate() {
        nu[row] = innovation.nu[i].first();
        for (j, column) in (0..d).filter(there).enumerate() {
            cov[row * d + column] = innovation.cov(i, j).first();
        }
    }
}
