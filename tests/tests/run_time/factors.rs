//! The factors of all estimates: lower triangular with a non-negative diagonal, and roots of the covariances beside them.

use givens::filter::{Fault, Matrix, StepError};
use givens::registry::{Choice, FormName, RuleName, TimeName};
use givens::{Estimates, Goal, Outcome};
use givens_tests::choices::{choices, continuous_choices, counterparts};
use givens_tests::models::Problem;
use givens_tests::sde::Continuous;
use givens_tests::{cases, cov_error};
use proptest::prelude::*;

fn squared(factor: &[f64], n: usize) -> Vec<f64> {
    let element = |i: usize, j: usize| (0..n).map(|k| factor[i * n + k] * factor[j * n + k]).sum();
    (0..n * n).map(|k| element(k / n, k % n)).collect()
}

fn rooted(name: &str, choice: &Choice, est: &Estimates) {
    let n = est.states();
    assert_eq!(est.factor.len(), est.cov.len(), "{name}");
    for k in 0..est.len() {
        let factor = est.factor(k);
        let lower = (0..n).all(|i| {
            factor[i * n + i] >= 0.0 && factor[i * n + i + 1..(i + 1) * n].iter().all(|x| *x == 0.0)
        });
        assert!(lower, "{name}, row {k}: {factor:?}");
        // a covariance of differences is known to the rounding of what was subtracted
        let bound = if choice.form == FormName::SquareRoot { 1e-13 } else { 1e-9 };
        let error = cov_error(&squared(factor, n), est.cov(k), n);
        assert!(error < bound, "{name}, row {k}: {error:e}");
    }
}

/// The row in which a rule with negative weights has made of a covariance none, and of which; of any other failure, a panic.
fn refused(name: &str, choice: &Choice, outcome: &Outcome) -> Option<(usize, Matrix)> {
    let negative = matches!(choice.rule, RuleName::Unscented | RuleName::Cubature5);
    match outcome.failure {
        Some((row, StepError { fault: Fault::NotPositive { matrix, .. }, .. })) if negative => {
            Some((row, matrix))
        }
        failure => {
            assert_eq!(failure, None, "{name}");
            None
        }
    }
}

/// All goals of a run. Where no covariance exists, all forms of the method say so.
fn all_goals(name: &str, choice: &Choice, point: f64, run: impl Fn(&Choice, Goal) -> Outcome) {
    for goal in [Goal::Filter, Goal::Interval, Goal::Lag(2), Goal::Point(point)] {
        let outcome = run(choice, goal);
        let name = &format!("{name} {goal:?}");
        let refusal = refused(name, choice, &outcome);
        // that of the state given the next one is needed by roots alone, and level sets have no other form
        if refusal.is_some_and(|(_, matrix)| matrix != Matrix::Conditional)
            && choice.form == FormName::SquareRoot
            && choice.time_update != TimeName::LevelSet
        {
            for other in counterparts(choice) {
                assert_eq!(refused(name, &other, &run(&other, goal)), refusal, "{name} and {other:?}");
            }
        }
        for est in [&outcome.estimates, &outcome.at] {
            rooted(name, choice, est);
        }
    }
}

proptest! {
    #![proptest_config(cases(5))]

    #[test]
    fn every_discrete_method_gives_roots(seed: u64, n in 1usize..=4, d in 1usize..=3) {
        let problem = Problem::random(seed, n, d, 6, 0.05);
        for (name, choice) in choices(n) {
            all_goals(&name, &choice, 2.0, |choice, goal| {
                let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
                choice.run(model, sensor, problem.rows(), 0.0, &prior, goal, &[1.0, 7.0])
            });
        }
    }

    #[test]
    fn every_continuous_method_gives_roots(seed: u64, n in 1usize..=3, q in 1usize..=2) {
        let problem = Continuous::random(seed, [n, q, 1], 4, 0.1);
        let [_, first, second, last] = problem.times[..] else { unreachable!() };
        let at = [0.5 * first, second, 0.5 * (second + last), last + 0.5];
        for (name, choice) in continuous_choices(n) {
            all_goals(&name, &choice, first, |choice, goal| {
                let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
                choice.run_continuous(model, sensor, problem.rows(), 0.0, &prior, goal, &at)
            });
        }
    }
}

#[test]
fn a_factor_is_the_filters_own_and_stays_with_its_row() {
    let mut problem = Problem::random(12, 2, 1, 6, 0.0);
    for (name, choice) in choices(2) {
        let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
        let est = choice.run(model, sensor, problem.rows(), 0.0, &prior, Goal::Filter, &[]).estimates;
        let mut f = choice.start(model, sensor, 0.0, &prior).unwrap();
        for (k, row) in problem.rows().enumerate() {
            f.predict(row.time).unwrap();
            f.update(row.z).unwrap();
            assert_eq!(f.factor(), est.factor(k), "{name}, row {k}");
        }
    }
    // a run that fails keeps the roots of the rows that it keeps
    problem.z[4][0] = f64::INFINITY;
    for (name, choice) in choices(2) {
        for goal in [Goal::Filter, Goal::Interval, Goal::Lag(1), Goal::Point(2.0)] {
            let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
            let outcome = choice.run(model, sensor, problem.rows(), 0.0, &prior, goal, &[]);
            assert_eq!(outcome.failure.map(|(row, _)| row), Some(4), "{name} {goal:?}");
            rooted(&format!("{name} {goal:?}"), &choice, &outcome.estimates);
        }
    }
}
