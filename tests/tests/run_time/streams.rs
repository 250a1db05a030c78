//! A trajectory that is streamed has the numbers of one that is run, to the bit, however few rows are held at once.

use super::streamed::{Apart, agrees, data, ends};
use core::ops::ControlFlow;
use givens::batch::Track;
use givens::filter::{Fault, Gaussian, StepError};
use givens::model::{At, Noise, Observation, Transition};
use givens::registry::{Choice, Precision, resolve};
use givens::scalar::Real;
use givens::{Data, Finished, Goal, Outcome, Stream};
use givens_tests::cases;
use givens_tests::choices::{choices, continuous_choices};
use givens_tests::models::Problem;
use givens_tests::sde::Continuous;
use proptest::prelude::*;

proptest! {
    #![proptest_config(cases(2))]

    #[test]
    fn every_discrete_method(seed: u64, n in 1usize..=3, d in 1usize..=2) {
        let problem = Problem::random(seed, n, d, 31, 0.05);
        let (model, sensor, prior) = (&problem.model, &problem.sensor, &problem.prior());
        let data = data(problem.rows(), d, 0);
        let apart = Apart { of: &data, end: data.len() };
        let track = Track::new(model, sensor, &apart, prior);
        for (name, choice) in choices(n) {
            for goal in [Goal::Filter, Goal::Interval, Goal::Lag(0), Goal::Lag(4), Goal::Point(9.0)] {
                let whole = choice.run(model, sensor, data.rows(), 0.0, prior, goal, &[]);
                agrees(&name, goal, 31, &whole, |by, sink| choice.stream(&track, by, sink));
            }
            let (single, goal) = (Choice { precision: Precision::F32, ..choice }, Goal::Interval);
            let whole = single.run(model, sensor, data.rows(), 0.0, prior, goal, &[]);
            agrees(&format!("{name} in f32"), goal, 31, &whole, |by, sink| single.stream(&track, by, sink));
        }
    }

    #[test]
    fn every_continuous_method_with_states_between_the_rows(seed: u64, n in 1usize..=2, q in 1usize..=2) {
        let problem = Continuous::random(seed, [n, q, 1], 17, 0.1);
        let (model, sensor, prior) = (&problem.model, &problem.sensor, &problem.prior());
        let data = data(problem.rows(), 1, 0);
        let mut at: Vec<f64> = problem.times.iter().flat_map(|t| [*t, t + 0.013, t + 0.4]).collect();
        at.sort_by(f64::total_cmp);
        at.dedup();
        at.insert(0, 0.0);
        let apart = Apart { of: &data, end: data.len() };
        let track = Track { at: &at, ..Track::new(model, sensor, &apart, prior) };
        for (name, choice) in continuous_choices(n) {
            for goal in [Goal::Filter, Goal::Interval] {
                let whole = choice.run_continuous(model, sensor, data.rows(), 0.0, prior, goal, &at);
                agrees(&name, goal, 17, &whole, |by, sink| choice.stream_continuous(&track, by, sink));
            }
            let (single, goal) = (Choice { precision: Precision::F32, ..choice }, Goal::Interval);
            let whole = single.run_continuous(model, sensor, data.rows(), 0.0, prior, goal, &at);
            agrees(&format!("{name} in f32"), goal, 17, &whole, |by, sink| single.stream_continuous(&track, by, sink));
        }
    }
}

/// x' = 0.9 x + u, measured with the control added, each from a sensor of its own; nothing finite comes of a control above 100,
/// nor of a gap so short.
struct Driven;

const BROKEN_GAP: f64 = 0.25;

impl Transition for Driven {
    fn states(&self) -> usize {
        2
    }
    fn controls(&self) -> usize {
        1
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let short = T::zero().lt(at.dt * (T::of(0.3) - at.dt));
        let limit = T::select(T::of(100.0).lt(at.u[0]), T::of(f64::NAN), T::zero());
        let limit = limit + T::select(short, T::of(f64::NAN), T::zero());
        out[0] = T::of(0.9) * x[0] + T::of(0.1) * x[1] * x[1] + at.u[0] + limit;
        out[1] = T::of(0.8) * x[1];
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn process_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&[0.1, 0.02, 0.02, 0.2].map(T::of));
    }
}

struct Seen(usize);

impl Observation for Seen {
    fn states(&self) -> usize {
        2
    }
    fn measures(&self) -> usize {
        1
    }
    fn controls(&self) -> usize {
        1
    }
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = x[self.0] + at.u[0];
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out[0] = T::of(0.5);
    }
}

const SENSORS: (Seen, Seen) = (Seen(0), Seen(1));

/// Two sensors in turn at one time, with controls; row `bad` has this one.
fn driven(bad: usize, control: f64) -> Data {
    let mut data = Data::with_controls(2, 1).starting_at(0.0);
    for k in 0..40 {
        let z = if k % 2 == 0 { [0.3 * k as f64, f64::NAN] } else { [f64::NAN, 0.7] };
        let z = if k % 7 == 0 { [f64::NAN; 2] } else { z };
        let u = if k == bad { control } else { 0.1 * k as f64 };
        data.push_controlled(f64::from(1 + k as u32 / 2), &z, &[u]).unwrap();
    }
    data
}

const AT: [f64; 10] = [0.0, 0.5, 3.0, 3.5, 6.0, 6.5, 11.0, 14.5, 20.0, 20.5];

