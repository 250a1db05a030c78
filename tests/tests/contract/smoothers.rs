//! Smoothers against each other and against what they may not do.

use crate::{apart, run};
use givens::registry::{FormName, RuleName};
use givens::{Estimates, Goal};
use givens_tests::cases;
use givens_tests::choices::choices;
use givens_tests::models::Problem;
use givens_tests::scenario::{ROADS, Scenario};
use givens_tests::{cov_error, mean_error};
use nalgebra::DMatrix;
use proptest::prelude::*;

/// The least eigenvalue of A − B, in the units in which A's diagonal is one.
fn least(a: &[f64], b: &[f64], n: usize) -> f64 {
    let scale = |k: usize| (a[k / n * (n + 1)] * a[k % n * (n + 1)]).sqrt();
    let scaled = DMatrix::from_fn(n, n, |i, j| (a[i * n + j] - b[i * n + j]) / scale(i * n + j));
    scaled.symmetric_eigenvalues().min()
}

fn same(a: (&[f64], &[f64]), b: (&[f64], &[f64])) -> f64 {
    mean_error(a.0, b.0, b.1).max(cov_error(a.1, b.1, b.0.len()))
}

fn at(est: &Estimates, row: usize) -> (&[f64], &[f64]) {
    (est.mean(row), est.cov(row))
}

proptest! {
    #![proptest_config(cases(10))]

    #[test]
    fn covariances_are_symmetric_and_positive_and_knowledge_never_shrinks(
        seed: u64, n in 1usize..=6, d in 1usize..=4,
    ) {
        let problem = Problem::random(seed, n, d, 6, 0.1);
        let nothing = vec![0.0; n * n];
        for (name, choice) in choices(n) {
            // weights below zero may take more than there is, which is an error
            let takes = choice.rule == RuleName::Unscented && n > 3;
            let outcome =
                choice.run(&problem.model, &problem.sensor, problem.rows(), 0.0, &problem.prior(), Goal::Interval, &[]);
            if takes && outcome.failure.as_ref().is_some_and(|(_, error)| error.to_string().contains("not positive definite")) {
                continue;
            }
            let est = outcome.into_result().unwrap();
            for k in 0..est.len() {
                for cov in [est.predicted_cov(k), est.filtered_cov(k), est.cov(k)] {
                    let mirrored = |at: usize| cov[at % n * n + at / n];
                    prop_assert!((0..n * n).all(|at| cov[at] == mirrored(at)), "{name}, row {k}");
                    prop_assert!(least(cov, &nothing, n) > 0.0, "{name}, row {k}");
                }
                prop_assert!(least(est.predicted_cov(k), est.filtered_cov(k), n) > -1e-12, "{name}, row {k}");
                prop_assert!(least(est.filtered_cov(k), est.cov(k), n) > -1e-12, "{name}, row {k}");
            }
        }
    }

    #[test]
    fn to_ask_for_the_past_changes_no_present(seed: u64, n in 1usize..=6, d in 1usize..=4) {
        let problem = Problem::random(seed, n, d, 6, 0.05);
        for (name, choice) in choices(n) {
            let filter = run(&choice, &problem, Goal::Filter);
            for goal in [Goal::Interval, Goal::Lag(2), Goal::Point(0.0)] {
                let est = run(&choice, &problem, goal);
                prop_assert_eq!(&est.filtered_mean, &filter.mean, "{} {:?}", name, goal);
                prop_assert_eq!(&est.filtered_cov, &filter.cov, "{} {:?}", name, goal);
                prop_assert_eq!(&est.log_likelihood, &filter.log_likelihood);
            }
        }
    }

    #[test]
    fn a_lag_is_a_point_begun_that_long_ago(seed: u64, n in 1usize..=6, d in 1usize..=4, lag in 0usize..=6) {
        let problem = Problem::random(seed, n, d, 6, 0.05);
        for (name, choice) in choices(n) {
            let lagged = run(&choice, &problem, Goal::Lag(lag));
            for k in 0..6 {
                let point = run(&choice, &problem, Goal::Point(k as f64 + 1.0));
                prop_assert_eq!(point.len(), 6 - k);
                // row k knows the rows up to k + lag, as far as there are any
                let known = lag.min(5 - k);
                let error = same(at(&lagged, k), at(&point, known));
                prop_assert!(error < 1e-10, "{name}, row {k}: {error:e}");
            }
        }
    }

    #[test]
    fn the_whole_interval_is_the_longest_lag_and_no_lag_is_the_filter(seed: u64, n in 1usize..=6, d in 1usize..=4) {
        let problem = Problem::random(seed, n, d, 6, 0.05);
        for (name, choice) in choices(n) {
            let interval = run(&choice, &problem, Goal::Interval);
            prop_assert!(apart(&run(&choice, &problem, Goal::Lag(100)), &interval) < 1e-12, "{}", name);
            let none = run(&choice, &problem, Goal::Lag(0));
            prop_assert_eq!((&none.mean, &none.cov), (&interval.filtered_mean, &interval.filtered_cov));
            let last = at(&interval, 5);
            prop_assert_eq!(last, (interval.filtered_mean(5), interval.filtered_cov(5)));
        }
    }
}

#[test]
fn what_was_finished_before_a_failure_is_smoothed_among_itself() {
    for name in ["innovation_fails", "posterior_fails", "predicted_fails"] {
        let scenario = Scenario::read(name);
        for (road, parts) in ROADS {
            let choice = scenario.choose("unscented", parts);
            for goal in [Goal::Filter, Goal::Interval, Goal::Lag(1), Goal::Point(1.0)] {
                let outcome = scenario.run(&choice, scenario.data(), goal);
                let (row, _) = outcome.failure.unwrap();
                let before = scenario.run(&choice, scenario.data().take(row), goal).into_result().unwrap();
                assert_eq!(outcome.estimates.len(), row, "{name} {road} {goal:?}");
                assert!(apart(&outcome.estimates, &before) < 1e-13, "{name} {road} {goal:?}");
            }
        }
    }
}

#[test]
fn a_smoother_that_fails_in_square_root_form_leaves_the_rows_before() {
    let scenario = Scenario::read("conditional_fails");
    for (road, parts) in &ROADS[1..] {
        let choice = scenario.choose("unscented", parts);
        assert_eq!(choice.form, FormName::SquareRoot);
        let outcome = scenario.run(&choice, scenario.data(), Goal::Interval);
        let (row, _) = outcome.failure.unwrap();
        let before = scenario.run(&choice, scenario.data().take(row), Goal::Interval).into_result().unwrap();
        assert!(apart(&outcome.estimates, &before) < 1e-13, "{road}");
    }
}
