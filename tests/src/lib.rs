//! What the tests share: golden values, and comparison in units of a standard deviation.

pub mod choices;
pub mod counted;
pub mod exact;
pub mod ill_conditioned;
pub mod models;
pub mod scenario;
pub mod sde;
pub mod stress;

// the examples of the README run with those of the documentation
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}

use proptest::prelude::ProptestConfig;
use serde_json::Value;
use std::path::PathBuf;

/// The scenarios of `golden` with expected values.
pub const SCENARIOS: [&str; 18] = [
    "missing",
    "crossing",
    "degrees",
    "three_d",
    "driven",
    "fixed_step",
    "known_state",
    "duplicated_state",
    "no_noise",
    "growing_rank",
    "contracting",
    "reentry",
    "prediction_rows",
    "one_time",
    "innovation_fails",
    "posterior_fails",
    "predicted_fails",
    "conditional_fails",
];

/// So many random cases, and `GIVENS_CASES` times as many where that is set.
#[must_use]
pub fn cases(count: u32) -> ProptestConfig {
    let times = std::env::var("GIVENS_CASES").ok().and_then(|times| times.parse().ok()).unwrap_or(1);
    ProptestConfig::with_cases(count * times)
}

/// A file of golden values.
#[must_use]
pub fn golden(name: &str) -> Value {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden").join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The numbers of a (nested) array, in order; null is NaN.
#[must_use]
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        Value::Null => vec![f64::NAN],
        other => vec![other.as_f64().unwrap_or_else(|| panic!("not a number: {other}"))],
    }
}

/// The symmetric matrix with this lower triangle, row by row.
#[must_use]
pub fn lower(triangle: &[f64]) -> Vec<f64> {
    let n = ((8 * triangle.len() + 1).isqrt() - 1) / 2;
    assert_eq!(n * (n + 1) / 2, triangle.len(), "not a triangle");
    let at = |i: usize, j: usize| triangle[i * (i + 1) / 2 + j];
    (0..n * n).map(|k| at((k / n).max(k % n), (k / n).min(k % n))).collect()
}

/// The largest |Δ_i| / σ_i; where σ_i = 0, |Δ_i| / max(1, |expected_i|).
#[must_use]
pub fn mean_error(found: &[f64], expected: &[f64], cov: &[f64]) -> f64 {
    let n = expected.len();
    assert_eq!(found.len(), n);
    let scale = |i: usize| match sigma(cov, n, i) {
        0.0 => expected[i].abs().max(1.0),
        sigma => sigma,
    };
    worst((0..n).map(|i| (found[i] - expected[i]).abs() / scale(i)))
}

/// The largest |ΔP_ij| / (σ_i σ_j); where that is zero, |ΔP_ij|.
#[must_use]
pub fn cov_error(found: &[f64], expected: &[f64], n: usize) -> f64 {
    assert_eq!((found.len(), expected.len()), (n * n, n * n));
    let scale = |i: usize, j: usize| match sigma(expected, n, i) * sigma(expected, n, j) {
        0.0 => 1.0,
        scale => scale,
    };
    worst((0..n * n).map(|k| (found[k] - expected[k]).abs() / scale(k / n, k % n)))
}

/// Standard deviation of component `i`; the oracle's zero is the rounding of its fifty digits.
fn sigma(cov: &[f64], n: usize, i: usize) -> f64 {
    let variance = cov[i * n + i];
    if variance < 1e-60 { 0.0 } else { variance.sqrt() }
}

/// The largest of the errors; a NaN is an infinite one.
pub fn worst(errors: impl Iterator<Item = f64>) -> f64 {
    errors.fold(0.0, |worst, error| if error.is_nan() { f64::INFINITY } else { error.max(worst) })
}
