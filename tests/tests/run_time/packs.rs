//! Packs: tracks side by side in one register are the tracks alone, but for rounding, whatever the lanes beside them do.

use core::num::NonZeroUsize;
use givens::batch::{Batch, InstructionSet, Track};
use givens::filter::Gaussian;
use givens::model::zoo::Components;
use givens::model::{At, Noise, Observation, Transition};
use givens::registry::{Choice, Setting, resolve};
use givens::scalar::Real;
use givens::{Data, Goal, Outcome};
use givens_tests::choices::{choices, continuous_choices};
use givens_tests::models::{Motion, Normals, Problem, Sensor};
use givens_tests::sde::{Continuous, Flow};
use givens_tests::{cov_error, mean_error, worst};

/// Tracks of different lengths, from 1 row to 12, each with its own components missing; some rows have none at all.
pub fn tracks_of(z: &[Vec<f64>], seed: u64, time: impl Fn(usize, f64) -> f64) -> Vec<Data> {
    let d = z[0].len();
    let one = |k: u64| {
        let mut normals = Normals::new(seed + k);
        let mut data = Data::new(d).starting_at(0.0);
        let mut at = 0.0;
        for (row, z) in z.iter().enumerate().take(1 + (7 * k as usize) % 12) {
            let lost = normals.vector(d);
            let noise = normals.vector(d + 1);
            at = time(row, at + noise[d].abs());
            let own = |i: usize| if lost[i].abs() > 1.2 { f64::NAN } else { z[i] + noise[i] };
            let z: Vec<f64> = (0..d).map(own).collect();
            data.push(at, &z).unwrap();
        }
        data
    };
    (0..11).map(one).collect()
}

/// How far two outcomes are apart: means in standard deviations, covariances in products of them, the rest relatively.
pub fn apart(found: &Outcome, expected: &Outcome) -> f64 {
    let (a, b) = (&found.estimates, &expected.estimates);
    assert_eq!(found.failure, expected.failure);
    assert_eq!((&a.time, &a.nis_dof, a.len()), (&b.time, &b.nis_dof, b.len()));
    let (n, d) = (a.states(), a.measures());
    let near = |x: f64, y: f64| match (x.is_nan(), y.is_nan()) {
        (true, true) => 0.0,
        _ => (x - y).abs() / y.abs().max(1.0),
    };
    let rows = (0..a.len()).map(|k| {
        let scores = near(a.nis[k], b.nis[k]).max(near(a.log_likelihood[k], b.log_likelihood[k]));
        let seen = (0..d).map(|i| near(a.innovation(k)[i], b.innovation(k)[i]));
        let spread = (0..d * d).map(|i| near(a.innovation_cov(k)[i], b.innovation_cov(k)[i]));
        let factor = (0..n * n).map(|i| near(a.factor(k)[i], b.factor(k)[i]));
        worst(
            [
                scores,
                mean_error(a.mean(k), b.mean(k), b.cov(k)),
                cov_error(a.cov(k), b.cov(k), n),
                mean_error(a.predicted_mean(k), b.predicted_mean(k), b.predicted_cov(k)),
                cov_error(a.predicted_cov(k), b.predicted_cov(k), n),
                mean_error(a.filtered_mean(k), b.filtered_mean(k), b.filtered_cov(k)),
                cov_error(a.filtered_cov(k), b.filtered_cov(k), n),
            ]
            .into_iter()
            .chain(seen)
            .chain(spread)
            .chain(factor),
        )
    });
    worst(rows)
}

pub fn alone() -> Batch<'static> {
    Batch { vectors: InstructionSet::Portable, ..Batch::default() }
}

#[test]
fn packs_of_every_discrete_method_are_the_tracks_alone() {
    let problem = Problem::random(90, 3, 2, 12, 0.05);
    let z: Vec<Vec<f64>> = problem.z.iter().map(|z| z.iter().map(|z| z.max(-9.0)).collect()).collect();
    // rows at whole times; some stand at the time of the row above
    let data = tracks_of(&z, 91, |row, _| (row - usize::from(row % 5 == 3)) as f64);
    let prior = problem.prior();
    let tracks: Vec<_> =
        data.iter().map(|data| Track::new(&problem.model, &problem.sensor, data, &prior)).collect();
    for (name, choice) in choices(3) {
        for goal in [Goal::Filter, Goal::Interval] {
            let expected = choice.run_batch(&tracks, &Batch { goal, ..alone() });
            let found = choice.run_batch(&tracks, &Batch { goal, ..Batch::default() });
            for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let apart = apart(found.as_ref().unwrap(), expected.as_ref().unwrap());
                assert!(apart < 1e-10, "{name} {goal:?}, track {k}: {apart:e}");
            }
        }
    }
}

