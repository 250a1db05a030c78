//! The gate: a run in which rows are beyond it is the run in which they were never measured, to the bit, whatever the method
//! and the goal.

use super::packs::{alone, apart, steady, tracks_of};
use super::streamed::{agrees, data};
use givens::batch::{Batch, Track};
use givens::registry::{Choice, Precision};
use givens::{Data, Draws, Estimates, Goal, Outcome, Row};
use givens_tests::choices::{choices, continuous_choices};
use givens_tests::models::Problem;
use givens_tests::sde::Continuous;

const GOALS: [Goal; 5] = [Goal::Filter, Goal::Interval, Goal::Lag(0), Goal::Lag(4), Goal::Point(9.0)];

fn gated(choice: &Choice) -> Choice {
    Choice { gate: Some(0.9999), ..*choice }
}

/// Plants an outlier of some thousand standard deviations in every fifth row that measures something; which rows those are.
fn plant(z: &mut [Vec<f64>]) -> Vec<usize> {
    let there = |z: &[f64]| z.iter().position(|z| !z.is_nan());
    let rows: Vec<usize> = (0..z.len()).filter(|k| k % 5 == 2 && there(&z[*k]).is_some()).collect();
    for &k in &rows {
        let i = there(&z[k]).unwrap();
        z[k][i] += if k % 2 == 0 { 1e4 } else { -1e4 };
    }
    rows
}

/// The rows of a run that are beyond its gate, by their times.
fn beyond(est: &Estimates) -> Vec<f64> {
    est.time.iter().zip(&est.gated).filter(|(_, gated)| **gated).map(|(&t, _)| t).collect()
}

/// Measurements without those rows.
fn without(z: &[Vec<f64>], times: &[f64], gone: &[f64]) -> Vec<Vec<f64>> {
    let missing = |z: &Vec<f64>| vec![f64::NAN; z.len()];
    z.iter().zip(times).map(|(z, t)| if gone.contains(t) { missing(z) } else { z.clone() }).collect()
}

fn bits(of: &[f64]) -> Vec<u64> {
    of.iter().map(|x| x.to_bits()).collect()
}

/// What does not tell of a row's own measurement is the same in every row; what does, in the rows that were taken in.
fn same(place: &str, a: &Estimates, b: &Estimates) {
    let rows = |est: &Estimates| {
        [&est.time, &est.mean, &est.cov, &est.factor, &est.filtered_mean, &est.filtered_cov]
            .into_iter()
            .chain([&est.predicted_mean, &est.predicted_cov, &est.log_likelihood])
            .map(|array| bits(array))
            .collect::<Vec<_>>()
    };
    assert!(rows(a) == rows(b), "{place}");
    for k in 0..a.len() {
        let seen = |est: &Estimates| {
            bits(&[est.innovation(k), est.innovation_cov(k), &[est.nis[k], est.nis_dof[k] as f64]].concat())
        };
        assert!(a.gated[k] || seen(a) == seen(b), "{place}, row {k}");
        assert!(
            !a.gated[k] || (a.nis[k] > 15.0 && a.nis_dof[k] > 0 && b.nis_dof[k] == 0),
            "{place}, row {k}"
        );
    }
    assert!(b.gated.iter().all(|gated| !gated), "{place}");
}

fn same_outcome(place: &str, a: &Outcome, b: &Outcome) {
    assert!(a.failure.is_none() && b.failure.is_none(), "{place}: {:?} {:?}", a.failure, b.failure);
    assert_eq!(a.log_likelihood.to_bits(), b.log_likelihood.to_bits(), "{place}");
    same(place, &a.estimates, &b.estimates);
    same(place, &a.at, &b.at);
}

