//! A method, a model and its measurements.

use givens_contest::{Failure, Table};
use givens_core::filter::{Gaussian, Over, Prior, Sizes};
use givens_core::model::Observation;

/// One run of a filter: rows of measurements at dt, 2 dt, …
pub struct Problem<X, M, H> {
    pub method: X,
    pub model: M,
    pub sensor: H,
    pub prior: Gaussian,
    pub dt: f64,
    pub rows: Table,
    /// Rows that are one trajectory.
    pub steps: usize,
    /// Every so many of them are reported.
    pub every: usize,
}

impl<X: Over<M>, M, H: Observation> Problem<X, M, H> {
    /// The prior, as filters take it.
    pub fn start(&self) -> Prior<'_> {
        Prior { time: 0.0, mean: self.prior.mean(), factor: self.prior.factor(), cov: self.prior.cov() }
    }

    /// How many trajectories the rows are.
    pub fn tracks(&self) -> usize {
        self.rows.rows() / self.steps
    }
}

/// A belief whose components know nothing of each other.
pub fn prior(mean: &[f64], variances: &[f64]) -> Result<Gaussian, Failure> {
    let n = mean.len();
    let mut cov = vec![0.0; n * n];
    for (i, &v) in variances.iter().enumerate() {
        cov[i * (n + 1)] = v;
    }
    Ok(Gaussian::from_cov(mean, &cov)?)
}

/// The sizes of a model for a method.
pub fn sizes<X: Over<M>, M>(method: &X, model: &M) -> Result<Sizes, Failure> {
    Ok(method.sizes(model).map_err(|fault| format!("{fault:?}"))?)
}
