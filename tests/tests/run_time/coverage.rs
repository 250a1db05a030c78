//! What every method says of its own errors, on models that the data are drawn from: NEES and NIS hold what their χ²
//! distributions say, over many runs.

use super::simulated::{Drawn, continuous, discrete};
use givens::Goal;
use givens::metrics::{chi_squared_quantile, nees};
use givens::registry::Choice;
use givens_tests::choices::{choices, continuous_choices};

/// Runs; each has rows that are not independent of each other, and so only some are looked at.
const RUNS: usize = 600;
/// The same of continuous models, which take longer.
const FEWER: usize = 150;
/// The shares of the χ² distributions that are counted.
const SHARES: [f64; 4] = [0.1, 0.5, 0.9, 0.99];
/// Standard deviations of a count that it may be off by: one of ten million beyond on either side.
const BAND: f64 = 5.2;

/// How far the share of `values` below the quantile of each share is off, in standard deviations of a count, at worst.
fn off(values: &[(f64, usize)]) -> f64 {
    let count = values.len() as f64;
    let of = |share: f64| {
        let below = values.iter().filter(|&&(x, dof)| x <= chi_squared_quantile(dof as f64, share)).count();
        (below as f64 - count * share).abs() / (count * share * (1.0 - share)).sqrt()
    };
    SHARES.into_iter().map(of).fold(0.0, f64::max)
}

/// NEES of all runs at some rows, and NIS at all: how far off each is.
fn all_off(drawn: &Drawn, goal: Goal, choice: &Choice) -> Vec<(String, f64)> {
    let outcomes = drawn.run(choice, goal);
    let rows = drawn.rows();
    let mut found = Vec::new();
    for row in [0, rows / 2, rows - 1] {
        let errors = outcomes.iter().enumerate().map(|(run, est)| {
            let truth = drawn.truth(run, row);
            let error: Vec<f64> = est.mean(row).iter().zip(truth).map(|(m, x)| m - x).collect();
            nees(&error, est.cov(row)).unwrap()
        });
        found.push((format!("NEES of row {row}"), off(&errors.collect::<Vec<_>>())));
    }
    // innovations are independent from row to row
    let nis = outcomes.iter().flat_map(|est| est.nis.iter().copied().zip(est.nis_dof.iter().copied()));
    found.push(("NIS".to_owned(), off(&nis.filter(|&(_, dof)| dof > 0).collect::<Vec<_>>())));
    found
}

fn holds(name: &str, drawn: &Drawn, goal: Goal, choice: &Choice) {
    for (what, found) in all_off(drawn, goal, choice) {
        assert!(found < BAND, "{name}, {goal:?}, {what}: {found} standard deviations");
    }
}

#[test]
fn every_discrete_method_on_linear_models() {
    let drawn = discrete(61, RUNS, 0.0);
    for (name, choice) in choices(2) {
        for goal in [Goal::Filter, Goal::Interval, Goal::Lag(2)] {
            holds(&name, &drawn, goal, &choice);
        }
    }
}

// what the rules leave out of a curve so flat is a small part of the bands
#[test]
fn every_discrete_method_on_models_that_bend() {
    let drawn = discrete(62, RUNS, 0.02);
    for (name, choice) in choices(2) {
        for goal in [Goal::Filter, Goal::Interval] {
            holds(&name, &drawn, goal, &choice);
        }
    }
}

#[test]
fn every_continuous_method_on_linear_models() {
    let drawn = continuous(63, FEWER, 0.0);
    for (name, choice) in continuous_choices(2) {
        for goal in [Goal::Filter, Goal::Interval] {
            holds(&name, &drawn, goal, &choice);
        }
    }
}

#[test]
fn every_continuous_method_on_models_that_bend() {
    let drawn = continuous(64, FEWER, 0.02);
    for (name, choice) in continuous_choices(2) {
        for goal in [Goal::Filter, Goal::Interval] {
            holds(&name, &drawn, goal, &choice);
        }
    }
}

#[test]
fn a_noise_that_is_told_too_small_is_found() {
    let mut drawn = discrete(61, RUNS, 0.0);
    drawn.shrink_noise(0.7);
    let (_, choice) = choices(2).remove(0);
    let found = all_off(&drawn, Goal::Filter, &choice);
    assert!(
        found.iter().any(|(_, found)| *found > BAND),
        "a variance of half its size went through: {found:?}"
    );
}
