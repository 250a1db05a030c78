//! What the time updates of continuous models share: sizes, steps, and what they ask of the diffusion.

use super::Plan;
use crate::filter::error::Fault;
use crate::filter::start::Sizes;
use crate::model::{Sde, Varies};
use crate::ode::{Integrator, Steps};
use crate::scalar::Real;

/// The steps of a fixed division, in their range.
pub(super) fn check_steps(steps: Steps) -> Result<(), Fault> {
    Integrator { steps, ..Integrator::default() }.check().map_err(Fault::Option)
}

/// A continuous model, as its time updates see it.
pub(super) struct Continuous<'m, M>(pub &'m M);

impl<M: Sde> Continuous<'_, M> {
    /// Its sizes, with `model` scalars of scratch of its own.
    pub fn sizes(&self, model: usize) -> Sizes {
        Sizes {
            states: self.0.states(),
            process_noise: self.0.noises(),
            measures: 0,
            measurement_noise: 0,
            controls: self.0.controls(),
            parameters: self.0.parameters().len(),
            model,
        }
    }

    /// A diffusion that does not depend on the state.
    pub fn additive(&self) -> Result<(), Fault> {
        match self.0.diffusion_varies() {
            Varies::WithState => Err(Fault::StateDependentDiffusion),
            _ => Ok(()),
        }
    }
}

impl Plan {
    /// A gap in one piece.
    pub(super) fn whole(gap: f64) -> Self {
        Self { count: usize::from(gap > 0.0), dt: gap }
    }

    /// A gap divided as the user says.
    pub(super) fn of(steps: Steps, gap: f64) -> Self {
        let count = match steps {
            _ if gap == 0.0 => 0,
            Steps::Count(count) => count,
            // a gap that is a whole number of longest steps, but for rounding, takes no more than these
            Steps::Longest(longest) => (Real::floor(gap / longest * (1.0 - 1e-12)) + 1.0) as usize,
        };
        Self { count, dt: if count == 0 { 0.0 } else { gap / count as f64 } }
    }
}