/// Continuous methods with equal steps, whose lanes go together.
pub fn steady(n: usize) -> Vec<(String, Choice)> {
    let with = |name: &str, settings: &[(&str, &str)]| {
        let own: Vec<_> =
            settings.iter().map(|&(key, x)| Setting { key: key.to_owned(), value: x.into() }).collect();
        (format!("{name} {settings:?}"), resolve(name, &own).unwrap())
    };
    let mut all = continuous_choices(n);
    all.push(with("sr-cd-ckf", &[("variant", "full")]));
    all.push(with("sr-cd-ckf", &[("variant", "noise-once")]));
    all.push(with("sr-cd-ekf", &[("solver", "rk4")]));
    all.push(with("lskf", &[("solver", "rk4")]));
    all.push(with("lskf", &[("solver", "rk4"), ("gauge", "triangular")]));
    all
}

#[test]
fn packs_of_continuous_methods_are_the_tracks_alone_each_at_its_own_times() {
    let problem = Continuous::random(95, [3, 2, 2], 12, 0.1);
    let z: Vec<Vec<f64>> = problem.z.iter().map(|z| z.iter().map(|z| z.max(-9.0)).collect()).collect();
    let data = tracks_of(&z, 96, |_, at| at);
    let prior = problem.prior();
    let tracks: Vec<Track<'_, Flow, Sensor>> =
        data.iter().map(|data| Track::new(&problem.model, &problem.sensor, data, &prior)).collect();
    for (name, choice) in steady(3) {
        for goal in [Goal::Filter, Goal::Interval] {
            let expected = choice.run_batch_continuous(&tracks, &Batch { goal, ..alone() });
            let found = choice.run_batch_continuous(&tracks, &Batch { goal, ..Batch::default() });
            for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let apart = apart(found.as_ref().unwrap(), expected.as_ref().unwrap());
                assert!(apart < 1e-9, "{name} {goal:?}, track {k}: {apart:e}");
            }
        }
    }
}

#[test]
fn packs_are_the_same_to_the_bit_for_any_number_of_threads() {
    let problem = Problem::random(97, 3, 2, 12, 0.05);
    let data = tracks_of(&problem.z, 98, |row, _| row as f64);
    let prior = problem.prior();
    let tracks: Vec<Track<'_, Motion, Sensor>> =
        data.iter().map(|data| Track::new(&problem.model, &problem.sensor, data, &prior)).collect();
    let choice = resolve("sr-ckf", &[]).unwrap();
    let run = |threads: usize| {
        let batch = Batch { goal: Goal::Interval, threads: NonZeroUsize::new(threads), ..Batch::default() };
        format!("{:?}", choice.run_batch(&tracks, &batch))
    };
    let one = run(1);
    assert!([2, 3, 7].into_iter().all(|threads| run(threads) == one));
}

#[test]
fn a_lane_that_fails_is_as_alone_and_leaves_the_others_in_peace() {
    let problem = Problem::random(99, 3, 2, 12, 0.05);
    let mut data = tracks_of(&problem.z, 100, |row, _| row as f64);
    let prior = problem.prior();
    let choice = resolve("sr-ckf", &[]).unwrap();
    let run = |data: &[Data], batch: &Batch| {
        let tracks: Vec<Track<'_, Motion, Sensor>> =
            data.iter().map(|data| Track::new(&problem.model, &problem.sensor, data, &prior)).collect();
        choice.run_batch(&tracks, batch)
    };
    let before = run(&data, &Batch::default());
    // one whose innovation has no finite square; one with a measurement of another length; one that ends in the past
    let (last, long) = (data.len() - 1, 5);
    let mut far = Data::new(2).starting_at(0.0);
    for (k, row) in data[long].rows().enumerate() {
        let z = if k == 3 { &[1e300; 2][..] } else { row.z };
        far.push(row.time, z).unwrap();
    }
    data[long] = far;
    data[last] = Data::new(1).starting_at(0.0);
    data[last].push(1.0, &[0.5]).unwrap();
    let after = run(&data, &Batch::default());
    let expected = run(&data, &alone());
    assert_eq!(after[long].as_ref().unwrap().failure.map(|(row, _)| row), Some(3));
    for k in [long, last] {
        assert_eq!(format!("{:?}", after[k]), format!("{:?}", expected[k]), "track {k}");
        assert!(after[k].as_ref().unwrap().failure.is_some());
    }
    for k in (0..data.len()).filter(|k| ![long, last].contains(k)) {
        let apart = apart(after[k].as_ref().unwrap(), before[k].as_ref().unwrap());
        assert!(apart < 1e-12, "track {k}: {apart:e}");
    }
}

