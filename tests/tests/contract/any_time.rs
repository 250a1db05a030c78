//! States at any time: between the rows, at rows, after the last.

use crate::continuous::{adapts, run_if_any, tight};
use crate::distance;
use givens::filter::Fault;
use givens::registry::{Choice, resolve};
use givens::{Goal, Outcome};
use givens_tests::choices::continuous_choices;
use givens_tests::sde::Continuous;
use givens_tests::{cases, worst};
use proptest::prelude::*;

fn run_at(problem: &Continuous, choice: &Choice, goal: Goal, at: &[f64]) -> Outcome {
    let prior = problem.prior();
    choice.run_continuous(&problem.model, &problem.sensor, problem.rows(), 0.0, &prior, goal, at)
}

/// Two times in each gap, every row's own, and two after the last.
fn wanted(problem: &Continuous) -> Vec<f64> {
    let mut times = problem.times.clone();
    for gap in problem.times.windows(2) {
        times.extend([0.3, 0.8].map(|share| gap[0] + share * (gap[1] - gap[0])));
    }
    let last = problem.times[problem.times.len() - 1];
    times.extend([last + 0.2, last + 0.9]);
    times.sort_by(f64::total_cmp);
    times
}

/// The same problem with a row without measures at each of these times that is no row's.
fn with_rows(problem: &Continuous, at: &[f64]) -> Continuous {
    let nothing = vec![f64::NAN; problem.z[0].len()];
    let row = |t: &f64| problem.times.iter().position(|time| time == t);
    let z = at.iter().map(|t| row(t).map_or(nothing.clone(), |k| problem.z[k].clone())).collect();
    Continuous { times: at.to_vec(), z, ..problem.clone() }
}

proptest! {
    #![proptest_config(cases(4))]

    #[test]
    fn they_are_what_rows_without_measures_would_be(seed: u64, n in 1usize..=3, q in 1usize..=3) {
        let problem = Continuous::random(seed, [n, q, 1], 5, 0.0);
        let at = wanted(&problem);
        let answer = with_rows(&problem, &at).exact();
        for (name, choice) in continuous_choices(n).iter().filter(|(_, choice)| adapts(choice)) {
            let choice = tight(choice, 1e-10);
            if run_if_any(&problem, &choice, Goal::Interval).is_none() {
                continue;
            }
            for goal in [Goal::Filter, Goal::Interval] {
                let est = run_at(&problem, &choice, goal, &at).at;
                prop_assert_eq!(&est.time, &at);
                let expected = if goal == Goal::Filter { &answer.filtered } else { &answer.smoothed };
                let error = worst((0..at.len()).map(|k| distance(est.mean(k), est.cov(k), &expected[k])));
                prop_assert!(error < 1e-6, "{name} {goal:?}: {error:e}");
            }
        }
    }

    #[test]
    fn to_ask_changes_no_other_number(seed: u64, n in 1usize..=3, q in 1usize..=3) {
        let problem = Continuous::random(seed, [n, q, 1], 5, 0.4);
        let at = wanted(&problem);
        for (name, choice) in continuous_choices(n) {
            // a rule with negative weights may fail on a nonlinear problem
            let Ok(alone) = problem.run(&choice, Goal::Interval).into_result() else { continue };
            let all = run_at(&problem, &choice, Goal::Interval, &at);
            if let Some((_, error)) = &all.failure {
                prop_assert!(matches!(error.fault, Fault::NotPositive { .. }), "{} {}", name, error);
                continue;
            }
            prop_assert_eq!(&all.estimates.mean, &alone.mean, "{}", name);
            prop_assert_eq!(&all.estimates.cov, &alone.cov, "{}", name);
            for (k, &t) in at.iter().enumerate() {
                let one = run_at(&problem, &choice, Goal::Interval, &[t]).at;
                prop_assert_eq!((one.mean(0), one.cov(0)), (all.at.mean(k), all.at.cov(k)), "{} t = {}", name, t);
                if let Some(row) = problem.times.iter().position(|time| *time == t) {
                    prop_assert_eq!(all.at.mean(k), alone.mean(row));
                    prop_assert_eq!(all.at.log_likelihood[k], alone.log_likelihood[row]);
                }
            }
        }
    }
}

#[test]
fn a_filter_that_fails_has_answered_up_to_the_row_at_fault_and_a_smoother_up_to_the_one_before() {
    let mut problem = Continuous::random(3, [2, 1, 1], 3, 0.0);
    problem.z[1][0] = f64::INFINITY;
    let (first, second) = (problem.times[0], problem.times[1]);
    let at = [0.5 * first, first, 0.5 * (first + second), second, second + 1.0];
    let choice = resolve("sr-cd-ckf", &[]).unwrap();
    for (goal, answered) in [(Goal::Filter, 3), (Goal::Interval, 2)] {
        let outcome = run_at(&problem, &choice, goal, &at);
        assert_eq!(outcome.failure.map(|(row, _)| row), Some(1), "{goal:?}");
        assert_eq!(outcome.at.time, at[..answered], "{goal:?}");
        assert_eq!(outcome.at.mean(1), outcome.estimates.mean(0), "{goal:?}");
    }
}
