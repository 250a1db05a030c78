//! What the tests share: golden values, and comparison in units of a standard deviation.

use serde_json::Value;
use std::path::PathBuf;

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

/// The largest |Δ_i| / σ_i.
#[must_use]
pub fn mean_error(found: &[f64], expected: &[f64], cov: &[f64]) -> f64 {
    let n = expected.len();
    assert_eq!(found.len(), n);
    let sigma = |i: usize| cov[i * n + i].sqrt();
    (0..n).map(|i| scaled((found[i] - expected[i]).abs(), sigma(i))).fold(0.0, f64::max)
}

/// The largest |ΔP_ij| / (σ_i σ_j).
#[must_use]
pub fn cov_error(found: &[f64], expected: &[f64], n: usize) -> f64 {
    assert_eq!(found.len(), n * n);
    let sigma = |i: usize| expected[i * n + i].sqrt();
    let element = |i: usize, j: usize| (found[i * n + j] - expected[i * n + j]).abs();
    (0..n * n).map(|k| scaled(element(k / n, k % n), sigma(k / n) * sigma(k % n))).fold(0.0, f64::max)
}

/// 0 / 0 is no error: a state known exactly. A NaN is an infinite one.
fn scaled(difference: f64, scale: f64) -> f64 {
    let ratio = if difference == 0.0 { 0.0 } else { difference / scale };
    if ratio.is_nan() { f64::INFINITY } else { ratio }
}