#[test]
fn runs_of_every_discrete_method_are_those_without_the_rows_beyond() {
    let mut problem = Problem::random(41, 3, 2, 31, 0.05);
    let planted = plant(&mut problem.z);
    assert!(planted.len() > 4);
    let times: Vec<f64> = problem.rows().map(|row| row.time).collect();
    let (model, sensor, prior) = (&problem.model, &problem.sensor, &problem.prior());
    for (name, choice) in choices(3) {
        for by in [choice, Choice { precision: Precision::F32, ..choice }] {
            let gate = gated(&by);
            if gate.start(model, sensor, 0.0, prior).is_err() {
                assert_eq!(by.precision, Precision::F32, "{name}"); // of a covariance form
                continue;
            }
            let first = gate.run(model, sensor, problem.rows(), 0.0, prior, Goal::Filter, &[]);
            let gone = beyond(&first.estimates);
            assert!(planted.iter().all(|&k| gone.contains(&times[k])), "{name}: {gone:?}");
            let z = without(&problem.z, &times, &gone);
            let rows = || times.iter().zip(&z).map(|(&time, z)| Row { time, z, u: &[] });
            let data = data(problem.rows(), 2, 0);
            let track = Track::new(model, sensor, &data, prior);
            for goal in GOALS {
                let place = format!("{name}, {:?}, {goal:?}", by.precision);
                let found = gate.run(model, sensor, problem.rows(), 0.0, prior, goal, &[]);
                same_outcome(&place, &found, &by.run(model, sensor, rows(), 0.0, prior, goal, &[]));
                agrees(&place, goal, 31, &found, |stream, sink| gate.stream(&track, stream, sink));
            }
        }
    }
}

#[test]
fn runs_of_every_continuous_method_are_those_without_the_rows_beyond() {
    let mut problem = Continuous::random(42, [2, 2, 1], 17, 0.1);
    // the first row stands at the time of the prior
    let planted = plant(&mut problem.z);
    assert!(planted.len() > 1);
    let (times, start) = (problem.times.clone(), problem.prior());
    let (model, sensor, prior) = (&problem.model, &problem.sensor, &start);
    let mut at: Vec<f64> = times.iter().flat_map(|t| [*t, t + 0.013, t + 0.4]).collect();
    at.sort_by(f64::total_cmp);
    at.dedup();
    for (name, choice) in continuous_choices(2) {
        let gate = gated(&choice);
        let first = gate.run_continuous(model, sensor, problem.rows(), 0.0, prior, Goal::Filter, &[]);
        let gone = beyond(&first.estimates);
        assert!(planted.iter().all(|&k| gone.contains(&times[k])), "{name}: {gone:?}");
        let z = without(&problem.z, &times, &gone);
        let rows = || times.iter().zip(&z).map(|(&time, z)| Row { time, z, u: &[] });
        let data = data(problem.rows(), 1, 0);
        let track = Track { at: &at, ..Track::new(model, sensor, &data, prior) };
        for goal in [Goal::Filter, Goal::Interval] {
            let place = format!("{name}, {goal:?}");
            let found = gate.run_continuous(model, sensor, problem.rows(), 0.0, prior, goal, &at);
            let expected = choice.run_continuous(model, sensor, rows(), 0.0, prior, goal, &at);
            same_outcome(&place, &found, &expected);
            agrees(&place, goal, 17, &found, |stream, sink| gate.stream_continuous(&track, stream, sink));
        }
    }
}

