//! Where a track begins: the initial belief, as the file gives it or as `start` finds it from a row.

use givens::filter::{Gaussian, InvalidCovariance};
use givens::model::{At, Observation};

use super::Model;
use super::start::Start;
use crate::table::{Row, Track};

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

/// Why a track cannot begin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BeginError {
    /// The line of the table, from one, where it was to begin; none if there is no such row.
    pub line: Option<usize>,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: &'static str,
}

impl core::fmt::Display for BeginError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        write!(f, "{} ({})", self.message, self.help)
    }
}

impl core::error::Error for BeginError {}

impl Model {
    /// The initial belief of a track. States that `start` finds have the covariance that follows from the sensors'
    /// noise, J R Jᵀ; the others are independent of them.
    ///
    /// # Errors
    /// A track without a row that has what `start` reads, values of `start` that are not finite, a
    /// measurement noise that is no covariance.
    pub fn begin(&self, track: &Track) -> Result<Beginning, BeginError> {
        let mut mean: Vec<f64> = self.prior.mean.iter().map(|m| m.unwrap_or(0.0)).collect();
        let Some(start) = &self.start else {
            let prior = gaussian(&mean, &self.prior.cov, None)?;
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
            let message = format!("no row has all that `start` reads: {}", needed.join(", "));
            let help = "leave the track out, or give all states `mean` and `std` in place of `start`";
            return Err(BeginError { line: None, message, help });
        };
        let n = self.states.len();
        let k = start.states.len();
        let p: Vec<f64> = self.parameters.iter().map(|(_, value)| *value).collect();
        let (mut values, mut slopes) = (vec![0.0; k], vec![0.0; k * d]);
        start.function.evaluate(first.time, &first.u, &p, &first.z, &mut values, &mut slopes);
        let spread = self.spread(start, first, &p, &slopes)?;
        let mut cov = self.prior.cov.clone();
        for (a, &i) in start.states.iter().enumerate() {
            mean[i] = values[a];
            for (b, &j) in start.states.iter().enumerate() {
                cov[i * n + j] = spread[a * k + b];
            }
        }
        if let Some(i) = mean.iter().position(|m| !m.is_finite()) {
            let message = format!("`start` finds no finite `{}` from this row", self.states[i]);
            let help = "look for a division by zero, or the root of a negative number";
            return Err(BeginError { line: Some(first.line), message, help });
        }
        let prior = gaussian(&mean, &cov, Some(first.line))?;
        Ok(Beginning { time: first.time, prior, row, started: true })
    }

    /// J R Jᵀ, k × k, from the slopes J of `start` along all measures.
    fn spread(&self, start: &Start, row: &Row, p: &[f64], slopes: &[f64]) -> Result<Vec<f64>, BeginError> {
        let (d, k) = (self.measures(), start.states.len());
        let columns = self.observation.noise().columns(d);
        let mut root = vec![0.0; d * columns];
        let health = self.observation.noise_root(&At { t: row.time, dt: 0.0, u: &row.u, p }, &mut root);
        if let Some(pivot) = health.failed() {
            let mut names = self.sensors.iter().flat_map(|sensor| &sensor.columns);
            let name = names.nth(pivot).map_or("", String::as_str);
            let message = format!("the measurement noise is no covariance at this row (measure `{name}`)");
            let help = "check the expressions of `std` and `cov`";
            return Err(BeginError { line: Some(row.line), message, help });
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

fn gaussian(mean: &[f64], cov: &[f64], line: Option<usize>) -> Result<Gaussian, BeginError> {
    Gaussian::from_cov(mean, cov).map_err(|error: InvalidCovariance| BeginError {
        line,
        message: format!("the initial covariance: {error}"),
        help: "a covariance has no negative variance, and no correlation above one",
    })
}
