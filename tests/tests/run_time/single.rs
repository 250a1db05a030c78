//! Methods in f32: those in f64 to the digits that f32 has, in single runs, smoothers and packs; what f32 cannot keep is refused.

use core::num::NonZeroUsize;
use givens::batch::{Batch, InstructionSet, Track};
use givens::filter::{Fault, Gaussian, Quantity};
use givens::model::zoo::{CoordinatedTurn, RangeBearing};
use givens::registry::{Choice, FormName, Precision, Setting, Value, resolve};
use givens::{Data, Estimates, Goal, Outcome, Row};
use givens_tests::choices::{choices, continuous_choices};
use givens_tests::models::Problem;
use givens_tests::sde::Continuous;
use givens_tests::{cov_error, mean_error, worst};

/// What seven digits leave, in standard deviations, over some rows of problems whose condition is about a hundred.
const SINGLE: f64 = 1e-3;

fn single(choice: &Choice) -> Choice {
    Choice { precision: Precision::F32, ..*choice }
}

/// How far estimates are apart, in standard deviations of the second.
fn apart(a: &Estimates, b: &Estimates) -> f64 {
    assert_eq!((&a.time, &a.nis_dof), (&b.time, &b.nis_dof));
    let n = b.states();
    let near = |x: f64, y: f64| {
        if y.is_nan() { f64::from(u8::from(!x.is_nan())) } else { (x - y).abs() / y.abs().max(1.0) }
    };
    worst((0..b.len()).map(|k| {
        let errors = [
            mean_error(a.mean(k), b.mean(k), b.cov(k)),
            cov_error(a.cov(k), b.cov(k), n),
            mean_error(a.predicted_mean(k), b.predicted_mean(k), b.predicted_cov(k)),
            mean_error(a.filtered_mean(k), b.filtered_mean(k), b.filtered_cov(k)),
            cov_error(a.filtered_cov(k), b.filtered_cov(k), n),
            near(a.nis[k], b.nis[k]),
            near(a.log_likelihood[k], b.log_likelihood[k]),
        ];
        worst(errors.into_iter())
    }))
}

/// Whether all means and roots are numbers of f32, and not those that f64 gives.
fn is_single(est: &Estimates, double: &Estimates) -> bool {
    let all = [&est.mean, &est.factor, &est.predicted_mean];
    all.iter().all(|of| of.iter().all(|&x| f64::from(x as f32) == x)) && est.mean != double.mean
}

const GOALS: [Goal; 4] = [Goal::Filter, Goal::Interval, Goal::Lag(2), Goal::Point(0.0)];

fn check(name: &str, choice: &Choice, goal: Goal, found: Outcome, expected: Outcome) {
    if choice.form == FormName::Covariance {
        let fault = found.failure.map(|(_, error)| error.fault);
        assert!(
            matches!(fault, Some(Fault::Mismatch { why }) if why.contains("f32 is for square roots")),
            "{name}"
        );
        return;
    }
    let between = apart(&found.at, &expected.at);
    let (found, expected) = match (found.into_result(), expected.into_result()) {
        (Ok(found), Ok(expected)) => (found, expected),
        (found, expected) => panic!(
            "{name} {goal:?}: {:?}, {:?}",
            found.err().map(|f| f.error),
            expected.err().map(|f| f.error)
        ),
    };
    let error = apart(&found, &expected).max(between);
    assert!(error < SINGLE, "{name} {goal:?}: {error:e}");
    assert!(is_single(&found, &expected), "{name} {goal:?}");
}

#[test]
fn every_discrete_choice_in_f32_is_that_in_f64_to_its_digits() {
    let problem = Problem::random(111, 3, 2, 8, 0.05);
    for (name, choice) in choices(3) {
        for goal in GOALS {
            let run = |choice: &Choice| {
                choice.run(
                    &problem.model,
                    &problem.sensor,
                    problem.rows(),
                    0.0,
                    &problem.prior(),
                    goal,
                    &[1.0, 20.0],
                )
            };
            check(&name, &choice, goal, run(&single(&choice)), run(&choice));
        }
    }
}

#[test]
fn every_continuous_choice_in_f32_is_that_in_f64_to_its_digits() {
    let problem = Continuous::random(112, [3, 2, 2], 5, 0.1);
    for (name, choice) in continuous_choices(3) {
        for goal in GOALS {
            check(&name, &choice, goal, problem.run(&single(&choice), goal), problem.run(&choice, goal));
        }
    }
}

