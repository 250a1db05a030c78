//! Every filter and smoother of `golden/discrete.json`, through the library.

use givens::filter::{Block, Gaussian, SrCkf};
use givens::model::zoo::{CoordinatedTurn, RangeBearing};
use givens::model::{At, Noise, Observation, Transition};
use givens::registry::Value::Number;
use givens::registry::{Choice, Setting, resolve};
use givens::scalar::Real;
use givens::{Data, Estimates, Goal, run};
use givens_tests::{cov_error, golden, mean_error, numbers};
use serde_json::Value;

/// Nearly constant velocity along two axes, with the scenario's own Q.
struct ConstantVelocity {
    q: Vec<f64>,
}

impl Transition for ConstantVelocity {
    fn states(&self) -> usize {
        4
    }
    fn period(&self) -> Option<f64> {
        Some(1.0)
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        for i in [0, 2] {
            out[i] = x[i] + at.dt * x[i + 1];
            out[i + 1] = x[i + 1];
        }
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn process_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.iter_mut().zip(&self.q).for_each(|(o, &q)| *o = T::of(q));
    }
}

struct Positions {
    r: Vec<f64>,
}

impl Observation for Positions {
    fn states(&self) -> usize {
        4
    }
    fn measures(&self) -> usize {
        2
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out.copy_from_slice(&[x[0], x[2]]);
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.iter_mut().zip(&self.r).for_each(|(o, &r)| *o = T::of(r));
    }
}

struct Scenario<M, H> {
    golden: Value,
    model: M,
    sensor: H,
    tolerance: f64,
}

impl<M: Transition + Sync, H: Observation + Sync> Scenario<M, H> {
    fn data(&self) -> (Data, Gaussian) {
        let mut data = Data::new(2);
        data.push(0.0, &[f64::NAN; 2]).unwrap();
        for (k, z) in numbers(&self.golden["z"]).chunks_exact(2).enumerate() {
            data.push(k as f64 + 1.0, z).unwrap();
        }
        let prior = Gaussian::from_cov(&numbers(&self.golden["m0"]), &numbers(&self.golden["P0"])).unwrap();
        (data, prior)
    }

    fn run(&self, choice: &Choice, goal: Goal) -> Estimates {
        let (data, prior) = self.data();
        let run = choice.run(&self.model, &self.sensor, data.rows(), 0.0, &prior, goal, &[]);
        run.into_result().unwrap()
    }

    /// Compares rows `at`, `at` + 1, … of an estimate with one of the golden series.
    fn compare(&self, what: &str, series: &Value, at: usize, est: &Estimates, mean: &[f64], cov: &[f64]) {
        let n = est.states();
        let (means, variances) = (numbers(&series["mean"]), numbers(&series["var"]));
        for (k, (expected, var)) in means.chunks_exact(n).zip(variances.chunks_exact(n)).enumerate() {
            let row = k + at;
            let mut diagonal = vec![0.0; n * n];
            (0..n).for_each(|i| diagonal[i * n + i] = var[i]);
            let error = mean_error(&mean[row * n..(row + 1) * n], expected, &diagonal);
            assert!(error < self.tolerance, "{what} mean {k}: {error:e}");
            for i in 0..n {
                let error = (cov[row * n * n + i * n + i] / var[i] - 1.0).abs();
                assert!(error < self.tolerance, "{what} variance {k}: {error:e}");
            }
        }
        for (k, expected) in series["cov"].as_object().unwrap() {
            let row = k.parse::<usize>().unwrap() + at;
            let error = cov_error(&cov[row * n * n..(row + 1) * n * n], &numbers(expected), n);
            assert!(error < self.tolerance, "{what} covariance {k}: {error:e}");
        }
    }

