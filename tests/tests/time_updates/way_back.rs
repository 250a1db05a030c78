//! The way back of the solvers, and of times between rows.

use crate::drift::with;
use givens::filter::{Fault, Gaussian};
use givens::model::zoo::{Components, OrnsteinUhlenbeck};
use givens::registry::Choice;
use givens::{Data, Goal, Outcome};
use givens_tests::sde::Continuous;

const SENSOR: Components<1> = Components { states: 1, which: [0], std: [0.1] };

/// A first row without measure at 0, from which the way back ends, and z = 1 after a gap.
fn smoothed(choice: &Choice, rate: f64, gap: f64) -> Outcome {
    let model = OrnsteinUhlenbeck { rate, ..OrnsteinUhlenbeck::default() };
    let prior = Gaussian::from_std(&[0.0], &[(0.5 / rate).sqrt()]).unwrap();
    let mut data = Data::new(1).starting_at(0.0);
    data.push(0.0, &[f64::NAN]).unwrap();
    data.push(gap, &[1.0]).unwrap();
    choice.run_continuous(&model, &SENSOR, data.rows(), 0.0, &prior, Goal::Interval, &[])
}

const METHODS: [&str; 8] =
    ["cd-ckf2", "cd-ekf", "cd-ukf2", "sr-cd-ckf2", "sr-cd-ekf", "sr-cd-ukf2", "sr-cd-ghkf2", "lskf"];

/// Where the prior is that of the long run, a filter's moments stand still, and say nothing of how long a step may be.
#[test]
fn a_belief_that_stands_still_is_smoothed_right() {
    for (solver, rate) in [("dp5", 1.0_f64), ("rodas4", 1.0), ("rodas4", 1000.0)] {
        for gap in [0.5 / rate, 2.0 / rate, 5.0 / rate, 0.5, 5.0, 30.0] {
            let variance = 0.5 / rate;
            // Cov[x(0), x(gap)] over the variance of the measure
            let gain = variance * (-rate * gap).exp() / (variance + 0.01);
            let (mean, cov) = (gain, variance - gain * variance * (-rate * gap).exp());
            for method in METHODS {
                let est = smoothed(&with(method, &[("solver", solver)]), rate, gap).into_result().unwrap();
                let apart = (est.mean(0)[0] - mean).abs() / cov.sqrt();
                let spread = (est.cov(0)[0] / cov - 1.0).abs();
                let what = format!("{method} {solver}, rate {rate}, gap {gap}: {apart:e}, {spread:e}");
                assert!(apart < 1e-5 && spread < 1e-5, "{what}");
            }
        }
    }
}

#[test]
fn equal_steps_too_long_for_the_way_back_are_refused() {
    for method in ["cd-ckf2", "sr-cd-ckf2", "lskf"] {
        let outcome = smoothed(&with(method, &[("solver", "rk4"), ("substeps", "4")]), 1.0, 30.0);
        let fault = outcome.failure.unwrap().1.fault;
        assert!(matches!(fault, Fault::Unresolved { component: 0 }), "{method}: {fault}");
    }
}

/// However coarse the steps are, and so however far two steps are from one.
#[test]
fn both_forms_give_the_same_between_the_rows() {
    for seed in 0..6 {
        let problem = Continuous::random(seed, [3, 3, 1], 6, 0.4);
        let middles: Vec<f64> = problem.times.windows(2).map(|gap| 0.5 * (gap[0] + gap[1])).collect();
        for (cov, root) in [("cd-ckf", "sr-cd-ckf"), ("cd-ckf2", "sr-cd-ckf2"), ("cd-ekf", "sr-cd-ekf")] {
            for substeps in ["1", "4"] {
                let equal = cov == "cd-ckf";
                let (solver, bound) =
                    if equal { (("substeps", substeps), 1e-11) } else { (("rtol", "1e-9"), 1e-8) };
                let [a, b] = [cov, root].map(|method| {
                    let (choice, prior) = (with(method, &[solver]), problem.prior());
                    let (model, sensor) = (&problem.model, &problem.sensor);
                    let rows = problem.rows();
                    choice.run_continuous(model, sensor, rows, 0.0, &prior, Goal::Interval, &middles).at
                });
                for k in 0..middles.len() {
                    for i in 0..3 {
                        let apart = (a.mean(k)[i] - b.mean(k)[i]).abs() / a.std(k, i);
                        let spread = (a.cov(k)[4 * i] / b.cov(k)[4 * i] - 1.0).abs();
                        let what = format!("{root} {substeps}, time {k}: {apart:e}, {spread:e}");
                        assert!(apart < bound && spread < bound, "{what}");
                    }
                }
            }
        }
    }
}
