//! Stepping a filter by hand: the same as a run, for every type of method, and with the smoothers of the core.

use givens::filter::{
    Block, Cdkf, Ckf, Ckf5, Ekf, Filter, Form, Over, Prior, Qkf, Sizes, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf,
    SrUkf, Ukf,
};
use givens::registry::{ENTRIES, Kind, resolve};
use givens::rule::Rule;
use givens::smoother::{FixedPoint, History};
use givens::{Estimates, Goal};
use givens_tests::models::{Motion, Problem};

type Own<'m, X> = Filter<'m, X, Motion, f64, Vec<f64>>;

/// The filter of a problem in memory of exactly its length.
fn start<X: Over<Motion>>(method: X, problem: &Problem, smoothing: bool) -> Own<'_, X> {
    let shape = method.rule().shape(problem.mean.len());
    let sizes = Sizes::of_model(&problem.model, shape).with_sensor(&problem.sensor, shape);
    let memory = vec![0.0; Own::<X>::memory_len(&method, sizes, smoothing)];
    let prior = problem.prior();
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
    Filter::start_in(method, &problem.model, sizes, smoothing, prior, memory).unwrap()
}

fn present(z: &[f64]) -> Vec<bool> {
    z.iter().map(|z| !z.is_nan()).collect()
}

/// Calls `check` for every type of method with its registry name.
macro_rules! every_type {
    ($check:ident: $($name:literal $type:ident)*) => {
        let discrete = ENTRIES.iter().filter(|entry| entry.kind() == Kind::Discrete).count();
        assert_eq!(discrete, [$($name),*].len(), "a method of the registry has no type here");
        $($check($name, $type::default());)*
    };
    ($check:ident) => {
        every_type! { $check:
            "ekf" Ekf "ukf" Ukf "cdkf" Cdkf "qkf" Qkf "ckf" Ckf "ckf5" Ckf5
            "sr-ekf" SrEkf "sr-ukf" SrUkf "sr-cdkf" SrCdkf "sr-qkf" SrQkf "sr-ckf" SrCkf "sr-ckf5" SrCkf5
        }
    };
}

fn problem() -> Problem {
    Problem::random(11, 4, 3, 7, 0.05)
}

/// Any entry of the registry, run over the problem.
fn run(name: &str, problem: &Problem, goal: Goal) -> Estimates {
    crate::run(&resolve(name, &[]).unwrap(), problem, goal)
}

fn steps_like_the_registry<X: Over<Motion>>(name: &str, method: X) {
    let problem = problem();
    let est = run(name, &problem, Goal::Filter);
    let mut filter = start(method, &problem, false);
    for (k, row) in problem.rows().enumerate() {
        filter.predict(row.time).unwrap();
        assert_eq!(filter.mean(), est.predicted_mean(k), "{name}, row {k}");
        assert_eq!(filter.cov(), est.predicted_cov(k), "{name}, row {k}");
        filter.update_present(&problem.sensor, row.z, &present(row.z)).unwrap();
        assert_eq!(filter.mean(), est.mean(k), "{name}, row {k}");
        assert_eq!(filter.cov(), est.cov(k), "{name}, row {k}");
        assert_eq!(filter.innovation().log_likelihood, est.log_likelihood[k], "{name}, row {k}");
    }
}

#[test]
fn stepping_a_type_by_hand_is_a_run_of_its_registry_name() {
    every_type!(steps_like_the_registry);
}

#[test]
fn the_separate_update_by_hand_is_the_option_of_the_registry() {
    let (problem, update) = (problem(), Block::Separate);
    let setting = givens::registry::Setting { key: "update".into(), value: "separate".into() };
    let est = crate::run(&resolve("sr-ckf", &[setting]).unwrap(), &problem, Goal::Filter);
    let mut filter = start(SrCkf { update }, &problem, false);
    for (k, row) in problem.rows().enumerate() {
        filter.predict(row.time).unwrap();
        filter.update_present(&problem.sensor, row.z, &present(row.z)).unwrap();
        assert_eq!(filter.cov(), est.cov(k), "row {k}");
    }
}

fn smooths_like_the_registry<X: Over<Motion>>(name: &str, method: X) {
    let (problem, square_root) = (problem(), X::Form::SQUARE_ROOT);
    let n = problem.mean.len();
    let est = run(name, &problem, Goal::Interval);
    let mut filter = start(method, &problem, true);
    let rows = problem.z.len();
    let memory = vec![0.0; History::<f64, Vec<f64>>::memory_len(n, rows)];
    let mut history = History::new(n, square_root, memory);
    let point = vec![0.0; FixedPoint::<f64, Vec<f64>>::memory_len(n)];
    let mut second = start(method, &problem, true);
    let mut point = FixedPoint::begin(&mut second, point).unwrap();
    for row in problem.rows() {
        history.predict(&mut filter, row.time).unwrap();
        filter.update_present(&problem.sensor, row.z, &present(row.z)).unwrap();
        point.predict(&mut second, row.time).unwrap();
        second.update_present(&problem.sensor, row.z, &present(row.z)).unwrap();
        point.update(&second).unwrap();
    }
    assert_eq!(history.len(), rows);
    let close = |x: &[f64], y: &[f64]| x.iter().zip(y).all(|(x, y)| (x - y).abs() < 1e-11);
    history
        .smooth(&filter, rows, |age, smoothed| {
            let belief = &smoothed.belief;
            if age < rows {
                assert_eq!(belief.mean, est.mean(rows - 1 - age), "{name}, {age} rows ago");
            } else {
                // the prior itself, given all rows
                assert!(close(belief.mean, point.mean()), "{name}: fixed point");
                let mut cov = vec![0.0; n * n];
                givens::kernels::square(&mut cov, n, belief.factor, n, n);
                assert!(close(&cov, point.cov()), "{name}: fixed point");
            }
        })
        .unwrap();
}

