//! Batches of tracks that have nothing in common: the outcomes of each alone, to the bit, for any number of threads.

use super::packs::apart;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use givens::batch::{Batch, InstructionSet, Track};
use givens::filter::Gaussian;
use givens::model::{At, Noise, Observation};
use givens::registry::resolve;
use givens::scalar::Real;
use givens::{Data, Goal, Outcome};
use givens_tests::models::{Motion, Problem, Sensor};
use givens_tests::sde::{Continuous, Flow};

/// Tracks of different lengths, each over a model of its own; the fourth fails at its second row.
fn problems() -> Vec<(Problem, Data, Gaussian)> {
    let of = |k: usize| {
        let problem = Problem::random(60 + k as u64, 3, 2, 2 + (7 * k) % 11, 0.05);
        let mut data = Data::new(2).starting_at(0.0);
        problem.rows().for_each(|row| data.push(row.time, row.z).unwrap());
        let prior = problem.prior();
        (problem, data, prior)
    };
    let mut all: Vec<_> = (0..13).map(of).collect();
    // so far off that the square of its innovation is no number
    let far = &mut all[3].1;
    *far = Data::new(2).starting_at(0.0);
    far.push(1.0, &[0.0; 2]).unwrap();
    far.push(2.0, &[1e300; 2]).unwrap();
    all
}

fn tracks(of: &[(Problem, Data, Gaussian)]) -> Vec<Track<'_, Motion, Sensor>> {
    of.iter().map(|(problem, data, prior)| Track::new(&problem.model, &problem.sensor, data, prior)).collect()
}

/// All numbers of an outcome; `{:?}` tells every bit of a number, and NaN is equal to itself.
fn told(outcome: &Outcome) -> String {
    format!("{outcome:?}")
}

#[test]
fn a_batch_is_its_tracks_one_by_one_for_any_number_of_threads() {
    let problems = problems();
    let tracks: Vec<_> =
        tracks(&problems).into_iter().map(|track| Track { at: &[1.0, 20.0], ..track }).collect();
    for name in ["ukf", "sr-cdkf", "sr-ckf"] {
        let choice = resolve(name, &[]).unwrap();
        for goal in [Goal::Filter, Goal::Interval, Goal::Lag(2), Goal::Point(1.0)] {
            let alone: Vec<_> = tracks
                .iter()
                .map(|track| {
                    let Track { model, sensors, data, prior, at, .. } = *track;
                    told(&choice.run(model, sensors, data.rows(), data.start(), prior, goal, at))
                })
                .collect();
            for threads in [None, Some(1), Some(2), Some(3), Some(50)] {
                let batch = Batch { goal, threads: threads.and_then(NonZeroUsize::new), ..Batch::default() };
                let found = choice.run_batch(&tracks, &batch);
                let found: Vec<_> = found.iter().map(|of| told(of.as_ref().unwrap())).collect();
                assert_eq!(found, alone, "{name} {goal:?} {threads:?}");
            }
        }
    }
}

#[test]
fn a_track_that_fails_does_not_stop_the_others() {
    let problems = problems();
    let found = resolve("sr-ckf", &[]).unwrap().run_batch(&tracks(&problems), &Batch::default());
    for (k, outcome) in found.iter().flatten().enumerate() {
        let failed = outcome.failure.map(|(row, _)| row);
        assert_eq!(failed, (k == 3).then_some(1), "track {k}");
        assert_eq!(outcome.estimates.len(), if k == 3 { 1 } else { problems[k].1.len() }, "track {k}");
    }
    assert_eq!(found.iter().flatten().count(), 13);
}

#[test]
fn a_continuous_batch_is_its_tracks_and_the_other_kind_is_refused() {
    let problems: Vec<_> = (0..4).map(|k| Continuous::random(80 + k, [2, 2, 1], 4, 0.1)).collect();
    let of = |problem: &Continuous| {
        let mut data = Data::new(1).starting_at(0.0);
        problem.rows().for_each(|row| data.push(row.time, row.z).unwrap());
        (data, problem.prior())
    };
    let parts: Vec<_> = problems.iter().map(of).collect();
    let tracks: Vec<Track<'_, Flow, Sensor>> = problems
        .iter()
        .zip(&parts)
        .map(|(problem, (data, prior))| Track::new(&problem.model, &problem.sensor, data, prior))
        .collect();
    let (choice, goal) = (resolve("sr-cd-ckf", &[]).unwrap(), Goal::Interval);
    let found = choice.run_batch_continuous(&tracks, &Batch { goal, ..Batch::default() });
    for (problem, outcome) in problems.iter().zip(&found) {
        let apart = apart(outcome.as_ref().unwrap(), &problem.run(&choice, goal));
        assert!(apart < 1e-11, "{apart:e}");
    }
    let refused = resolve("ckf", &[]).unwrap().run_batch_continuous(&tracks, &Batch::default());
    assert!(refused.iter().flatten().all(|of| of.failure.is_some_and(|(row, _)| row == 0)));
    assert_eq!(refused.len(), 4);
    assert!(choice.run_batch_continuous::<Flow, Sensor>(&[], &Batch::default()).is_empty());
}

