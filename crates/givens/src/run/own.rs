//! A filter with memory of its own, for one model and its sensors.

use crate::filter::{Fault, Filter, Gaussian, Grow, Innovation, Over, Prior, Snapshot, StepError};
use crate::model::Observation;
use crate::rule::Rule;

pub(crate) type OwnFilter<'m, X, M> = Filter<'m, X, M, f64, Vec<f64>>;

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
pub(crate) fn start_own<'m, X: Over<M>, M, H: Observation>(
    method: X,
    model: &'m M,
    sensors: &H,
    start: Start,
    smoothing: bool,
) -> Result<OwnFilter<'m, X, M>, StepError> {
    let sizes = method.sizes(model).map_err(|fault| start.fail(fault))?;
    let sizes = sizes.with_sensor(sensors, method.rule().shape(sizes.states));
    let mut memory = Vec::new();
    memory.grow(OwnFilter::<X, M>::memory_len(&method, sizes, smoothing));
    match start {
        Start::Prior(time, prior) => {
            let prior = Prior { time, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
            Filter::start_in(method, model, sizes, smoothing, prior, memory)
        }
        Start::Snapshot(snapshot) => {
            Filter::resume_in(method, model, sizes, smoothing, snapshot.carried(), memory)
        }
    }
}

/// Writes ν of length d and P_zz, d × d, where a component was `present`; the rest stays.
pub(crate) fn scatter(innovation: &Innovation<f64>, present: &[bool], nu: &mut [f64], cov: &mut [f64]) {
    let d = present.len();
    let there = |k: &usize| present[*k];
    for (i, row) in (0..d).filter(there).enumerate() {
        nu[row] = innovation.nu[i];
        for (j, column) in (0..d).filter(there).enumerate() {
            cov[row * d + column] = innovation.cov(i, j);
        }
    }
}