#[test]
fn the_smoothers_of_the_core_by_hand_are_those_of_a_run() {
    every_type!(smooths_like_the_registry);
}

fn means_alone<X: Over<Motion>>(name: &str, method: X) {
    let problem = problem();
    let est = run(name, &problem, Goal::Interval);
    let mut filter = start(method, &problem, true);
    let (n, rows, mut records) = (problem.mean.len(), problem.z.len(), Vec::new());
    let memory = vec![0.0; History::<f64, Vec<f64>>::memory_len(n, rows)];
    let mut history = History::new(n, X::Form::SQUARE_ROOT, memory);
    for row in problem.rows() {
        let mean = filter.mean().to_vec();
        history.predict(&mut filter, row.time).unwrap();
        records.push((mean, filter.mean().to_vec(), filter.backward().0.to_vec()));
        filter.update_present(&problem.sensor, row.z, &present(row.z)).unwrap();
    }
    let mut smoothed = filter.mean().to_vec();
    for (k, (mean, predicted_mean, gain)) in records.iter().enumerate().skip(1).rev() {
        if X::Form::SQUARE_ROOT {
            // its records tell of the coordinates of the roots
            break;
        }
        let change: Vec<f64> = smoothed.iter().zip(predicted_mean).map(|(s, m)| s - m).collect();
        for (i, s) in smoothed.iter_mut().enumerate() {
            *s = mean[i] + gain[i * n..(i + 1) * n].iter().zip(&change).map(|(g, c)| g * c).sum::<f64>();
        }
        assert!(
            givens_tests::mean_error(&smoothed, est.mean(k - 1), est.cov(k - 1)) < 1e-12,
            "{name}, row {}",
            k - 1
        );
    }
    let check =
        |age: usize, mean: &[f64]| assert_eq!(mean, est.mean(rows - 1 - age), "{name}, {age} rows ago");
    history.smooth_means(&filter, rows - 1, check).unwrap();
}

#[test]
fn the_mean_only_way_back_gives_the_smoothed_means() {
    every_type!(means_alone);
}

fn stands_still<X: Over<Motion>>(name: &str, method: X) {
    let problem = problem();
    let mut filter = start(method, &problem, true);
    filter.predict(1.0).unwrap();
    let before = (filter.mean().to_vec(), filter.cov());
    filter.predict(1.0).unwrap();
    assert_eq!((filter.mean().to_vec(), filter.cov()), before, "{name}");
    let (gain, conditional) = filter.backward();
    assert!(gain.iter().enumerate().all(|(i, &g)| g == f64::from(u8::from(i % 5 == 0))), "{name}");
    assert!(conditional.iter().all(|&x| x == 0.0), "{name}");
    // and a measurement of nothing
    filter.update_present(&problem.sensor, &[f64::NAN; 3], &[false; 3]).unwrap();
    assert_eq!((filter.mean().to_vec(), filter.cov()), before, "{name}");
    assert_eq!((filter.innovation().nu.len(), filter.innovation().log_likelihood), (0, 0.0), "{name}");
}

#[test]
fn no_time_and_no_measurement_change_nothing() {
    every_type!(stands_still);
}

fn factor_is_lower<X: Over<Motion>>(name: &str, method: X) {
    let problem = problem();
    let n = problem.mean.len();
    let mut filter = start(method, &problem, false);
    let check = |filter: &Own<'_, X>| {
        let (s, cov) = (filter.factor(), filter.cov());
        let mut square = vec![0.0; n * n];
        givens::kernels::square(&mut square, n, s, n, n);
        assert!(
            (0..n).all(|i| s[i * (n + 1)] >= 0.0 && s[i * n + i + 1..(i + 1) * n].iter().all(|&x| x == 0.0))
        );
        assert!(givens_tests::cov_error(&square, &cov, n) < 1e-14, "{name}");
    };
    for row in problem.rows() {
        filter.predict(row.time).unwrap();
        check(&filter);
        filter.update_present(&problem.sensor, row.z, &present(row.z)).unwrap();
        check(&filter);
    }
}

#[test]
fn the_factor_is_lower_triangular_with_a_diagonal_of_zero_or_more() {
    every_type!(factor_is_lower);
}
