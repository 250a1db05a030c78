//! The target, and one run of each estimator after it.

use crate::statistics::mean;
use crate::{Failures, Plan, Trouble};
use givens::filter::Gaussian;
use givens::model::zoo::{RangeAside, Reentry};
use givens::model::{At, Noise, Observation, Sde, Transition};
use givens::registry::resolve;
use givens::scalar::Real;
use givens::simulate::Stream;
use givens::{Data, Estimates, Goal, Outcome};

/// Runs that the paper makes.
pub(super) const OWN: usize = 1000;
pub(super) const ROWS: usize = 60;
const STEP: f64 = 0.5;

/// The estimators: name, that of the registry, whether smoothed.
pub(super) const ESTIMATORS: [(&str, &str, bool); 5] = [
    ("ckf", "sr-ckf", false),
    ("eks", "sr-ekf", true),
    ("cdks", "sr-cdkf", true),
    ("qks", "sr-qkf", true),
    ("cks", "sr-ckf", true),
];

/// Euler's map of the re-entry (2011 eq 43), without noise.
struct EulerMap(Reentry);

impl Transition for EulerMap {
    fn states(&self) -> usize {
        3
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.0.drift(at, x, out);
        for (out, &x) in out.iter_mut().zip(x) {
            *out = at.dt.mul_add(*out, x);
        }
    }
    fn noise(&self) -> Noise {
        Noise::Root(0)
    }
    fn process_noise<T: Real>(&self, _: &At<T>, _: &mut [T]) {}
}

/// What one estimator made of one run.
pub(super) struct Track {
    /// Squared errors of each row.
    pub squares: Vec<[f64; 3]>,
    /// The coefficient, less that of the filter at the last row, in the filter's standard deviations there: of all rows that
    /// which is farthest from it.
    pub constant: f64,
}

impl Track {
    /// Of the errors of a state, over the rows.
    pub fn mean_square(&self, state: usize) -> f64 {
        mean(self.squares.iter().map(|row| row[state]))
    }
}

/// The tracks by estimator, then by run, `None` for one that failed; and what failed.
pub(super) type Runs = (Vec<Vec<Option<Track>>>, Vec<(String, Failures)>);

/// All runs of the estimators that are wanted.
pub(super) fn tracks(plan: &Plan, wanted: &[(&str, &str, bool)]) -> Result<Runs, Trouble> {
    let answers = plan.each(plan.runs(OWN), |run| -> Result<Vec<_>, Trouble> {
        let (truth, data) = drawn(plan.seed, run)?;
        let one = |&(_, method, smoothed): &(_, &str, bool)| {
            let outcome = estimate(method, smoothed, &data)?;
            Ok(match outcome.failure {
                Some((_, error)) => Err(error),
                None => Ok(track(&outcome.estimates, &truth)),
            })
        };
        wanted.iter().map(one).collect()
    });
    let mut tracks: Vec<Vec<Option<Track>>> = wanted.iter().map(|_| Vec::new()).collect();
    let named = |name: &str| format!("{}, square-root form", name.to_uppercase());
    let mut failures: Vec<_> = wanted.iter().map(|(name, ..)| (named(name), Failures::default())).collect();
    for run in answers {
        for (i, answer) in run?.into_iter().enumerate() {
            if let Err(error) = &answer {
                failures[i].1.note(error);
            }
            tracks[i].push(answer.ok());
        }
    }
    Ok((tracks, failures))
}

/// The true states of the rows, the same in every run, and measurements of them.
fn drawn(seed: u64, run: u32) -> Result<(Vec<[f64; 3]>, Data), Trouble> {
    let (map, radar, mut stream) =
        (EulerMap(Reentry::default()), RangeAside::default(), Stream::new(seed, 2011, run));
    let (mut truth, mut data) = (Vec::with_capacity(ROWS), Data::new(1).starting_at(0.0));
    let mut x = [61e3, 3048.0, 4.49e-4];
    for k in 1..=ROWS {
        let mut next = [0.0; 3];
        map.transition(&At { t: 0.0, dt: STEP, u: &[], p: &[] }, &x, &mut next);
        x = next;
        let mut z = [0.0];
        radar.observe(&At { t: 0.0, dt: 0.0, u: &[], p: &[] }, &x, &mut z);
        truth.push(x);
        data.push(STEP * k as f64, &[z[0] + radar.std * stream.normal()])?;
    }
    Ok((truth, data))
}

fn estimate(method: &str, smoothed: bool, data: &Data) -> Result<Outcome, Trouble> {
    let choice = resolve(method, &[])?;
    let prior = Gaussian::from_std(&[62e3, 3400.0, 1e-5], &[1e3, 100.0, 1e-2])?;
    let goal = if smoothed { Goal::Interval } else { Goal::Filter };
    let (map, radar) = (EulerMap(Reentry::default()), RangeAside::default());
    Ok(choice.run(&map, &radar, data.rows(), data.start(), &prior, goal, &[]))
}

fn track(est: &Estimates, truth: &[[f64; 3]]) -> Track {
    let error = |k: usize, i: usize| (est.mean(k)[i] - truth[k][i]).powi(2);
    let squares = (0..est.len()).map(|k| [0, 1, 2].map(|i| error(k, i))).collect();
    let last = ROWS - 1;
    let constant = if est.is_smoothed() {
        let from = |k: usize| (est.mean(k)[2] - est.filtered_mean(last)[2]).abs();
        (0..=last).map(from).fold(0.0, f64::max) / est.filtered_cov(last)[8].sqrt()
    } else {
        f64::NAN
    };
    Track { squares, constant }
}