#[test]
fn tracks_of_several_models_and_priors_find_their_own() {
    let problems: Vec<_> = (0..3).map(|k| Problem::random(101 + k, 3, 2, 12, 0.05)).collect();
    let priors: Vec<Gaussian> = problems.iter().map(Problem::prior).collect();
    let data: Vec<_> =
        problems.iter().map(|problem| tracks_of(&problem.z, 105, |row, _| row as f64)).collect();
    let mut tracks = Vec::new();
    for k in 0..33 {
        let (which, track) = (k % 3, k / 3);
        let (problem, prior) = (&problems[which], &priors[(which + track) % 3]);
        tracks.push(Track::new(&problem.model, &problem.sensor, &data[which][track], prior));
    }
    let choice = resolve("sr-ukf", &[]).unwrap();
    let expected = choice.run_batch(&tracks, &alone());
    let found = choice.run_batch(&tracks, &Batch::default());
    for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
        let apart = apart(found.as_ref().unwrap(), expected.as_ref().unwrap());
        assert!(apart < 1e-11, "track {k}: {apart:e}");
    }
}

/// z = x and z = ln x, of which the second is no number below zero.
struct Logarithm;

impl Observation for Logarithm {
    fn states(&self) -> usize {
        1
    }
    fn measures(&self) -> usize {
        2
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        (out[0], out[1]) = (x[0], x[0].ln());
    }
    fn noise(&self) -> Noise {
        Noise::Root(2)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.fill(T::zero());
        (out[0], out[3]) = (T::one(), T::one());
    }
}

/// A state that stays, but for noise.
struct Stays(f64);

impl Transition for Stays {
    fn states(&self) -> usize {
        1
    }
    fn transition<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = x[0];
    }
    fn noise(&self) -> Noise {
        Noise::Root(1)
    }
    fn process_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out[0] = T::of(self.0);
    }
}

#[test]
fn a_pack_of_which_every_lane_fails_at_once_is_its_tracks_alone() {
    let nan = f64::NAN;
    let row = |k: usize, z: [f64; 2]| (k as f64, z);
    let far = [row(0, [0.0, nan]), row(1, [-1e3, nan]), row(2, [0.0, 0.0])];
    let near = [row(0, [0.0, nan]), row(1, [0.0, nan]), row(2, [0.0, 0.0])];
    let data: Vec<Data> = (0..8)
        .map(|k| {
            let mut data = Data::new(2).starting_at(0.0);
            for (t, z) in if k < 4 { far } else { near } {
                data.push(t, &z).unwrap();
            }
            data
        })
        .collect();
    let (model, prior) = (Stays(0.3), Gaussian::from_std(&[1.0], &[0.1]).unwrap());
    let tracks: Vec<_> = data.iter().map(|data| Track::new(&model, &Logarithm, data, &prior)).collect();
    for name in ["sr-ckf", "sr-ekf"] {
        let choice = resolve(name, &[]).unwrap();
        for goal in [Goal::Filter, Goal::Interval] {
            let expected = choice.run_batch(&tracks, &Batch { goal, ..alone() });
            let found = choice.run_batch(&tracks, &Batch { goal, ..Batch::default() });
            for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert_eq!(expected.as_ref().unwrap().failure.is_some(), k < 4, "{name}, track {k}");
                let apart = apart(found.as_ref().unwrap(), expected.as_ref().unwrap());
                assert!(apart < 1e-10, "{name} {goal:?}, track {k}: {apart:e}");
            }
        }
    }
}

#[test]
fn a_squared_innovation_that_overflows_is_a_fault_in_a_pack_too() {
    let (model, sensor) = (Stays(0.0), Components { states: 1, which: [0], std: [1.0] });
    let data: Vec<Data> = (0..2)
        .map(|k| {
            let mut data = Data::new(1).starting_at(0.0);
            for row in 0..3 {
                let z = if k == 0 && row == 2 { 1e160 } else { 0.0 };
                data.push(f64::from(row), &[z]).unwrap();
            }
            data
        })
        .collect();
    for deviation in [0.0, 1.0] {
        let prior = Gaussian::from_std(&[0.0], &[deviation]).unwrap();
        let tracks: Vec<_> = data.iter().map(|data| Track::new(&model, &sensor, data, &prior)).collect();
        let choice = resolve("sr-ckf", &[]).unwrap();
        let found = choice.run_batch(&tracks, &Batch::default());
        let expected = choice.run_batch(&tracks, &alone());
        assert_eq!(found[0].as_ref().unwrap().failure.map(|(row, _)| row), Some(2), "σ = {deviation}");
        assert_eq!(format!("{:?}", found[0]), format!("{:?}", expected[0]));
        assert!(found[1].as_ref().unwrap().failure.is_none());
    }
}
