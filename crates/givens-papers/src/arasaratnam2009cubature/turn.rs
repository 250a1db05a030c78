//! The aircraft, its radar, and runs of the filters after it.

use crate::{Failures, Plan, Trouble};
use givens::filter::Gaussian;
use givens::kernels::cholesky;
use givens::model::zoo::{CoordinatedTurn, RangeBearing};
use givens::model::{At, Noise, Observation, Transition};
use givens::registry::{Choice, resolve};
use givens::scalar::Real;
use givens::simulate::Stream;
use givens::{Data, Estimates, Goal, Outcome};

/// Runs that the paper makes.
pub(super) const OWN: usize = 250;
/// Scans of a run, one a second.
pub(super) const SCANS: usize = 100;
/// A track is lost that is ever further off than this, m.
const LOST_M: f64 = 500.0;

const START: [f64; 5] = [1000.0, 300.0, 1000.0, 0.0, -3.0 * core::f64::consts::PI / 180.0];
const START_VARIANCE: [f64; 5] = [100.0, 10.0, 100.0, 10.0, 1e-4];

/// The two scenarios, by their measurement noise, and a reading of the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scenario {
    /// Gaussian.
    Gaussian,
    /// A mixture of two Gaussians, one as likely as the other.
    Mixture,
    /// Gaussian, and bearings are numbers: nothing is wrapped where they jump by 2π.
    Unwrapped,
}

impl Scenario {
    /// Of its random numbers.
    const fn track(self) -> u32 {
        match self {
            Scenario::Gaussian | Scenario::Unwrapped => 2_009_801,
            Scenario::Mixture => 2_009_802,
        }
    }

    /// The covariances of its components, m² and rad².
    const fn components(self) -> [[f64; 4]; 2] {
        match self {
            Scenario::Gaussian | Scenario::Unwrapped => [[100.0, 0.0, 0.0, 1e-5]; 2],
            Scenario::Mixture => [[100.0, 15e-3, 15e-3, 1e-5], [5.0, 10e-3, 10e-3, 1e-4]],
        }
    }

    /// A radar that believes in a Gaussian of the same covariance.
    fn radar(self) -> Radar {
        let [a, b] = self.components();
        Radar { cov: core::array::from_fn(|i| 0.5 * (a[i] + b[i])), wraps: self != Scenario::Unwrapped }
    }
}

/// Range and bearing from the origin, with correlated noise.
struct Radar {
    cov: [f64; 4],
    wraps: bool,
}

impl Observation for Radar {
    fn states(&self) -> usize {
        5
    }
    fn measures(&self) -> usize {
        2
    }
    fn angle(&self, i: usize) -> Option<f64> {
        RangeBearing::published().angle(i).filter(|_| self.wraps)
    }
    #[inline(always)]
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        RangeBearing::published().observe(at, x, out);
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&self.cov.map(T::of));
    }
}

/// The outcomes of one method.
pub(super) struct Runs<R> {
    /// What was made of each run; nothing of one that halted.
    pub each: Vec<Option<R>>,
    /// Those that halted.
    pub halted: Failures,
}

impl<R> Runs<R> {
    /// What was made of the runs that came to their end.
    pub fn ended(&self) -> impl Iterator<Item = &R> {
        self.each.iter().flatten()
    }
}

