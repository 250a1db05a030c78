//! The methods for continuous models, on random linear ones with irregular times: each is the exact Kalman filter and
//! Rauch–Tung–Striebel smoother of the model's matrix exponential, up to its solver's tolerance, or at its steps' order.

use crate::{apart, distance};
use givens::filter::predict::Variant;
use givens::filter::{Block, Fault, Matrix, StepError};
use givens::ode::{Solver, Steps, Tolerance};
use givens::registry::{Choice, ENTRIES, FormName, Kind, RuleName, Setting, TimeName, resolve};
use givens::{Estimates, Goal};
use givens_tests::cases;
use givens_tests::choices::{choices, continuous_choices};
use givens_tests::exact::Answer;
use givens_tests::models::Problem;
use givens_tests::sde::Continuous;
use givens_tests::worst;
use proptest::prelude::*;

fn run(problem: &Continuous, choice: &Choice, goal: Goal) -> Estimates {
    problem.run(choice, goal).into_result().unwrap_or_else(|failure| panic!("{choice:?}: {failure}"))
}

/// A run, unless a rule with negative weights has made of a covariance none: which one then, and when.
pub fn run_or_not_positive(
    problem: &Continuous,
    choice: &Choice,
    goal: Goal,
) -> Result<Estimates, (usize, Matrix)> {
    let negative = matches!(choice.rule, RuleName::Unscented | RuleName::Cubature5);
    let outcome = problem.run(choice, goal);
    match outcome.failure {
        Some((row, StepError { fault: Fault::NotPositive { matrix, .. }, .. })) if negative => {
            Err((row, matrix))
        }
        _ => Ok(outcome.into_result().unwrap_or_else(|failure| panic!("{choice:?}: {failure}"))),
    }
}

/// The same where only that it ran matters.
pub fn run_if_any(problem: &Continuous, choice: &Choice, goal: Goal) -> Option<Estimates> {
    run_or_not_positive(problem, choice, goal).ok()
}

fn with(method: &str, settings: &[(&str, &str)]) -> Choice {
    let setting = |&(key, word): &(&str, &str)| Setting { key: key.into(), value: word.into() };
    resolve(method, &settings.iter().map(setting).collect::<Vec<_>>()).unwrap()
}

/// How far a run is from the exact answer: predicted, filtered and smoothed beliefs, and log-likelihoods.
fn error(est: &Estimates, answer: &Answer) -> f64 {
    let row = |k: usize| {
        let log_likelihood = (est.log_likelihood[k] - answer.log_likelihood[k]).abs();
        let predicted = distance(est.predicted_mean(k), est.predicted_cov(k), &answer.predicted[k]);
        let filtered = distance(est.filtered_mean(k), est.filtered_cov(k), &answer.filtered[k]);
        let smoothed = distance(est.mean(k), est.cov(k), &answer.smoothed[k]);
        worst([predicted, filtered, smoothed, log_likelihood].into_iter())
    };
    worst((0..est.len()).map(row))
}

/// The same method with a tolerance far below what the tests ask, where its solver has one.
pub fn tight(choice: &Choice, rtol: f64) -> Choice {
    let mut tight = *choice;
    tight.integrator.tolerance = Tolerance { rtol, atol: 0.0 };
    tight
}

pub fn adapts(choice: &Choice) -> bool {
    choice.time_update.solves() && choice.integrator.solver.adaptive()
}

