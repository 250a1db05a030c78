//! A chosen method, for trajectories drawn jointly.

use super::choice::Choice;
use super::dispatch::Job;
use crate::filter::{Fault, Gaussian, Over, StepError};
use crate::model::{Observation, Sde, Transition};
use crate::run::{Draws, Failure, Samples, sample};
use crate::{Estimates, Row};

impl Choice {
    /// Draws trajectories of a discrete method through the rows; see [`sample()`].
    ///
    /// # Errors
    /// A continuous method, and those of [`sample()`].
    pub fn sample<'a, M: Transition, H: Observation>(
        &self,
        model: &M,
        sensors: &H,
        rows: impl Iterator<Item = Row<'a>> + Clone,
        t0: f64,
        prior: &Gaussian,
        draws: Draws,
    ) -> Result<Samples, Failure> {
        let refused = refused(t0, prior.mean().len(), sensors.measures());
        self.discrete(Through { model, sensors, rows, t0, prior, draws }).map_err(refused)?
    }

    /// Draws trajectories of a continuous method through the rows; see [`sample()`].
    ///
    /// # Errors
    /// A discrete method, and those of [`sample()`].
    pub fn sample_continuous<'a, M: Sde, H: Observation>(
        &self,
        model: &M,
        sensors: &H,
        rows: impl Iterator<Item = Row<'a>> + Clone,
        t0: f64,
        prior: &Gaussian,
        draws: Draws,
    ) -> Result<Samples, Failure> {
        let refused = refused(t0, prior.mean().len(), sensors.measures());
        self.continuous(Through { model, sensors, rows, t0, prior, draws }).map_err(refused)?
    }
}

/// A method that is not for this model.
fn refused(time: f64, states: usize, measures: usize) -> impl FnOnce(Fault) -> Failure {
    let finished = Box::new(Estimates::new(states, measures, true));
    move |fault| Failure { row: 0, error: StepError { fault, time, step: 0 }, mean: Vec::new(), finished }
}

struct Through<'s, M, H, I> {
    model: &'s M,
    sensors: &'s H,
    rows: I,
    t0: f64,
    prior: &'s Gaussian,
    draws: Draws,
}

impl<'a, M, H: Observation, I: Iterator<Item = Row<'a>> + Clone> Job<M> for Through<'_, M, H, I> {
    type Done = Result<Samples, Failure>;
    fn with<X: Over<M> + Send + Sync + 'static>(self, method: X) -> Self::Done {
        sample(method, self.model, self.sensors, self.rows, self.t0, self.prior, self.draws)
    }
}
