//! A filter whose method was chosen at run time, stepped by hand: the numbers of a run, to the bit.

use givens::filter::Fault;
use givens::registry::{AnyFilter, Choice, resolve};
use givens::{Estimates, Goal, Row};
use givens_tests::choices::{choices, continuous_choices};
use givens_tests::models::Problem;
use givens_tests::sde::Continuous;

/// Bits, so that NaN is equal to itself.
fn bits(of: &[f64]) -> Vec<u64> {
    of.iter().map(|x| x.to_bits()).collect()
}

fn steps_like<'a>(name: &str, mut f: AnyFilter<'_>, rows: impl Iterator<Item = Row<'a>>, est: &Estimates) {
    for (k, row) in rows.enumerate() {
        f.predict(row.time).unwrap();
        assert_eq!(bits(f.mean()), bits(est.predicted_mean(k)), "{name}, row {k}");
        assert_eq!(bits(&f.cov()), bits(est.predicted_cov(k)), "{name}, row {k}");
        f.update(row.z).unwrap();
        let (nu, cov) = f.whole_innovation();
        let found = [f.mean(), &f.cov(), &nu, &cov, &[f.nis(), f.log_likelihood()]].concat();
        let scores = [est.nis[k], est.log_likelihood[k]];
        let expected = [est.mean(k), est.cov(k), est.innovation(k), est.innovation_cov(k), &scores].concat();
        assert_eq!(bits(&found), bits(&expected), "{name}, row {k}");
        assert_eq!((f.dof(), f.time()), (est.nis_dof[k], row.time), "{name}, row {k}");
    }
}

#[test]
fn every_discrete_choice_by_hand_is_its_run() {
    let problem = Problem::random(31, 3, 2, 6, 0.1);
    for (name, choice) in choices(3) {
        let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
        let est = choice.run(model, sensor, problem.rows(), 0.0, &prior, Goal::Filter, &[]);
        let f = choice.start(model, sensor, 0.0, &prior).unwrap();
        steps_like(&name, f, problem.rows(), &est.into_result().unwrap());
    }
}

#[test]
fn every_continuous_choice_by_hand_is_its_run() {
    let problem = Continuous::random(32, [3, 2, 2], 4, 0.3);
    for (name, choice) in continuous_choices(3) {
        let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
        let est = choice.run_continuous(model, sensor, problem.rows(), 0.0, &prior, Goal::Filter, &[]);
        let f = choice.start_continuous(model, sensor, 0.0, &prior).unwrap();
        steps_like(&name, f, problem.rows(), &est.into_result().unwrap());
    }
}

fn discrete() -> (Problem, Choice) {
    (Problem::random(33, 2, 2, 1, 0.0), resolve("sr-ckf", &[]).unwrap())
}

#[test]
fn a_refused_measurement_leaves_the_belief_and_no_innovation() {
    let (problem, choice) = discrete();
    let mut f = choice.start(&problem.model, &problem.sensor, 0.0, &problem.prior()).unwrap();
    f.update(&[0.1, 0.2]).unwrap();
    assert_eq!((f.dof(), f.present()), (2, [true, true].as_slice()));
    let before = [f.mean(), f.factor()].concat();
    let short = f.update(&[0.1]).unwrap_err().fault;
    assert_eq!(short, Fault::Length { of: "measurement", expected: 2, found: 1 });
    assert!(matches!(
        f.update(&[0.1, f64::INFINITY]).unwrap_err().fault,
        Fault::NotFinite { component: 1, .. }
    ));
    assert!(matches!(f.update(&[0.1, 0.2, 0.3]).unwrap_err().fault, Fault::Length { .. }));
    assert_eq!((f.dof(), f.present()), (0, [false, false].as_slice()));
    assert!(f.nis().is_nan() && f.log_likelihood() == 0.0);
    assert_eq!(before, [f.mean(), f.factor()].concat());
}

#[test]
fn a_method_of_the_other_kind_or_a_prior_of_another_length_does_not_start() {
    let (problem, choice) = discrete();
    let flow = Continuous::random(34, [2, 2, 2], 1, 0.0);
    let other = resolve("cd-ckf", &[]).unwrap();
    let refused = other.start(&problem.model, &problem.sensor, 0.0, &problem.prior()).unwrap_err();
    assert!(refused.to_string().contains("continuous-time one"), "{refused}");
    let refused = choice.start_continuous(&flow.model, &flow.sensor, 0.0, &flow.prior()).unwrap_err();
    assert!(refused.to_string().contains("discrete-time one"), "{refused}");
    let three = Problem::random(35, 3, 2, 1, 0.0).prior();
    let refused = choice.start(&problem.model, &problem.sensor, 0.0, &three).unwrap_err().fault;
    assert_eq!(refused, Fault::Length { of: "mean", expected: 2, found: 3 });
}

#[test]
fn a_filter_of_run_time_may_go_to_another_thread() {
    fn moves<T: Send + Sync>(_: &T) {}
    let (problem, choice) = discrete();
    moves(&choice.start(&problem.model, &problem.sensor, 0.0, &problem.prior()).unwrap());
}