proptest! {
    #![proptest_config(cases(6))]

    #[test]
    fn a_method_with_a_tolerance_is_the_exact_filter_and_smoother(
        seed: u64, n in 1usize..=4, q in 1usize..=4, d in 1usize..=3,
    ) {
        let problem = Continuous::random(seed, [n, q, d], 6, 0.0);
        let answer = problem.exact();
        for (name, choice) in continuous_choices(n).iter().filter(|of| adapts(&of.1)) {
            let error = error(&run(&problem, &tight(choice, 1e-10), Goal::Interval), &answer);
            prop_assert!(error < 1e-7, "{name}: {error:e}");
        }
    }

    #[test]
    fn forms_and_updates_make_no_difference_beyond_the_tolerance(
        seed: u64, n in 1usize..=4, q in 1usize..=4, d in 1usize..=3,
    ) {
        let problem = Continuous::random(seed, [n, q, d], 5, 0.1);
        let roots = continuous_choices(n).into_iter().filter(|of| of.1.form == FormName::SquareRoot);
        for (name, choice) in roots {
            let choice = tight(&choice, 1e-9);
            let run = |choice: &Choice| run_or_not_positive(&problem, choice, Goal::Interval);
            let root = run(&choice);
            let covariance = Choice { form: FormName::Covariance, block: Block::Joint, ..choice };
            let other = match choice.block {
                Block::Joint => Choice { block: Block::Separate, ..choice },
                Block::Separate => Choice { block: Block::Joint, ..choice },
            };
            let bound = if adapts(&choice) { 1e-6 } else { 1e-10 };
            for other in [covariance, other] {
                if other.time_update == TimeName::LevelSet && other.form == FormName::Covariance {
                    continue;
                }
                match (&root, run(&other)) {
                    (Ok(a), Ok(b)) => {
                        let apart = apart(a, &b);
                        prop_assert!(apart < bound, "{name} and {:?}: {apart:e}", other.form);
                    }
                    // the state given the next one, whose covariance only the root needs
                    (Err((_, Matrix::Conditional)), _) => {}
                    (root, other) => prop_assert_eq!(root.as_ref().err(), other.as_ref().err(), "{}", name),
                }
            }
        }
    }

    #[test]
    fn to_ask_for_the_past_changes_no_present_of_a_continuous_model(
        seed: u64, n in 1usize..=4, q in 1usize..=4, d in 1usize..=3,
    ) {
        let problem = Continuous::random(seed, [n, q, d], 5, 0.05);
        for (name, choice) in continuous_choices(n) {
            let filter = run(&problem, &choice, Goal::Filter);
            for goal in [Goal::Interval, Goal::Lag(2), Goal::Point(0.0)] {
                let Some(est) = run_if_any(&problem, &choice, goal) else { continue };
                prop_assert_eq!(&est.filtered_mean, &filter.mean, "{} {:?}", name, goal);
                prop_assert_eq!(&est.filtered_cov, &filter.cov, "{} {:?}", name, goal);
                prop_assert_eq!(&est.log_likelihood, &filter.log_likelihood);
            }
        }
    }

    #[test]
    fn a_lag_of_a_continuous_model_is_a_point_begun_that_long_ago(
        seed: u64, n in 1usize..=4, q in 1usize..=4, lag in 0usize..=5,
    ) {
        let problem = Continuous::random(seed, [n, q, 2], 5, 0.05);
        for (name, choice) in continuous_choices(n) {
            let Some(lagged) = run_if_any(&problem, &choice, Goal::Lag(lag)) else { continue };
            for (k, &t) in problem.times.iter().enumerate() {
                let Some(point) = run_if_any(&problem, &choice, Goal::Point(t)) else { continue };
                // row k knows the rows up to k + lag, as far as there are any
                let known = lag.min(4 - k);
                let of = |est: &Estimates, row: usize| (est.mean(row).to_vec(), est.cov(row).to_vec());
                let ((m, p), (mean, cov)) = (of(&lagged, k), of(&point, known));
                let error = givens_tests::mean_error(&m, &mean, &cov);
                let error = error.max(givens_tests::cov_error(&p, &cov, n));
                prop_assert!(error < 1e-9, "{name}, row {k}: {error:e}");
            }
        }
    }
}

/// The orders at which the error of filter and smoother shrinks as the steps of the gaps do, from M to 2 M.
fn order(problem: &Continuous, choice: &Choice, m: usize) -> f64 {
    let answer = problem.exact();
    let error = |m: usize| {
        let mut choice = *choice;
        choice.integrator.steps = Steps::Count(m);
        error(&run(problem, &choice, Goal::Interval), &answer)
    };
    (error(m) / error(2 * m)).log2()
}

