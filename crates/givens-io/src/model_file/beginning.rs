//! Where a track begins: the initial belief, as the file gives it or as `start` finds it from a row.

use givens::filter::{Gaussian, InvalidCovariance};
use givens::model::{At, Observation};

use super::Model;
use super::start::Start;
use crate::table::Track;

/// The initial belief of one track.
#[derive(Clone, Debug, PartialEq)]
pub struct Beginning {
    /// When it holds.
    pub time: f64,
    /// N(mean, covariance) of all states.
    pub prior: Gaussian,
    /// The row of the track at which it holds, or the first one after; rows before it have no estimate.
    pub row: usize,
    /// Whether `start` has read that row: it must not be used again.
    pub started: bool,
}

impl Model {
    /// The initial belief of a track. States that `start` finds have the covariance that follows from the sensors'
    /// noise, J R Jᵀ; the others are independent of them.
    ///
    /// # Errors
    /// In words: a track without a row that has what `start` reads, values of `start` that are not finite, a
    /// measurement noise that is no covariance.
    pub fn begin(&self, track: &Track) -> Result<Beginning, String> {
        let mut mean: Vec<f64> = self.prior.mean.iter().map(|m| m.unwrap_or(0.0)).collect();
        let Some(start) = &self.start else {
            let prior = gaussian(&mean, &self.prior.cov)?;
            return Ok(Beginning { time: track.start, prior, row: 0, started: false });
        };
        let d = self.measures();
        let has = |z: &[f64]| start.measures.iter().all(|&i| z.get(i).is_some_and(|z| z.is_finite()));
        let Some((row, first)) = track.rows.iter().enumerate().find(|(_, row)| has(&row.z)) else {
            let columns = self.sensors.iter().flat_map(|sensor| &sensor.columns);
            let needed: Vec<_> = columns
                .enumerate()
                .filter(|(i, _)| start.measures.contains(i))
                .map(|(_, c)| c.as_str())
                .collect();
            return Err(format!("no row has all that `start` reads: {}", needed.join(", ")));
        };
        let n = self.states.len();
        let k = start.states.len();
        let p: Vec<f64> = self.parameters.iter().map(|(_, value)| *value).collect();
        let (mut values, mut slopes) = (vec![0.0; k], vec![0.0; k * d]);
        start.function.evaluate(first.time, &first.u, &p, &first.z, &mut values, &mut slopes);
        let spread = self.spread(start, first.time, &first.u, &p, &slopes)?;
        let mut cov = self.prior.cov.clone();
        for (a, &i) in start.states.iter().enumerate() {
            mean[i] = values[a];
            for (b, &j) in start.states.iter().enumerate() {
                cov[i * n + j] = spread[a * k + b];
            }
        }
        if let Some(i) = mean.iter().position(|m| !m.is_finite()) {
            return Err(format!("line {}: `start` gives no finite `{}`", first.line, self.states[i]));
        }
        let prior = gaussian(&mean, &cov).map_err(|error| format!("line {}: {error}", first.line))?;
        Ok(Beginning { time: first.time, prior, row, started: true })
    }

    /// J R Jᵀ, k × k, from the slopes J of `start` along all measures.
    fn spread(
        &self,
        start: &Start,
        t: f64,
        u: &[f64],
        p: &[f64],
        slopes: &[f64],
    ) -> Result<Vec<f64>, String> {
        let (d, k) = (self.measures(), start.states.len());
        let columns = self.observation.noise().columns(d);
        let mut root = vec![0.0; d * columns];
        let health = self.observation.noise_root(&At { t, dt: 0.0, u, p }, &mut root);
        if let Some(pivot) = health.failed() {
            return Err(format!("the measurement noise at t = {t} is no covariance (measure {})", pivot + 1));
        }
        // A measure that `start` does not read has slope zero, whatever its noise.
        let image = |a: usize, c: usize| -> f64 {
            start.measures.iter().map(|&i| slopes[a * d + i] * root[i * columns + c]).sum()
        };
        let images: Vec<f64> = (0..k * columns).map(|at| image(at / columns, at % columns)).collect();
        let mut spread = vec![0.0; k * k];
        givens::kernels::square(&mut spread, k, &images, columns, columns);
        Ok(spread)
    }
}

fn gaussian(mean: &[f64], cov: &[f64]) -> Result<Gaussian, String> {
    Gaussian::from_cov(mean, cov)
        .map_err(|error: InvalidCovariance| format!("the initial covariance: {error}"))
}
