//! A track of a batch is the same to the bit whatever other tracks stand beside it.

use super::packs::{steady, tracks_of};
use givens::batch::{Batch, Track};
use givens::filter::Gaussian;
use givens::model::Observation;
use givens::registry::{Choice, Setting, resolve};
use givens::{Data, Goal, Outcome};
use givens_tests::choices::choices;
use givens_tests::models::Problem;
use givens_tests::sde::Continuous;

/// Every one of the tracks as it comes out of all, of all in another order, of some, and by itself.
fn same<'a, M, H>(
    name: &str,
    tracks: &[Track<'a, M, H>],
    run: impl Fn(&[Track<'a, M, H>], Goal) -> Vec<Option<Outcome>>,
) {
    let last = tracks.len() - 1;
    let all: Vec<usize> = (0..=last).collect();
    let some = |which: fn(&usize) -> bool| all.iter().copied().filter(which).collect::<Vec<_>>();
    for goal in [Goal::Filter, Goal::Interval] {
        let told = |which: &[usize]| -> Vec<String> {
            let chosen: Vec<_> = which.iter().map(|&k| tracks[k]).collect();
            run(&chosen, goal).iter().map(|outcome| format!("{outcome:?}")).collect()
        };
        let expected = told(&all);
        let others = [all.iter().rev().copied().collect(), some(|k| k % 3 != 1)];
        for which in others.into_iter().chain(all.iter().step_by(2).map(|&k| vec![k])) {
            for (&k, found) in which.iter().zip(told(&which)) {
                assert!(
                    found == expected[k],
                    "{name} {goal:?}, track {k} of {which:?}:\n{found}\n{}",
                    expected[k]
                );
            }
        }
    }
}

/// Tracks with missing components, without any, and one that fails; and priors of which some know a state exactly.
fn mixed(z: &[Vec<f64>], whole: bool, time: impl Fn(usize, f64) -> f64) -> Vec<Data> {
    let d = z[0].len();
    let fill = |data: Data| {
        let mut full = Data::new(d).starting_at(data.start());
        for (k, row) in data.rows().enumerate() {
            let lost = k % 5 == 2;
            let one = |z: &f64| {
                if lost {
                    f64::NAN
                } else if z.is_nan() {
                    0.25
                } else {
                    *z
                }
            };
            full.push(row.time, &row.z.iter().map(one).collect::<Vec<_>>()).unwrap();
        }
        full
    };
    let mut all: Vec<Data> =
        tracks_of(z, 311, time).into_iter().map(|data| if whole { fill(data) } else { data }).collect();
    let mut far = Data::new(d).starting_at(0.0);
    for k in 0..6 {
        far.push(f64::from(k), &vec![if k == 3 { 1e300 } else { 0.5 }; d]).unwrap();
    }
    all[4] = far;
    all
}

fn known(prior: &Gaussian) -> Gaussian {
    let n = prior.mean().len();
    let std: Vec<f64> = (0..n).map(|i| if i == 1 { 0.0 } else { prior.cov()[i * n + i].sqrt() }).collect();
    Gaussian::from_std(prior.mean(), &std).unwrap()
}

fn gated(name: &str) -> (String, Choice) {
    let gate = Setting { key: "gate".to_owned(), value: "0.9".into() };
    (format!("{name}, gated"), resolve(name, &[gate]).unwrap())
}

fn tracks<'a, M, H: Observation>(
    model: &'a M,
    sensor: &'a H,
    data: &'a [Data],
    priors: &'a [Gaussian; 2],
) -> Vec<Track<'a, M, H>> {
    data.iter()
        .enumerate()
        .map(|(k, data)| Track::new(model, sensor, data, &priors[usize::from(k % 4 == 1)]))
        .collect()
}

#[test]
fn of_every_discrete_method() {
    let problem = Problem::random(310, 3, 2, 12, 0.05);
    let priors = [problem.prior(), known(&problem.prior())];
    for whole in [false, true] {
        let data = mixed(&problem.z, whole, |row, _| (row - usize::from(row % 5 == 3)) as f64);
        let tracks = tracks(&problem.model, &problem.sensor, &data, &priors);
        for (name, choice) in choices(3).into_iter().chain([gated("sr-ckf"), gated("ukf")]) {
            same(&name, &tracks, |tracks, goal| {
                choice.run_batch(tracks, &Batch { goal, ..Batch::default() })
            });
        }
    }
}

#[test]
fn of_every_continuous_method_with_steps_of_its_own() {
    let problem = Continuous::random(312, [3, 2, 2], 12, 0.1);
    let priors = [problem.prior(), known(&problem.prior())];
    for whole in [false, true] {
        // some rows stand at the time of the row above
        let data = mixed(&problem.z, whole, |_, at| (2.0 * at).floor() / 2.0);
        let tracks = tracks(&problem.model, &problem.sensor, &data, &priors);
        for (name, choice) in steady(3).into_iter().chain([gated("sr-cd-ckf"), gated("cd-ukf")]) {
            let run = |tracks: &[Track<_, _>], goal| {
                choice.run_batch_continuous(tracks, &Batch { goal, ..Batch::default() })
            };
            same(&name, &tracks, run);
        }
    }
}
