//! The gate's limits: where they lie, that nothing changes where nothing is beyond them, and what is no probability.

use super::streamed::data;
use core::ops::ControlFlow;
use givens::batch::{Batch, Track};
use givens::filter::{Fault, StepError};
use givens::registry::{Choice, Setting, resolve};
use givens::{Draws, Estimates, Finished, Goal, Stream};
use givens_tests::choices::choices;
use givens_tests::models::{Normals, Problem};

/// scipy 1.17.1: `chi2.ppf(0.9999, k)` and `chi2.ppf(0.99, k)` for k = 1, 2, 3.
const QUANTILES: [(f64, [f64; 3]); 2] = [
    (0.9999, [15.136_705_226_623_606, 18.420_680_743_952_584, 21.107_513_466_160_444]),
    (0.99, [6.634_896_601_021_214_5, 9.210_340_371_976_18, 11.344_866_730_144_373]),
];

#[test]
fn the_rows_beyond_are_those_of_a_kalman_filter_by_plain_algebra() {
    let mut problem = Problem::random(44, 4, 3, 200, 0.0);
    // outliers of no more than nine standard deviations of the measurement's own noise, in every other row
    let mut normals = Normals::new(45);
    for (k, z) in problem.z.iter_mut().enumerate() {
        let off = normals.vector(3);
        for i in (0..3).filter(|_| k % 2 == 0) {
            z[i] += 3.0 * off[i].clamp(-3.0, 3.0) * problem.sensor.r[(i, i)].sqrt();
        }
    }
    for (gate, quantiles) in QUANTILES {
        let (expected, margin) = problem.beyond(&quantiles);
        let count = expected.iter().filter(|gated| **gated).count();
        assert!(count > 20 && count < 100 && margin > 1e-6, "{count} {margin:e}");
        for name in ["sr-ckf", "ckf", "sr-ukf", "sr-ekf", "sr-cdkf", "sr-qkf"] {
            let choice = Choice { gate: Some(gate), ..resolve(name, &[]).unwrap() };
            let (model, sensor, prior) = (&problem.model, &problem.sensor, &problem.prior());
            let est = choice.run(model, sensor, problem.rows(), 0.0, prior, Goal::Filter, &[]).estimates;
            assert_eq!(est.gated, expected, "{name}, {gate}");
        }
    }
}

#[test]
fn a_gate_that_nothing_is_beyond_changes_no_number() {
    let problem = Problem::random(46, 3, 2, 31, 0.05);
    let (model, sensor, prior) = (&problem.model, &problem.sensor, &problem.prior());
    let run = |choice: Choice| {
        let outcome = choice.run(model, sensor, problem.rows(), 0.0, prior, Goal::Interval, &[]);
        outcome.into_result().unwrap()
    };
    for (name, choice) in choices(3) {
        let (open, none) = (run(Choice { gate: Some(1.0 - 1e-15), ..choice }), run(choice));
        let array = |est: &Estimates| {
            let all = [est.mean.as_slice(), &est.factor, &est.nis, &est.log_likelihood].concat();
            all.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
        };
        assert!(array(&open) == array(&none), "{name}");
        assert!(open.gated.iter().chain(&none.gated).all(|gated| !gated), "{name}");
    }
}

#[test]
fn what_is_no_probability_is_refused_with_its_range() {
    let range = "must be a probability above 0 and below 1, such as 0.9999";
    for (text, words) in [
        ("0", format!("gate = 0: {range}")),
        ("1", format!("gate = 1: {range}")),
        ("-1", format!("gate = -1: {range}")),
        ("1.5", format!("gate = 1.5: {range}")),
        ("NaN", "gate = NaN: must be a number".to_owned()),
        ("inf", "gate = inf: must be a number".to_owned()),
        ("on", "gate = on: must be a number".to_owned()),
    ] {
        let setting = Setting { key: "gate".into(), value: text.into() };
        assert_eq!(resolve("sr-ckf", &[setting]).unwrap_err().to_string(), words);
    }
    // a choice that was made by hand is refused where it begins
    let problem = Problem::random(47, 2, 1, 3, 0.0);
    let (model, sensor, prior) = (&problem.model, &problem.sensor, &problem.prior());
    let data = data(problem.rows(), 1, 0);
    let track = Track::new(model, sensor, &data, prior);
    for gate in [0.0, 1.0, -1.0, 1.5, f64::NAN, f64::INFINITY] {
        let choice = Choice { gate: Some(gate), ..resolve("sr-ckf", &[]).unwrap() };
        let wrong = |fault: Fault| matches!(fault, Fault::Option(error) if error.option == "gate");
        let first = |failure: Option<(usize, StepError)>| {
            failure.is_some_and(|(row, error)| row == 0 && wrong(error.fault))
        };
        assert!(choice.check(2).is_err_and(|error| error.option == "gate"), "{gate}");
        assert!(
            first(choice.run(model, sensor, problem.rows(), 0.0, prior, Goal::Filter, &[]).failure),
            "{gate}"
        );
        let outcomes = choice.run_batch(&[track, track], &Batch::default());
        assert!(outcomes.into_iter().all(|outcome| first(outcome.unwrap().failure)), "{gate}");
        let ended = choice.stream(&track, &Stream::default(), &mut |_: Finished| ControlFlow::Continue(()));
        assert!(first(ended.failure), "{gate}");
        assert!(choice.start(model, sensor, 0.0, prior).is_err_and(|error| wrong(error.fault)), "{gate}");
        let draws = Draws { count: 1, seed: 1, track: 0 };
        let drawn = choice.sample(model, sensor, problem.rows(), 0.0, prior, draws);
        assert!(drawn.is_err_and(|failure| wrong(failure.error.fault)), "{gate}");
    }
}