#[test]
fn draws_and_filters_by_hand_do_not_take_in_what_is_beyond() {
    let mut problem = Problem::random(43, 2, 2, 12, 0.05);
    plant(&mut problem.z);
    let times: Vec<f64> = problem.rows().map(|row| row.time).collect();
    let (model, sensor, prior) = (&problem.model, &problem.sensor, &problem.prior());
    for (name, choice) in choices(2) {
        let gate = gated(&choice);
        let est = gate.run(model, sensor, problem.rows(), 0.0, prior, Goal::Filter, &[]).estimates;
        let z = without(&problem.z, &times, &beyond(&est));
        let rows = times.iter().zip(&z).map(|(&time, z)| Row { time, z, u: &[] });
        let draws = Draws { count: 3, seed: 7, track: 0 };
        let drawn = gate.sample(model, sensor, problem.rows(), 0.0, prior, draws).unwrap();
        assert_eq!(drawn, choice.sample(model, sensor, rows, 0.0, prior, draws).unwrap(), "{name}");
        let mut f = gate.start(model, sensor, 0.0, prior).unwrap();
        for (k, row) in problem.rows().enumerate() {
            if k == 6 {
                f = gate.resume(model, sensor, &f.snapshot()).unwrap();
            }
            f.predict(row.time).unwrap();
            f.update(row.z).unwrap();
            assert_eq!((f.gated(), bits(f.mean())), (est.gated[k], bits(est.mean(k))), "{name}, row {k}");
            let scores = [f.nis(), f.log_likelihood()];
            assert_eq!(bits(&scores), bits(&[est.nis[k], est.log_likelihood[k]]), "{name}, row {k}");
        }
    }
}

/// The same tracks with an outlier in some row of each but every third.
fn with_outliers(tracks: &[Data]) -> Vec<Data> {
    let one = |(track, data): (usize, &Data)| {
        let mut out = Data::new(data.measures()).starting_at(0.0);
        for (k, row) in data.rows().enumerate() {
            let off = if track % 3 > 0 && (k + track) % 4 == 1 { 1e4 } else { 0.0 };
            let z: Vec<f64> = row.z.iter().map(|z| z + off).collect();
            out.push(row.time, &z).unwrap();
        }
        out
    };
    tracks.iter().enumerate().map(one).collect()
}

fn packs_are_alone(name: &str, found: &[Option<Outcome>], expected: &[Option<Outcome>], most: f64) {
    let mut count = 0;
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        let (found, expected) = (found.as_ref().unwrap(), expected.as_ref().unwrap());
        assert_eq!(found.estimates.gated, expected.estimates.gated, "{name}, track {k}");
        count += beyond(&found.estimates).len();
        let apart = apart(found, expected);
        assert!(apart < most, "{name}, track {k}: {apart:e}");
    }
    assert!(count > 4, "{name}: {count}");
}

#[test]
fn packs_whose_lanes_are_beyond_at_rows_of_their_own_are_the_tracks_alone() {
    let problem = Problem::random(90, 3, 2, 12, 0.05);
    let data = tracks_of(&problem.z, 91, |row, _| (row - usize::from(row % 5 == 3)) as f64);
    let (data, prior) = (with_outliers(&data), problem.prior());
    let tracks: Vec<_> =
        data.iter().map(|data| Track::new(&problem.model, &problem.sensor, data, &prior)).collect();
    for (name, choice) in choices(3) {
        let gate = gated(&choice);
        for goal in [Goal::Filter, Goal::Interval] {
            let expected = gate.run_batch(&tracks, &Batch { goal, ..alone() });
            let found = gate.run_batch(&tracks, &Batch { goal, ..Batch::default() });
            packs_are_alone(&format!("{name} {goal:?}"), &found, &expected, 1e-10);
        }
    }
}

#[test]
fn so_are_those_of_continuous_methods() {
    let problem = Continuous::random(95, [3, 2, 2], 12, 0.1);
    let (data, prior) = (with_outliers(&tracks_of(&problem.z, 96, |_, at| at)), problem.prior());
    let tracks: Vec<_> =
        data.iter().map(|data| Track::new(&problem.model, &problem.sensor, data, &prior)).collect();
    for (name, choice) in steady(3) {
        let gate = gated(&choice);
        for goal in [Goal::Filter, Goal::Interval] {
            let expected = gate.run_batch_continuous(&tracks, &Batch { goal, ..alone() });
            let found = gate.run_batch_continuous(&tracks, &Batch { goal, ..Batch::default() });
            packs_are_alone(&format!("{name} {goal:?}"), &found, &expected, 1e-9);
        }
    }
}
