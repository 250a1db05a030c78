//! Differences in units of a standard deviation, as tests/golden/README.md says.

use super::common::numbers;
use serde_json::Value;

/// A mean and the lower triangle of its covariance, as the golden files give them.
pub struct Expected {
    pub mean: Vec<f64>,
    cov: Vec<f64>,
}

impl Expected {
    pub fn of(mean: &Value, triangle: &Value) -> Self {
        Self { mean: numbers(mean), cov: numbers(triangle) }
    }

    /// From all of a covariance.
    pub fn full(mean: &Value, cov: &Value) -> Self {
        let (mean, cov) = (numbers(mean), numbers(cov));
        let n = mean.len();
        let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        Self { cov: lower.map(|(i, j)| cov[i * n + j]).collect(), mean }
    }

    /// From variances alone; the other elements are not compared.
    pub fn diagonal(mean: &[f64], variances: &[f64]) -> Self {
        let lower = |i: usize| (0..=i).map(move |j| (i, j));
        let element = |(i, j): (usize, usize)| if i == j { variances[i] } else { f64::NAN };
        Self { mean: mean.to_vec(), cov: (0..mean.len()).flat_map(lower).map(element).collect() }
    }

    fn element(&self, i: usize, j: usize) -> f64 {
        let (i, j) = (i.max(j), i.min(j));
        self.cov[i * (i + 1) / 2 + j]
    }

    fn sigma(&self, i: usize) -> f64 {
        self.element(i, i).max(0.0).sqrt()
    }

    /// The largest difference of a mean (or an innovation).
    pub fn mean_error(&self, found: &Value) -> f64 {
        let found = numbers(found);
        assert_eq!(found.len(), self.mean.len(), "length");
        let scale = |i: usize| if self.sigma(i) == 0.0 { self.mean[i].abs().max(1.0) } else { self.sigma(i) };
        largest((0..found.len()).map(|i| (found[i] - self.mean[i]).abs() / scale(i)))
    }

    /// The largest difference of a full covariance.
    pub fn cov_error(&self, found: &Value) -> f64 {
        let (found, n) = (numbers(found), self.mean.len());
        assert_eq!(found.len(), n * n, "size");
        let error = |i: usize, j: usize| {
            let scale = self.sigma(i) * self.sigma(j);
            let scale = if scale == 0.0 { 1.0 } else { scale };
            (found[i * n + j] - self.element(i, j)).abs() / scale
        };
        let known = (0..n * n).map(|k| (k / n, k % n)).filter(|&(i, j)| !self.element(i, j).is_nan());
        largest(known.map(|(i, j)| error(i, j)))
    }

    /// The larger of the two.
    pub fn error(&self, mean: &Value, cov: &Value) -> f64 {
        self.mean_error(mean).max(self.cov_error(cov))
    }
}

/// A number against another, relative where that is larger than one.
pub fn number_error(found: &Value, expected: &Value) -> f64 {
    match (found.as_f64(), expected.as_f64()) {
        (Some(found), Some(expected)) => (found - expected).abs() / expected.abs().max(1.0),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    }
}

/// A NaN is an infinite error.
fn largest(errors: impl Iterator<Item = f64>) -> f64 {
    errors.map(|error| if error.is_nan() { f64::INFINITY } else { error }).fold(0.0, f64::max)
}