#[test]
fn equal_steps_converge_at_their_order() {
    let problem = Continuous::random(2, [3, 2, 2], 6, 0.0);
    for form in ["covariance", "square-root"] {
        for rule in ["cubature3", "cubature5", "unscented", "gauss-hermite", "central-difference", "taylor"] {
            let of = |time, more: &[(&str, &str)]| {
                let mut settings = vec![("form", form), ("rule", rule), ("time_update", time)];
                settings.extend(more);
                with("cd-ckf", &settings)
            };
            let mut all = vec![
                (of("ito-taylor", &[("variant", "full")]), 32, 2.0),
                (of("ito-taylor", &[("variant", "simplified")]), 32, 2.0),
                (of("euler-maruyama", &[]), 64, 1.0),
                (of("moment-ode", &[("solver", "euler")]), 128, 1.0),
                (of("moment-ode", &[("solver", "rk2")]), 32, 2.0),
                (of("moment-ode", &[("solver", "rk4")]), 16, 4.0),
            ];
            if form == "square-root" && rule == "cubature3" {
                for velocity in ["standard", "averaged-printed", "averaged", "partial", "cubature"] {
                    for gauge in ["free", "triangular"] {
                        let parts = |solver| [("solver", solver), ("velocity", velocity), ("gauge", gauge)];
                        all.push((of("level-set", &parts("rk2")), 64, 2.0));
                        // the root of what a gap leaves unknown takes finer steps to come to its order
                        all.push((of("level-set", &parts("rk4")), 64, 4.0));
                    }
                }
            }
            for (choice, m, expected) in all {
                let order = order(&problem, &choice, m);
                assert!(
                    (order - expected).abs() < 0.25,
                    "{rule} {form} {:?}: order {order}",
                    choice.time_options()
                );
            }
        }
    }
}

#[test]
fn noise_once_does_not_converge() {
    let problem = Continuous::random(2, [3, 2, 2], 6, 0.0);
    let answer = problem.exact();
    for m in [16, 256] {
        let mut choice = with("sr-cd-ckf", &[("variant", "noise-once")]);
        choice.integrator.steps = Steps::Count(m);
        assert!(choice.variant == Variant::NoiseOnce);
        let error = error(&run(&problem, &choice, Goal::Interval), &answer);
        assert!(error > 1e-3, "{m} steps: {error:e}");
    }
}

#[test]
fn the_stiff_solver_agrees_with_the_others() {
    let problem = Continuous::random(5, [3, 3, 2], 4, 0.1);
    for method in ["cd-ekf", "sr-cd-ekf", "cd-ckf2", "sr-cd-ckf2", "cd-ghkf2", "lskf"] {
        let choice = tight(&with(method, &[]), 1e-9);
        let mut stiff = choice;
        stiff.integrator.solver = Solver::Rodas4;
        let [a, b] = [choice, stiff].map(|choice| run(&problem, &choice, Goal::Interval));
        let apart = apart(&a, &b);
        assert!(apart < 1e-6, "{method}: {apart:e}");
    }
}

#[test]
fn a_longest_step_is_that_many_substeps() {
    let mut problem = Continuous::random(5, [3, 2, 2], 4, 0.1);
    problem.times = vec![0.0, 0.5, 1.0, 1.5];
    for method in ["cd-ckf", "sr-cd-ckf1"] {
        let count = run(&problem, &with(method, &[("substeps", "5")]), Goal::Interval);
        let longest = run(&problem, &with(method, &[("max_step", "0.1")]), Goal::Interval);
        assert!(apart(&count, &longest) < 1e-12, "{method}");
    }
}

#[test]
fn a_method_of_the_other_kind_fails_and_names_its_counterpart() {
    let (continuous, discrete) = (Continuous::random(1, [2, 1, 1], 3, 0.0), Problem::random(1, 2, 1, 3, 0.0));
    let mismatch = |fault| matches!(fault, Fault::Mismatch { .. });
    for (name, choice) in choices(2) {
        let (row, error) = continuous.run(&choice, Goal::Filter).failure.unwrap();
        assert!(row == 0 && mismatch(error.fault), "{name}: {error}");
    }
    for (name, choice) in continuous_choices(2) {
        let (model, sensor) = (&discrete.model, &discrete.sensor);
        let outcome = choice.run(model, sensor, discrete.rows(), 0.0, &discrete.prior(), Goal::Filter, &[]);
        let (row, error) = outcome.failure.unwrap();
        assert!(row == 0 && mismatch(error.fault), "{name}: {error}");
    }
    for entry in ENTRIES {
        let choice = resolve(entry.name, &[]).unwrap();
        let other = if entry.kind() == Kind::Discrete { Kind::Continuous } else { Kind::Discrete };
        assert!(choice.serves(entry.kind()).is_ok());
        let text = choice.serves(other).unwrap_err().to_string();
        let counterpart = choice.counterpart();
        assert!(counterpart.is_none_or(|name| text.contains(name)), "{text}");
        assert_eq!(
            counterpart.is_none(),
            entry.name.ends_with("cdkf") || entry.name.ends_with("ckf5"),
            "{text}"
        );
    }
}
