//! Any filter behind a pointer, whatever its types: what it tells is in `f64`.

use crate::filter::{Innovation, Over, Snapshot, StepError};
use crate::gate::teach;
use crate::model::Observation;
use crate::ode::Work;
use crate::run::{OwnFilter, of_kind, told, write_cov};
use crate::scalar::Real;

/// What any filter can do.
pub(super) trait Stepping {
    fn predict(&mut self, t: f64) -> Result<(), StepError>;
    /// Whether it was taken in.
    fn update(&mut self, z: &[f64], present: &[bool]) -> Result<bool, StepError>;
    fn set_controls(&mut self, u: &[f64]) -> Result<(), StepError>;
    fn set_parameters(&mut self, p: &[f64]) -> Result<(), StepError>;
    fn time(&self) -> f64;
    fn mean(&self) -> &[f64];
    fn factor(&self) -> &[f64];
    fn cov(&self) -> Vec<f64>;
    fn innovation(&self) -> Innovation<'_, f64>;
    fn work(&self) -> Work;
    fn snapshot(&self) -> Snapshot;
}

/// A filter and its sensors, and what it tells.
pub(super) struct With<'m, X, M, H, T> {
    filter: OwnFilter<'m, X, M, T>,
    sensors: &'m H,
    /// Of the gate, as in `Task`.
    limits: Vec<f64>,
    told: Told,
}

/// What a filter believes and has last learnt, in `f64`.
#[derive(Default)]
struct Told {
    mean: Vec<f64>,
    factor: Vec<f64>,
    predicted: Vec<f64>,
    nu: Vec<f64>,
    innovation: Vec<f64>,
    white: Vec<f64>,
    scores: [f64; 2],
}

impl<'m, X: Over<M>, M, H: Observation, T: Real> With<'m, X, M, H, T> {
    pub fn new(filter: OwnFilter<'m, X, M, T>, sensors: &'m H, limits: Vec<f64>) -> Self {
        let mut with = Self { filter, sensors, limits, told: Told::default() };
        with.tell();
        with
    }

    fn tell(&mut self) {
        let (filter, to) = (&self.filter, &mut self.told);
        let Innovation { predicted, nu, factor, white, nis, log_likelihood } = filter.innovation();
        for (to, from) in [
            (&mut to.mean, filter.mean()),
            (&mut to.factor, filter.factor()),
            (&mut to.predicted, predicted),
            (&mut to.nu, nu),
            (&mut to.innovation, factor),
            (&mut to.white, white),
        ] {
            to.clear();
            to.extend(told(from));
        }
        to.scores = [nis.first(), log_likelihood.first()];
    }
}

impl<X: Over<M>, M, H: Observation, T: Real> Stepping for With<'_, X, M, H, T> {
    fn predict(&mut self, t: f64) -> Result<(), StepError> {
        let done = self.filter.predict(t);
        self.tell();
        done
    }
    fn update(&mut self, z: &[f64], present: &[bool]) -> Result<bool, StepError> {
        let done = teach(&mut self.filter, self.sensors, z, present, &self.limits);
        self.tell();
        done
    }
    fn set_controls(&mut self, u: &[f64]) -> Result<(), StepError> {
        self.filter.set_controls(u)
    }
    fn set_parameters(&mut self, p: &[f64]) -> Result<(), StepError> {
        self.filter.set_parameters(p)
    }
    fn time(&self) -> f64 {
        self.filter.time()
    }
    fn mean(&self) -> &[f64] {
        &self.told.mean
    }
    fn factor(&self) -> &[f64] {
        &self.told.factor
    }
    fn cov(&self) -> Vec<f64> {
        let mut cov = vec![0.0; self.told.factor.len()];
        write_cov(&self.filter, &self.told.factor, &mut cov);
        cov
    }
    fn innovation(&self) -> Innovation<'_, f64> {
        let Told { predicted, nu, innovation, white, scores: [nis, log_likelihood], .. } = &self.told;
        Innovation { predicted, nu, factor: innovation, white, nis: *nis, log_likelihood: *log_likelihood }
    }
    fn work(&self) -> Work {
        self.filter.work()
    }
    fn snapshot(&self) -> Snapshot {
        of_kind(self.filter.carried())
    }
}
