//! Methods that are one method, and questions that are one question.

use crate::{apart, run};
use givens::Goal;
use givens::model::{At, Noise, Observation};
use givens::registry::{Choice, FormName, Setting, Value, resolve};
use givens::scalar::Real;
use givens_tests::cases;
use givens_tests::choices::{choices, counterparts};
use givens_tests::models::{Normals, Problem, Sensor};
use givens_tests::{cov_error, mean_error};
use proptest::prelude::*;

fn with(name: &str, settings: &[(&str, f64)]) -> Choice {
    let number = |&(key, x): &(&str, f64)| Setting { key: key.into(), value: Value::Number(x) };
    resolve(name, &settings.iter().map(number).collect::<Vec<_>>()).unwrap()
}

proptest! {
    #![proptest_config(cases(12))]

    #[test]
    fn the_form_and_the_update_make_no_difference(seed: u64, n in 1usize..=6, d in 1usize..=4) {
        let problem = Problem::random(seed, n, d, 6, 0.05);
        for (name, choice) in choices(n).into_iter().filter(|of| of.1.form == FormName::SquareRoot) {
            let est = run(&choice, &problem, Goal::Interval);
            for other in counterparts(&choice) {
                let apart = apart(&est, &run(&other, &problem, Goal::Interval));
                prop_assert!(apart < 1e-10, "{name} and {other:?}: {apart:e}");
            }
        }
    }

    #[test]
    fn with_three_states_the_plain_unscented_rule_is_cubature(seed: u64, d in 1usize..=4) {
        let problem = Problem::random(seed, 3, d, 6, 0.1);
        for (ukf, ckf) in [("ukf", "ckf"), ("sr-ukf", "sr-ckf")] {
            let both = [ukf, ckf].map(|name| run(&with(name, &[]), &problem, Goal::Interval));
            prop_assert!(apart(&both[0], &both[1]) < 1e-12, "{ukf}");
        }
    }

    #[test]
    fn the_scaled_unscented_rule_without_scaling_is_cubature(seed: u64, n in 1usize..=6, d in 1usize..=4) {
        let problem = Problem::random(seed, n, d, 6, 0.1);
        for (ukf, ckf) in [("ukf", "ckf"), ("sr-ukf", "sr-ckf")] {
            let ukf = with(ukf, &[("alpha", 1.0), ("beta", 0.0), ("kappa", 0.0)]);
            let apart =
                apart(&run(&ukf, &problem, Goal::Interval), &run(&with(ckf, &[]), &problem, Goal::Interval));
            prop_assert!(apart < 1e-12, "{ckf}: {apart:e}");
        }
    }

    #[test]
    fn a_missing_component_is_a_sensor_without_it(seed: u64, n in 1usize..=6, d in 2usize..=4, lost: usize) {
        let (mut problem, lost) = (Problem::random(seed, n, d, 6, 0.05), lost % d);
        problem.z.iter_mut().for_each(|z| z[lost] = f64::NAN);
        let mut without = problem.clone();
        without.sensor = problem.sensor.only(&(0..d).filter(|&i| i != lost).collect::<Vec<_>>());
        for z in &mut without.z {
            z.remove(lost);
        }
        for (name, choice) in choices(n) {
            let (a, b) = (run(&choice, &problem, Goal::Interval), run(&choice, &without, Goal::Interval));
            for k in 0..a.len() {
                let error = mean_error(a.mean(k), b.mean(k), b.cov(k)).max(cov_error(a.cov(k), b.cov(k), n));
                let scores = (a.log_likelihood[k] - b.log_likelihood[k]).abs();
                prop_assert!(error.max(scores) < 1e-11, "{name}, row {k}: {error:e}, {scores:e}");
                prop_assert_eq!(a.nis_dof[k], b.nis_dof[k]);
            }
        }
    }

    #[test]
    fn a_tuple_of_sensors_is_their_stack(seed: u64, n in 1usize..=6, d in 2usize..=4, cut: usize) {
        let cut = 1 + cut % (d - 1);
        let mut problem = Problem::random(seed, n, d, 6, 0.05);
        // sensors do not share their noise
        for i in 0..d {
            for j in 0..d {
                if (i < cut) != (j < cut) {
                    problem.sensor.r[(i, j)] = 0.0;
                }
            }
        }
        let both = (
            problem.sensor.only(&(0..cut).collect::<Vec<_>>()),
            problem.sensor.only(&(cut..d).collect::<Vec<_>>()),
        );
        for (name, choice) in choices(n) {
            let stacked = run(&choice, &problem, Goal::Interval);
            let tuple = choice.run(&problem.model, &both, problem.rows(), 0.0, &problem.prior(), Goal::Interval, &[]);
            let apart = apart(&tuple.into_result().unwrap(), &stacked);
            prop_assert!(apart < 1e-12, "{name}: {apart:e}");
        }
    }
}

/// Where a point stands on a circle, with the turn of the circle added that the data may count or not.
struct Compass {
    sensor: Sensor,
    period: f64,
}

impl Observation for Compass {
    fn states(&self) -> usize {
        self.sensor.states()
    }
    fn measures(&self) -> usize {
        2
    }
    fn angle(&self, i: usize) -> Option<f64> {
        (i == 0).then_some(self.period)
    }
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.sensor.observe(at, x, out);
        // beside the cut, so that some points fall on its other side
        let angle = (T::of(0.3) * out[0]).atan2(T::of(-2.0));
        out[0] = angle * T::of(self.period / std::f64::consts::TAU);
    }
    fn noise(&self) -> Noise {
        self.sensor.noise()
    }
    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        self.sensor.measurement_noise(at, out);
    }
}

#[test]
fn whole_turns_of_an_angle_make_no_difference() {
    let mut problem = Problem::random(5, 4, 2, 8, 0.05);
    problem.cov /= 10.0;
    let compass = Compass { sensor: problem.sensor.clone(), period: 360.0 };
    let mut normals = Normals::new(7);
    problem.z = (0..8).map(|_| vec![180.0 + 5.0 * normals.vector(1)[0], normals.vector(1)[0]]).collect();
    problem.z[3][1] = f64::NAN;
    let mut turned = problem.clone();
    for (k, z) in turned.z.iter_mut().enumerate() {
        z[0] += 360.0 * (k as f64 - 3.0);
    }
    for (name, choice) in choices(4) {
        let est = [&problem, &turned].map(|of| {
            let outcome = choice.run(&of.model, &compass, of.rows(), 0.0, &of.prior(), Goal::Interval, &[]);
            outcome.into_result().unwrap()
        });
        let apart = apart(&est[0], &est[1]);
        assert!(apart < 1e-11, "{name}: {apart:e}");
        assert!(est[0].innovation.iter().step_by(2).all(|nu| nu.abs() <= 180.0), "{name}");
    }
}
