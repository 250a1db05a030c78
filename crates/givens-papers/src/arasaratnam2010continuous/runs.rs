//! The filters, the readings of what the paper leaves open, and all runs at one sampling interval.

use super::start::two_points;
use crate::radar::{Diverged, Drawn, Lost, Radar, Scene, Track, method, position};
use crate::{Failures, Plan, Trouble};
use givens::filter::Gaussian;
use givens::model::zoo::Turn3d;
use givens::registry::Choice;
use givens::simulate::Stream;

/// Runs that the paper makes.
pub(super) const OWN: usize = 100;
/// Turn rates, degrees per second.
pub(super) const OMEGAS: [f64; 3] = [3.0, 4.5, 6.0];
/// Steps of an interval, m, of the reading that the figures show.
pub(super) const STEPS: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];
/// Those of the other readings.
const FEWER: [usize; 3] = [1, 8, 64];
/// s.
const LENGTH: f64 = 210.0;
/// Errors are scored from here on, s.
const SCORED: f64 = 60.0;
/// An error beyond this, m, is a divergence.
const BEYOND: f64 = 500.0;

/// How the turn rate was started, which the paper does not say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Start {
    /// Drawn from N(ω, (1°/s)²).
    Drawn,
    /// Nought, with 6°/s.
    Nought,
}

/// A reading of what the paper leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading {
    /// σ₂, rad/s per √s: 7·10⁻³ is printed; 7·10⁻⁴ stands in the authors' program, and the counts of 2012 were made with
    /// it.
    pub sigma: f64,
    pub start: Start,
}

/// The first is that of the figures.
pub(super) const READINGS: [Reading; 4] = [
    Reading { sigma: 7e-4, start: Start::Drawn },
    Reading { sigma: 7e-4, start: Start::Nought },
    Reading { sigma: 7e-3, start: Start::Drawn },
    Reading { sigma: 7e-3, start: Start::Nought },
];

impl Reading {
    pub fn name(self) -> String {
        let sigma = if self.sigma < 1e-3 { "7·10⁻⁴" } else { "7·10⁻³" };
        let start = match self.start {
            Start::Drawn => "drawn about ω",
            Start::Nought => "nought ± 6°/s",
        };
        format!("σ₂ = {sigma}, rate {start}")
    }

    pub fn steps(self) -> &'static [usize] {
        if self == READINGS[0] { &STEPS } else { &FEWER }
    }
}

/// A filter: its name in print, its registry name, and settings.
type Method = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

/// The filters. Of the CD-UKF the paper's words allow two.
pub(super) const METHODS: [Method; 4] = [
    ("CD-EKF", "cd-ekf", &[("time_update", "euler-maruyama")]),
    ("CD-UKF", "cd-ukf", &[("time_update", "euler-maruyama")]),
    ("CD-UKF (Euler's moments)", "cd-ukf", &[("solver", "euler")]),
    ("CD-CKF", "sr-cd-ckf", &[]),
];
/// Positions in [`METHODS`].
pub(super) const EKF: usize = 0;
pub(super) const UKF: usize = 1;
pub(super) const CKF: usize = 3;

pub(super) fn form(method: usize) -> &'static str {
    if method == CKF { "square-root form" } else { "covariance form" }
}

fn choice(of: usize, steps: usize) -> Result<Choice, Trouble> {
    let (_, name, settings) = METHODS[of];
    let steps = steps.to_string();
    method(name, &[settings, &[("substeps", steps.as_str())]].concat())
}

pub(super) fn scene(sigma: f64, omega: f64, interval: f64) -> Scene {
    let turn = Turn3d { rate: sigma, ..Turn3d::default() };
    Scene { turn, radar: Radar::default(), omega, interval, scans: (LENGTH / interval) as usize }
}

/// What became of the runs of one filter with one number of steps.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    pub lost: Failures,
    /// Of each run the mean squares of the errors in position, velocity and turn rate (m, m/s, rad/s); `None` of a lost one.
    pub squares: Vec<Option<[f64; 3]>>,
}

/// All runs at one interval: by reading, turn rate, filter and number of steps (as [`Reading::steps`]).
pub(super) struct Cells(Vec<Cell>);

impl Cells {
    fn at(reading: usize, omega: usize, method: usize, steps: usize) -> usize {
        ((reading * OMEGAS.len() + omega) * METHODS.len() + method) * STEPS.len() + steps
    }

    pub fn get(&self, reading: usize, omega: usize, method: usize, steps: usize) -> &Cell {
        &self.0[Self::at(reading, omega, method, steps)]
    }

    pub fn none() -> Self {
        Self(vec![Cell::default(); Self::at(READINGS.len(), 0, 0, 0)])
    }

