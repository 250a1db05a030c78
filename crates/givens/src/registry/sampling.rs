//! A chosen method, for trajectories drawn jointly.

use super::choice::Choice;
use super::dispatch::{Computing, Job};
use crate::filter::{Fault, Gaussian, StepError};
use crate::model::{AnyObservation, AnySde, AnyTransition, Observation, Sde, Transition};
use crate::run::{Draws, Failure, Samples, sample};
use crate::{Estimates, Row};

impl Choice {
    /// Draws trajectories of a discrete method through the rows; see [`sample()`].
    ///
    /// # Errors
    /// A continuous method, and those of [`sample()`].
    pub fn sample<'a, M: Transition + Sync, H: Observation + Sync>(
        &self,
        model: &M,
        sensors: &H,
        rows: impl Iterator<Item = Row<'a>>,
        t0: f64,
        prior: &Gaussian,
        draws: Draws,
    ) -> Result<Samples, Failure> {
        let rows: Vec<Row> = rows.collect();
        let (model, sensors) = (&AnyTransition::new(model), &AnyObservation::new(sensors));
        self.sample_any(Through { model, sensors, rows: &rows, t0, prior, draws })
    }

    /// Draws trajectories of a continuous method through the rows; see [`sample()`].
    ///
    /// # Errors
    /// A discrete method, and those of [`sample()`].
    pub fn sample_continuous<'a, M: Sde + Sync, H: Observation + Sync>(
        &self,
        model: &M,
        sensors: &H,
        rows: impl Iterator<Item = Row<'a>>,
        t0: f64,
        prior: &Gaussian,
        draws: Draws,
    ) -> Result<Samples, Failure> {
        let rows: Vec<Row> = rows.collect();
        let (model, sensors) = (&AnySde::new(model), &AnyObservation::new(sensors));
        self.sample_any_continuous(Through { model, sensors, rows: &rows, t0, prior, draws })
    }

    fn sample_any(&self, through: Through<AnyTransition>) -> Result<Samples, Failure> {
        let refused = through.refused();
        self.discrete(through).map_err(refused)?
    }

    fn sample_any_continuous(&self, through: Through<AnySde>) -> Result<Samples, Failure> {
        let refused = through.refused();
        self.continuous(through).map_err(refused)?
    }
}

struct Through<'s, M> {
    model: &'s M,
    sensors: &'s AnyObservation<'s>,
    rows: &'s [Row<'s>],
    t0: f64,
    prior: &'s Gaussian,
    draws: Draws,
}

impl<M> Through<'_, M> {
    /// The failure of a method that is not for this model.
    fn refused(&self) -> impl FnOnce(Fault) -> Failure + use<M> {
        let (time, finished) =
            (self.t0, Estimates::new(self.prior.mean().len(), self.sensors.measures(), true));
        move |fault| Failure {
            row: 0,
            error: StepError { fault, time, step: 0 },
            mean: Vec::new(),
            finished: Box::new(finished),
        }
    }
}

impl<M> Job<M> for Through<'_, M> {
    type Done = Result<Samples, Failure>;
    fn with<X: Computing<M>>(self, method: X) -> Self::Done {
        let rows = self.rows.iter().copied();
        sample(method, self.model, self.sensors, rows, self.t0, self.prior, self.draws)
    }
}