/// The answer of each method to each of `runs` runs, as `of` sees it: the outcome, complete, beside the true states.
pub(super) fn runs<R: Send>(
    plan: &Plan,
    scenario: Scenario,
    runs: usize,
    methods: &[&str],
    of: impl Fn(&Outcome, &[[f64; 5]]) -> R + Sync,
) -> Result<Vec<Runs<R>>, Trouble> {
    let choices: Vec<Choice> = methods.iter().map(|method| resolve(method, &[])).collect::<Result<_, _>>()?;
    let answers = plan.each(runs, |run| -> Result<Vec<_>, Trouble> {
        let (truth, data, prior) = drawn(scenario, plan.seed, run)?;
        let one = |choice: &Choice| {
            let outcome = filtered(choice, scenario, &data, &prior);
            match outcome.failure {
                Some((_, error)) => Err(error),
                None => Ok(of(&outcome, &truth)),
            }
        };
        Ok(choices.iter().map(one).collect())
    });
    let none = |_| Runs { each: Vec::new(), halted: Failures::default() };
    let mut all: Vec<Runs<R>> = methods.iter().map(none).collect();
    for run in answers {
        for (all, answer) in all.iter_mut().zip(run?) {
            if let Err(error) = &answer {
                all.halted.note(error);
            }
            all.each.push(answer.ok());
        }
    }
    Ok(all)
}

fn filtered(choice: &Choice, scenario: Scenario, data: &Data, prior: &Gaussian) -> Outcome {
    let (aircraft, radar) = (CoordinatedTurn::default(), scenario.radar());
    choice.run(&aircraft, &radar, data.rows(), data.start(), prior, Goal::Filter, &[])
}

/// The true states at the scans, the measurements, and the initial belief.
fn drawn(scenario: Scenario, seed: u64, run: u32) -> Result<(Vec<[f64; 5]>, Data, Gaussian), Trouble> {
    let (aircraft, radar) = (CoordinatedTurn::default(), scenario.radar());
    let mut stream = Stream::new(seed, scenario.track(), run);
    let std = START_VARIANCE.map(f64::sqrt);
    let mean: [f64; 5] = core::array::from_fn(|i| START[i] + std[i] * stream.normal());
    let at = At { t: 0.0, dt: 1.0, u: &[], p: &[] };
    let mut q = [0.0; 25];
    aircraft.process_noise(&at, &mut q);
    root(&mut q, 5)?;
    let mut noise = scenario.components();
    noise.iter_mut().try_for_each(|cov| root(cov, 2))?;
    let (mut truth, mut data, mut x) = (Vec::with_capacity(SCANS), Data::new(2).starting_at(0.0), START);
    for k in 1..=SCANS {
        let mut next = [0.0; 5];
        aircraft.transition(&at, &x, &mut next);
        x = next;
        disturb(&mut x, &q, &mut stream);
        let mut z = [0.0; 2];
        radar.observe(&At { dt: 0.0, ..at }, &x, &mut z);
        let component = usize::from(stream.normal() > 0.0);
        disturb(&mut z, &noise[component], &mut stream);
        truth.push(x);
        data.push(k as f64, &z)?;
    }
    Ok((truth, data, Gaussian::from_std(&mean, &std)?))
}

/// The lower Cholesky factor of a noise covariance, in its place.
fn root(cov: &mut [f64], n: usize) -> Result<(), Trouble> {
    match cholesky(cov, n).failed() {
        None => Ok(()),
        Some(pivot) => Err(format!("a noise covariance has no root (pivot {})", pivot + 1).into()),
    }
}

/// Adds S w to `x`, w standard normal.
fn disturb<const N: usize>(x: &mut [f64; N], root: &[f64], stream: &mut Stream) {
    let w: [f64; N] = core::array::from_fn(|_| stream.normal());
    for (x, row) in x.iter_mut().zip(root.chunks_exact(N)) {
        *x += row.iter().zip(&w).map(|(s, w)| s * w).sum::<f64>();
    }
}

/// The squared error of the position, m².
pub(super) fn off(mean: &[f64], truth: &[f64; 5]) -> f64 {
    (mean[0] - truth[0]).powi(2) + (mean[2] - truth[2]).powi(2)
}

/// The first scan, from zero, at which the track is lost.
pub(super) fn first_lost(est: &Estimates, truth: &[[f64; 5]]) -> Option<usize> {
    (0..est.len()).find(|&k| off(est.mean(k), &truth[k]) > LOST_M * LOST_M)
}