/// A sensor that cancels the batch at its nth measurement, and counts.
struct Cancels<'a> {
    sensor: &'a Sensor,
    at: usize,
    seen: AtomicUsize,
    cancel: &'a AtomicBool,
}

impl Observation for Cancels<'_> {
    fn states(&self) -> usize {
        self.sensor.states()
    }
    fn measures(&self) -> usize {
        self.sensor.measures()
    }
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.sensor.observe(at, x, out);
    }
    fn noise(&self) -> Noise {
        self.sensor.noise()
    }
    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        // once for each update
        if self.seen.fetch_add(1, Ordering::Relaxed) + 1 == self.at {
            self.cancel.store(true, Ordering::Relaxed);
        }
        self.sensor.measurement_noise(at, out);
    }
}

#[test]
fn a_batch_is_cancelled_before_the_next_row() {
    let problem = Problem::random(70, 2, 1, 30, 0.0);
    let mut data = Data::new(1).starting_at(0.0);
    problem.rows().for_each(|row| data.push(row.time, &[row.z[0].max(0.0)]).unwrap());
    let (prior, choice) = (problem.prior(), resolve("sr-ckf", &[]).unwrap());
    let one = NonZeroUsize::new(1);
    for goal in [Goal::Filter, Goal::Interval] {
        let cancel = AtomicBool::new(false);
        // the first track ends, the second is cancelled at its fifth row, the third is never begun
        let sensor = Cancels { sensor: &problem.sensor, at: 35, seen: AtomicUsize::new(0), cancel: &cancel };
        let tracks = [Track::new(&problem.model, &sensor, &data, &prior); 3];
        let batch = Batch {
            goal,
            threads: one,
            vectors: InstructionSet::Portable,
            cancel: Some(&cancel),
            rows: None,
        };
        let found = choice.run_batch(&tracks, &batch);
        let done: Vec<bool> = found.iter().map(Option::is_some).collect();
        assert_eq!(done, [true, false, false], "{goal:?}");
        assert_eq!(sensor.seen.load(Ordering::Relaxed), 35, "{goal:?}");
    }
}

#[test]
fn a_batch_counts_the_rows_that_it_takes_in() {
    let problems = problems();
    for (method, goal) in [("sr-ckf", Goal::Filter), ("sr-ckf", Goal::Interval), ("ckf", Goal::Interval)] {
        let rows = AtomicUsize::new(0);
        let batch = Batch { goal, rows: Some(&rows), ..Batch::default() };
        resolve(method, &[]).unwrap().run_batch(&tracks(&problems), &batch);
        // of the track that fails, those before
        let expected = problems.iter().map(|(_, data, _)| data.len()).sum::<usize>() - 1;
        assert_eq!(rows.load(Ordering::Relaxed), expected, "{method} {goal:?}");
    }
}

#[test]
fn a_visitor_ends_the_way_back() {
    use givens::filter::{Ckf, Filter, Over, Prior, SrCkf};
    use givens::rule::Rule;
    use givens::smoother::{History, Smoothed};
    fn visited<X: Over<Motion>>(method: X, square_root: bool) -> (usize, usize) {
        let problem = Problem::random(71, 2, 1, 6, 0.0);
        let (sizes, prior) = (method.sizes(&problem.model).unwrap(), problem.prior());
        let sizes = sizes.with_sensor(&problem.sensor, method.rule().shape(2));
        let memory = vec![0.0; Filter::<X, Motion, f64, Vec<f64>>::memory_len(&method, sizes, true)];
        let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
        let mut filter = Filter::start_in(method, &problem.model, sizes, true, prior, memory).unwrap();
        let memory = vec![0.0; History::<f64, Vec<f64>>::memory_len(2, 6)];
        let mut history = History::new(2, square_root, memory);
        for row in problem.rows() {
            history.predict(&mut filter, row.time).unwrap();
            filter.update_present(&problem.sensor, row.z, &[!row.z[0].is_nan()]).unwrap();
        }
        let (mut smoothed, mut drawn) = (0, 0);
        let until = |age: usize| if age < 2 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
        let visit = |age: usize, _: &Smoothed<f64>| {
            smoothed += 1;
            until(age)
        };
        history.smooth(&filter, 6, visit).unwrap();
        let visit = |age: usize, _: usize, _: &[f64]| {
            drawn += 1;
            until(age)
        };
        history.sample(&filter, 6, &mut [0.0; 2], |_| 0.5, visit).unwrap();
        (smoothed, drawn)
    }
    assert_eq!(visited(Ckf::DEFAULT, false), (3, 3));
    assert_eq!(visited(SrCkf::DEFAULT, true), (3, 3));
}
