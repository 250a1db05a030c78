//! What every method of the registry must do, whichever rule, form and update it is made of. A new method is tested here
//! without a line of its own.

#![allow(clippy::needless_update)] // some methods have no option beside `update`

mod any_time;
mod continuous;
mod continuous_types;
mod distinct;
mod equivalences;
mod faults;
mod flow_faults;
mod linear;
mod memory;
mod multiplicative;
mod order;
mod parameters;
mod periods;
mod precision;
mod repeated;
mod rules;
mod side_by_side;
mod singular;
mod smoothers;
mod stepping;
mod varying;
mod work;

use givens::registry::Choice;
use givens::{Estimates, Goal};
use givens_tests::exact::Moments;
use givens_tests::models::Problem;
use givens_tests::{cov_error, mean_error};

/// Runs a method over a problem.
fn run(choice: &Choice, problem: &Problem, goal: Goal) -> Estimates {
    let outcome =
        choice.run(&problem.model, &problem.sensor, problem.rows(), 0.0, &problem.prior(), goal, &[]);
    outcome.into_result().unwrap_or_else(|failure| panic!("{choice:?}: {failure}"))
}

/// The error of a mean and a covariance in standard deviations.
fn distance(mean: &[f64], cov: &[f64], expected: &Moments) -> f64 {
    let of = expected.1.as_slice();
    mean_error(mean, expected.0.as_slice(), of).max(cov_error(cov, of, mean.len()))
}

/// The largest distance between two runs: predicted, filtered and smoothed beliefs, innovations and log-likelihoods.
fn apart(a: &Estimates, b: &Estimates) -> f64 {
    assert_eq!((a.len(), a.states(), a.measures()), (b.len(), b.states(), b.measures()));
    let n = a.states();
    let row = |k: usize| {
        let beliefs = [
            (a.predicted_mean(k), a.predicted_cov(k), b.predicted_mean(k), b.predicted_cov(k)),
            (a.filtered_mean(k), a.filtered_cov(k), b.filtered_mean(k), b.filtered_cov(k)),
            (a.mean(k), a.cov(k), b.mean(k), b.cov(k)),
        ];
        let beliefs = beliefs.map(|(m, p, mean, cov)| mean_error(m, mean, cov).max(cov_error(p, cov, n)));
        let scale = |x: f64| x.abs().max(1.0);
        let number = |x: f64, y: f64| if x.is_nan() && y.is_nan() { 0.0 } else { (x - y).abs() / scale(y) };
        let innovation = a.innovation(k).iter().zip(b.innovation(k)).map(|(x, y)| number(*x, *y));
        let scores =
            [number(a.nis[k], b.nis[k]), number(a.log_likelihood[k], b.log_likelihood[k])].into_iter();
        givens_tests::worst(beliefs.into_iter().chain(innovation).chain(scores))
    };
    givens_tests::worst((0..a.len()).map(row))
}