    fn check(&self, name: &str, method: &str, settings: &[(&str, Value)]) {
        let golden = &self.golden["filters"][name];
        let what = |part: &str| format!("{name} ({method} {settings:?}) {part}");
        let setting = |(key, value): &(&str, Value)| Setting {
            key: (*key).into(),
            value: value.as_f64().map_or_else(|| value.as_str().unwrap().into(), Number),
        };
        let choice = resolve(method, &settings.iter().map(setting).collect::<Vec<_>>()).unwrap();
        let est = self.run(&choice, Goal::Interval);
        self.compare(&what("filtered"), &golden["filt"], 0, &est, &est.filtered_mean, &est.filtered_cov);
        self.compare(&what("predicted"), &golden["pred"], 1, &est, &est.predicted_mean, &est.predicted_cov);
        self.compare(&what("smoothed"), &golden["smooth"], 0, &est, &est.mean, &est.cov);
        let log_likelihood = golden["loglik"].as_f64().unwrap();
        let error = (est.total_log_likelihood() - log_likelihood).abs();
        assert!(error < 1e-9, "{}: {error:e}", what("log-likelihood"));
        let lag = self.run(&choice, Goal::Lag(5));
        self.compare(&what("lag 5"), &golden["lag5"], 0, &lag, &lag.mean, &lag.cov);
        let point = self.run(&choice, Goal::Point(5.0));
        self.compare(&what("point 5"), &golden["point5"], 0, &point, &point.mean, &point.cov);
    }

    fn check_all(&self) {
        for (name, method) in [
            ("EKF", "ekf"),
            ("UKF", "ukf"),
            ("CDKF", "cdkf"),
            ("QKF", "qkf"),
            ("CKF", "ckf"),
            ("CKF5", "ckf5"),
        ] {
            self.check(name, method, &[]);
            for update in ["joint", "separate"] {
                self.check(name, &format!("sr-{method}"), &[("update", update.into())]);
            }
        }
        let name = "UKF_a05_b2_k0";
        if !self.golden["filters"][name].is_null() {
            let settings = [("alpha", 0.5.into()), ("beta", 2.0.into()), ("kappa", 0.0.into())];
            self.check(name, "ukf", &settings);
            self.check(name, "sr-ukf", &settings);
        }
    }

    /// The published square-root filters, factor by factor, and the 60-digit truth.
    fn check_factors(&self) {
        let truth = &self.golden["mp_CKF"];
        for (name, update) in [("SCKF2009", Block::Separate), ("SCKF2011", Block::Joint)] {
            let golden = &self.golden["filters"][name];
            let (data, prior) = self.data();
            let run =
                run(SrCkf { update }, &self.model, &self.sensor, data.rows(), 0.0, &prior, Goal::Interval);
            let est = run.into_result().unwrap();
            let n = est.states();
            for (k, factor) in golden["S"].as_object().unwrap() {
                let k: usize = k.parse().unwrap();
                let mut cov = vec![0.0; n * n];
                givens::kernels::square(&mut cov, n, &numbers(factor), n, n);
                assert!(cov_error(est.filtered_cov(k), &cov, n) < self.tolerance, "{name} S {k}");
            }
            for (row, mean) in numbers(&golden["mean"]).chunks_exact(n).enumerate() {
                assert!(mean_error(est.filtered_mean(row), mean, est.filtered_cov(row)) < self.tolerance);
            }
            for (row, mean) in numbers(&truth["smooth_mean"]).chunks_exact(n).enumerate() {
                assert!(
                    mean_error(est.mean(row), mean, est.cov(row)) < self.tolerance,
                    "truth, smoothed {row}"
                );
            }
            assert!(cov_error(est.cov(0), &numbers(&truth["smooth_cov0"]), n) < self.tolerance);
            assert!(cov_error(est.filtered_cov(20), &numbers(&truth["cov20"]), n) < self.tolerance);
        }
    }
}

#[test]
fn the_linear_scenario_agrees_to_1e_11() {
    let golden = golden("discrete.json")["scenarios"]["cv"].take();
    let (q, r) = (numbers(&golden["Q"]), numbers(&golden["R"]));
    let scenario =
        Scenario { golden, model: ConstantVelocity { q }, sensor: Positions { r }, tolerance: 1e-11 };
    scenario.check_all();
    scenario.check_factors();
}

#[test]
fn the_turning_scenario_agrees_to_1e_10() {
    let golden = golden("discrete.json")["scenarios"]["ct"].take();
    let (model, sensor) = (CoordinatedTurn::default(), RangeBearing::published());
    let scenario = Scenario { golden, model, sensor, tolerance: 1e-10 };
    scenario.check_all();
    scenario.check_factors();
}