/// Of the turns, which come to 7 km with standard deviations of some metres: of these, one rounding of a mean is 2e-4.
const TURNS: f64 = 5e-3;

/// A turn for each of nineteen tracks, of lengths from 20 down, with a bearing missing now and then.
fn turns() -> (CoordinatedTurn, RangeBearing, Gaussian, Vec<Data>) {
    let one = |k: usize| {
        let mut data = Data::new(2).starting_at(0.0);
        for row in 1..=20 - k {
            let t = row as f64;
            let (x, y) = (1000.0 + 290.0 * t + k as f64, 1000.0 - 9.0 * t * t);
            let bearing = if (row + k).is_multiple_of(7) { f64::NAN } else { y.atan2(x) };
            data.push(t, &[x.hypot(y), bearing]).unwrap();
        }
        data
    };
    let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01]);
    (CoordinatedTurn::default(), RangeBearing::published(), prior.unwrap(), (0..19).map(one).collect())
}

#[test]
fn packs_in_f32_are_the_tracks_alone_and_the_same_for_any_number_of_threads() {
    let (turn, radar, prior, data) = turns();
    let tracks: Vec<_> = data.iter().map(|data| Track::new(&turn, &radar, data, &prior)).collect();
    for name in ["sr-ckf", "sr-ukf", "sr-ckf5", "sr-qkf", "sr-ekf", "sr-cdkf"] {
        let double = resolve(name, &[]).unwrap();
        let choice = single(&double);
        for goal in [Goal::Filter, Goal::Interval] {
            let run = |choice: &Choice, vectors, threads| {
                let batch = Batch { goal, vectors, threads: NonZeroUsize::new(threads), ..Batch::default() };
                choice.run_batch(&tracks, &batch)
            };
            let vectors = Batch::default().vectors;
            let alone = run(&choice, InstructionSet::Portable, 1);
            let packed = run(&choice, vectors, 1);
            let double = run(&double, vectors, 1);
            for k in 0..tracks.len() {
                let of = |all: &[Option<Outcome>]| all[k].clone().unwrap().into_result().unwrap();
                let (alone, packed, double) = (of(&alone), of(&packed), of(&double));
                let errors = [apart(&packed, &alone), apart(&packed, &double)];
                assert!(errors.iter().all(|error| *error < TURNS), "{name} {goal:?}, track {k}: {errors:?}");
                assert!(is_single(&packed, &double), "{name} {goal:?}, track {k}");
            }
            for threads in [2, 3, 8] {
                assert_eq!(
                    format!("{packed:?}"),
                    format!("{:?}", run(&choice, vectors, threads)),
                    "{name} {threads}"
                );
            }
        }
    }
}

#[test]
fn times_and_gaps_are_kept_in_f64() {
    let (turn, radar, prior, data) = turns();
    let choice = single(&resolve("sr-ckf", &[]).unwrap());
    let shifted = |by: f64| {
        let mut moved = Data::new(2).starting_at(by);
        data[0].rows().for_each(|row| moved.push(row.time + by, row.z).unwrap());
        let alone = choice.run(&turn, &radar, moved.rows(), by, &prior, Goal::Interval, &[by + 1.5]);
        let tracks = [Track::new(&turn, &radar, &moved, &prior); 3];
        let batch = choice.run_batch(&tracks, &Batch { goal: Goal::Interval, ..Batch::default() });
        (
            alone.at.mean.clone(),
            alone.into_result().unwrap().mean,
            batch[1].clone().unwrap().into_result().unwrap(),
        )
    };
    // a model that does not read the time gives the same to the bit
    let (near, far) = (shifted(0.0), shifted(1.7e9));
    assert_eq!((near.0, near.1, near.2.mean), (far.0, far.1, far.2.mean));
    assert_eq!(far.2.time[3], 1.7e9 + 4.0);
}