    #[cfg(test)]
    pub fn get_mut(&mut self, reading: usize, omega: usize, method: usize, steps: usize) -> &mut Cell {
        &mut self.0[Self::at(reading, omega, method, steps)]
    }
}

/// All runs at an interval, in seconds.
pub(super) fn cells(plan: &Plan, interval: f64) -> Result<Cells, Trouble> {
    let answers = plan.each(plan.runs(OWN), |run| one(plan.seed, run, interval));
    let mut cells = Cells::none();
    for answer in answers {
        for (at, squares) in answer? {
            let cell = &mut cells.0[at];
            if let Err(lost) = &squares {
                cell.lost.note_lost(lost);
            }
            cell.squares.push(squares.ok());
        }
    }
    Ok(cells)
}

/// The path of one run, which does not depend on how the filters start.
struct World {
    scene: Scene,
    drawn: Drawn,
    /// For the start: a stream of its own.
    own: Stream,
}

impl World {
    fn new(seed: u64, run: u32, sigma: f64, omega: f64, interval: f64) -> Result<Self, Trouble> {
        let scene = scene(sigma, omega, interval);
        // 2010, then ω and T and σ₂ as one figure each
        let track =
            20_100_000 + 1000 * (10.0 * omega) as u32 + 10 * interval as u32 + u32::from(sigma > 1e-3);
        let drawn = scene.draw(0, &mut Stream::new(seed, track, run))?;
        Ok(Self { scene, drawn, own: Stream::new(seed, track + 5, run) })
    }

    fn start(&self, start: Start) -> Result<Gaussian, Trouble> {
        match self.drawn.z.as_slice() {
            [first, second, ..] => two_points(&self.scene, [first, second], start, &mut self.own.clone()),
            _ => Err("a run needs two measurements to start from".into()),
        }
    }

    fn track(&self, prior: &Gaussian, method: usize, steps: usize) -> Result<Track, Trouble> {
        self.scene.track(&choice(method, steps)?, prior, 1, 0, &self.drawn, FAR)
    }
}

/// What is kept of a run of one filter: mean squares, or why it was lost.
type Answer = Result<[f64; 3], Lost>;

/// One run of everything: of each cell.
fn one(seed: u64, run: u32, interval: f64) -> Result<Vec<(usize, Answer)>, Trouble> {
    let mut tracks = Vec::new();
    for (i, omega) in OMEGAS.into_iter().enumerate() {
        for readings in READINGS.as_chunks::<2>().0 {
            let world = World::new(seed, run, readings[0].sigma, omega, interval)?;
            for reading in readings {
                let r = READINGS.iter().position(|of| of == reading).unwrap_or_default();
                let prior = world.start(reading.start)?;
                for method in 0..METHODS.len() {
                    for (s, &steps) in reading.steps().iter().enumerate() {
                        let track = world.track(&prior, method, steps)?;
                        let answer = track.lost.map_or_else(|| Ok(squares(&track.errors, interval)), Err);
                        tracks.push((Cells::at(r, i, method, s), answer));
                    }
                }
            }
        }
    }
    Ok(tracks)
}

/// How many runs of the CD-CKF are lost: σ₂ in rad/s per √s, ω in °/s, the interval in s, the rate started at nought or drawn
/// about ω.
///
/// # Errors
/// Steps out of their range.
pub fn lost(
    plan: &Plan,
    sigma: f64,
    nought: bool,
    omega: f64,
    interval: f64,
    steps: usize,
) -> Result<usize, Trouble> {
    let start = if nought { Start::Nought } else { Start::Drawn };
    let runs = plan.each(plan.runs(OWN), |run| -> Result<bool, Trouble> {
        let world = World::new(plan.seed, run, sigma, omega, interval)?;
        Ok(world.track(&world.start(start)?, CKF, steps)?.lost.is_some())
    });
    runs.into_iter().try_fold(0, |sum, lost| Ok(sum + usize::from(lost?)))
}

const FAR: Diverged = |errors| errors.iter().any(|error| position(error) > BEYOND);

/// The mean squares from [`SCORED`] on; the first error is that of the third measurement.
fn squares(errors: &[[f64; 7]], interval: f64) -> [f64; 3] {
    let skip = ((SCORED / interval).ceil() as usize).saturating_sub(2);
    let scored = errors.get(skip..).unwrap_or_default();
    let mean = |of: fn(&[f64; 7]) -> f64| scored.iter().map(of).sum::<f64>() / scored.len() as f64;
    [
        mean(|e| e[0] * e[0] + e[2] * e[2] + e[4] * e[4]),
        mean(|e| e[1] * e[1] + e[3] * e[3] + e[5] * e[5]),
        mean(|e| e[6] * e[6]),
    ]
}