fn run(name: &str, data: &Data, goal: Goal, at: &[f64]) -> (Choice, Gaussian, Outcome) {
    let (choice, prior) =
        (resolve(name, &[]).unwrap(), Gaussian::from_std(&[1.0, 0.5], &[1.0, 2.0]).unwrap());
    let whole = choice.run(&Driven, &SENSORS, data.rows(), 0.0, &prior, goal, at);
    (choice, prior, whole)
}

/// The row that fails and what of it, on the way with a goal and states between the rows.
fn fails(data: &Data, goal: Goal, at: &[f64]) -> Vec<Option<(usize, StepError)>> {
    let of = |name: &&str| {
        let (choice, prior, whole) = run(name, data, goal, at);
        let track = Track { at, ..Track::new(&Driven, &SENSORS, data, &prior) };
        agrees(name, goal, 40, &whole, |by, sink| choice.stream(&track, by, sink));
        whole.failure
    };
    ["ckf", "sr-ckf", "sr-ekf", "ukf"].iter().map(of).collect()
}

#[test]
fn controls_several_sensors_and_rows_that_fail() {
    for goal in [Goal::Filter, Goal::Interval, Goal::Lag(3), Goal::Point(4.0)] {
        assert!(fails(&driven(99, 0.0), goal, &AT).iter().all(Option::is_none));
        for bad in [0, 1, 2, 12, 13, 14, 27, 38, 39] {
            // in the update of the row, and in the prediction to the one behind it at another time
            let rows = |failures: Vec<Option<(usize, StepError)>>| -> Vec<usize> {
                failures.into_iter().map(|failure| failure.map_or(40, |(row, _)| row)).collect()
            };
            assert_eq!(rows(fails(&driven(bad, f64::NAN), goal, &AT)), [bad; 4]);
            // the control of the first row holds also before it; of two rows at one time, that of the second
            let begun = match bad {
                0 => 0,
                39 => 40,
                bad if bad % 2 == 1 => bad + 1,
                _ => 40,
            };
            let found = rows(fails(&driven(bad, 200.0), goal, &[]));
            assert_eq!(found, [begun; 4], "{bad}");
        }
    }
}

#[test]
fn a_state_between_the_rows_that_fails() {
    for goal in [Goal::Filter, Goal::Interval] {
        for (time, row) in [(4.0, 8), (13.0, 26), (20.0, 39)] {
            for failure in fails(&driven(99, 0.0), goal, &[3.5, time + BROKEN_GAP]) {
                let (found, error) = failure.unwrap();
                assert_eq!(found, row, "{error}");
                assert!(matches!(error.fault, Fault::NotFinite { .. }));
            }
        }
    }
}

// the same rows by themselves, whose way back begins at the filter: 1e-13 is rounding of numbers about 10
#[test]
fn rows_before_a_state_that_fails_are_smoothed_among_themselves() {
    let data = driven(99, 0.0);
    for name in ["ckf", "sr-ckf"] {
        for (time, rows) in [(4.0, 8), (20.0, 40)] {
            let (.., failed) = run(name, &data, Goal::Interval, &[time + BROKEN_GAP]);
            let mut before = Data::with_controls(2, 1).starting_at(0.0);
            data.rows().take(rows).for_each(|row| before.push_controlled(row.time, row.z, row.u).unwrap());
            let (.., alone) = run(name, &before, Goal::Interval, &[]);
            assert!(failed.failure.is_some() && alone.estimates.len() == rows);
            assert_eq!(failed.estimates.len(), rows);
            let far = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(far(&failed.estimates.mean, &alone.estimates.mean) < 1e-13, "{name} {time}");
            assert!(far(&failed.estimates.cov, &alone.estimates.cov) < 1e-13, "{name} {time}");
        }
    }
}

#[test]
fn a_sink_that_has_enough_ends_the_run() {
    let data = driven(99, 0.0);
    let prior = Gaussian::from_std(&[1.0, 0.5], &[1.0, 2.0]).unwrap();
    let track = Track::new(&Driven, &SENSORS, &data, &prior);
    for goal in [Goal::Filter, Goal::Interval] {
        let (mut calls, by) = (0, Stream { goal, hold: 6, ..Stream::default() });
        let ended = resolve("sr-ckf", &[]).unwrap().stream(&track, &by, &mut |_: Finished| {
            calls += 1;
            ControlFlow::Break(())
        });
        assert!(calls == 1 && ended.failure.is_none(), "{goal:?}");
    }
}

#[test]
fn rows_that_cannot_be_read_end_a_stream() {
    let problem = Problem::random(7, 2, 1, 40, 0.05);
    let (model, sensor, prior) = (&problem.model, &problem.sensor, &problem.prior());
    let data = data(problem.rows(), 1, 0);
    for (_, choice) in choices(2) {
        for goal in [Goal::Filter, Goal::Interval, Goal::Lag(4), Goal::Point(3.0)] {
            let whole = choice.run(model, sensor, data.rows(), 0.0, prior, goal, &[]);
            for end in [0, 1, 9, 25, 39] {
                let apart = Apart { of: &data, end };
                let by = Stream { goal, hold: 8, ..Stream::default() };
                ends(&whole, end, |sink| choice.stream(&Track::new(model, sensor, &apart, prior), &by, sink));
            }
        }
    }
}