#[test]
fn a_filter_by_hand_in_f32_is_its_run_and_goes_on_from_its_snapshot() {
    let (turn, radar, prior, data) = turns();
    for name in ["sr-ckf", "sr-ukf"] {
        let choice = single(&resolve(name, &[]).unwrap());
        let est =
            choice.run(&turn, &radar, data[0].rows(), 0.0, &prior, Goal::Filter, &[]).into_result().unwrap();
        let mut f = choice.start(&turn, &radar, 0.0, &prior).unwrap();
        for (k, Row { time, z, .. }) in data[0].rows().enumerate() {
            f.predict(time).unwrap();
            f.update(z).unwrap();
            assert_eq!((f.mean(), f.factor(), f.cov().as_slice()), (est.mean(k), est.factor(k), est.cov(k)));
            assert_eq!((f.nis(), f.log_likelihood()), (est.nis[k], est.log_likelihood[k]), "{name}, row {k}");
            let snapshot = f.snapshot();
            f = choice.resume(&turn, &radar, &snapshot).unwrap();
        }
    }
}

#[test]
fn what_f32_cannot_keep_is_refused_by_name() {
    let (turn, radar, prior, data) = turns();
    let choice = single(&resolve("sr-ckf", &[]).unwrap());
    let fault = |choice: &Choice, prior: &Gaussian, data: &Data| {
        let outcome = choice.run(&turn, &radar, data.rows(), 0.0, prior, Goal::Filter, &[]);
        outcome.failure.map(|(row, error)| (row, error.fault))
    };
    let beyond = |quantity, component, value| Fault::Unrepresentable { quantity, component, value };
    let (mean, std) = ([1000.0, 300.0, 1000.0, 0.0, -0.05], [10.0, 3.2, 10.0, 3.2, 0.01]);
    let far = Gaussian::from_std(&[1e39, 300.0, 1000.0, 0.0, -0.05], &std).unwrap();
    assert_eq!(fault(&choice, &far, &data[0]), Some((0, beyond(Quantity::Estimate, 0, 1e39))));
    for small in [1e-30, 1e-20] {
        let known = Gaussian::from_std(&mean, &[10.0, 3.2, 10.0, 3.2, small]).unwrap();
        assert_eq!(fault(&choice, &known, &data[0]), Some((0, beyond(Quantity::Variance, 4, small * small))));
    }
    let zero = Gaussian::from_std(&mean, &[10.0, 3.2, 10.0, 3.2, 0.0]).unwrap();
    assert_eq!(fault(&choice, &zero, &data[0]), None);
    let mut huge = Data::new(2).starting_at(0.0);
    huge.push(1.0, &[f64::NAN, 1e39]).unwrap();
    assert_eq!(fault(&choice, &prior, &huge), Some((0, beyond(Quantity::Measurement, 1, 1e39))));
    let words = fault(&choice, &prior, &huge).unwrap().1.to_string();
    assert_eq!(
        words,
        "component 2 of the measurement, 1e39, is beyond what f32 can keep (1.2e-38 to 3.4e38); choose other units, or f64"
    );
    // in a pack, of its track alone
    let tracks = [&data[0], &huge, &data[1]].map(|data| Track::new(&turn, &radar, data, &prior));
    let failed = choice.run_batch(&tracks, &Batch::default());
    let failed: Vec<_> =
        failed.iter().map(|of| of.as_ref().unwrap().failure.map(|(row, error)| (row, error.fault))).collect();
    assert_eq!(failed, [None, Some((0, beyond(Quantity::Measurement, 1, 1e39))), None]);
}

#[test]
fn a_tolerance_below_the_rounding_of_f32_is_refused() {
    let setting = |key: &str, value: Value| Setting { key: key.to_owned(), value };
    let choose = |rtol: f64| {
        let settings = [setting("precision", "f32".into()), setting("rtol", Value::Number(rtol))];
        resolve("sr-cd-ckf2", &settings).unwrap()
    };
    let refused = choose(1e-8).check(3).unwrap_err();
    assert_eq!((refused.option, refused.value), ("rtol", 1e-8));
    assert!(
        choose(1e-6).check(3).is_ok()
            && resolve("sr-cd-ckf2", &[setting("rtol", Value::Number(1e-8))]).unwrap().check(3).is_ok()
    );
    let problem = Continuous::random(113, [2, 2, 1], 3, 0.1);
    let failed = problem.run(&choose(1e-8), Goal::Filter).failure.unwrap();
    assert!(matches!(failed.1.fault, Fault::Option(error) if error.option == "rtol"), "{failed:?}");
}
