//! Small runs with a fixed seed, in bands of 3.5 binomial standard deviations about the counts of an independent program.

#![allow(clippy::unwrap_used)]

use givens_papers::sarkka2012continuous::lost;
use givens_papers::{Plan, Quiet};

fn of(runs: usize, key: &str, interval: f64, steps: usize) -> usize {
    lost(&Plan { runs: Some(runs), seed: 1, progress: &Quiet }, key, interval, steps).unwrap()
}

/// Around a rate of loss.
fn band(runs: usize, rate: f64) -> core::ops::RangeInclusive<usize> {
    let (mean, spread) = (runs as f64 * rate, (runs as f64 * rate * (1.0 - rate)).sqrt());
    (mean - 3.5 * spread).max(0.0).ceil() as usize..=(mean + 3.5 * spread).min(runs as f64) as usize
}

#[test]
fn the_moment_filters_fail_where_steps_are_coarse() {
    assert_eq!([of(6, "ckf2", 8.0, 1), of(6, "ukf2", 8.0, 2), of(4, "ckf2", 4.0, 1)], [6, 6, 4]);
}

#[test]
fn about_half_of_the_cubature_runs_fail_at_four_steps_of_four_seconds() {
    let (lost, band) = (of(24, "ckf2", 4.0, 4), band(24, 0.58));
    assert!(band.contains(&lost), "{lost} of 24, not in {band:?}");
}

#[test]
fn ito_taylor_cubature_keeps_its_runs_with_any_steps() {
    let (lost, band) = (of(12, "ckf1", 8.0, 4), band(12, 0.02));
    assert!(band.contains(&lost), "{lost} of 12, not in {band:?}");
}

#[test]
fn the_extended_filter_fails_in_more_than_half_of_the_runs_at_one_step_of_eight_seconds() {
    let (lost, band) = (of(24, "ekf", 8.0, 1), band(24, 0.59));
    assert!(band.contains(&lost), "{lost} of 24, not in {band:?}");
}

#[test]
fn an_unknown_filter_is_refused_by_name() {
    let plan = Plan { runs: Some(1), seed: 1, progress: &Quiet };
    assert!(lost(&plan, "ckf3", 4.0, 1).unwrap_err().to_string().contains("ckf3"));
}
