//! The seven filters, and all runs of them at one sampling interval.

use super::ekf;
use crate::radar::{Diverged, Lost, Radar, Scene, about, method, position};
use crate::{Failures, Plan, Trouble};
use givens::model::zoo::Turn3d;
use givens::registry::Choice;
use givens::simulate::Stream;

/// Runs that the paper makes.
pub(super) const OWN: usize = 100;
/// Steps of an interval, M.
pub(super) const STEPS: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];
/// s.
const LENGTH: f64 = 210.0;
/// An error beyond this, m, is a divergence.
const LOST: f64 = 1000.0;

/// A filter: its key in the expected numbers, its name in print, that of the registry (none: the extended filter, which is
/// counted without a test of its covariance), and whether it integrates the moments.
pub(super) struct Method {
    pub key: &'static str,
    pub name: &'static str,
    registry: Option<&'static str>,
    pub moments: bool,
}

const fn of(key: &'static str, name: &'static str, registry: Option<&'static str>, moments: bool) -> Method {
    Method { key, name, registry, moments }
}

pub(super) const METHODS: [Method; 7] = [
    of("ekf", "CD-EKF", None, true),
    of("ckf1", "CD-CKF1", Some("cd-ckf1"), false),
    of("ukf1", "CD-UKF1", Some("cd-ukf1"), false),
    of("ghkf1", "CD-GHKF1", Some("cd-ghkf1"), false),
    of("ckf2", "CD-CKF2", Some("cd-ckf2"), true),
    of("ukf2", "CD-UKF2", Some("cd-ukf2"), true),
    of("ghkf2", "CD-GHKF2", Some("cd-ghkf2"), true),
];

impl Method {
    fn choice(&self, steps: usize) -> Result<Option<Choice>, Trouble> {
        let steps = steps.to_string();
        let settings = [("substeps", steps.as_str()), ("solver", "rk4")];
        let read = if self.moments { &settings[..] } else { &settings[..1] };
        self.registry.map(|name| method(name, read)).transpose()
    }
}

/// The experiment at an interval, in seconds.
pub(super) fn scene(interval: f64) -> Scene {
    Scene {
        turn: Turn3d { rate: 7e-4, ..Turn3d::default() },
        radar: Radar::default(),
        omega: 6.0,
        interval,
        scans: (LENGTH / interval) as usize,
    }
}

/// What became of the runs of one filter with one number of steps.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    /// The runs that the paper counts.
    pub lost: Failures,
    /// Runs that went on although their error exceeded the bound: the extended filter's only, which are not counted.
    pub strayed: usize,
    /// Of each run the mean square of the error in position, m²; `None` where it failed or its error exceeded the bound,
    /// counted or not: alike for all filters.
    pub kept: Vec<Option<f64>>,
    /// The same, and `None` only where it failed.
    pub ended: Vec<Option<f64>>,
}

/// By method, then by number of steps.
pub(super) type Cells = [[Cell; STEPS.len()]; METHODS.len()];

/// What became of one run, and the mean square of its error in position, m².
type Answer = (Option<Lost>, f64);

/// All runs, over one path and from one start each, of the filters wanted: pairs of a position in [`METHODS`] and M.
fn answers(plan: &Plan, interval: f64, wanted: &[(usize, usize)]) -> Result<Vec<Vec<Answer>>, Trouble> {
    let scene = scene(interval);
    let std = [100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 1f64.to_radians()];
    let far: Diverged = |errors| errors.iter().any(|error| position(error) > LOST);
    let runs = plan.each(plan.runs(OWN), |run| -> Result<Vec<Answer>, Trouble> {
        let mut stream = Stream::new(plan.seed, 201_200 + interval as u32, run);
        let prior = about(&scene.begin(), &std, &mut stream)?;
        let drawn = scene.draw(1, &mut stream)?;
        let one = |&(method, steps): &(usize, usize)| {
            let track = match METHODS[method].choice(steps)? {
                Some(choice) => scene.track(&choice, &prior, 0, 1, &drawn, far)?,
                None => ekf::track(&scene, steps, &prior, &drawn, far)?,
            };
            let squares = track.errors.iter().map(|error| position(error).powi(2));
            Ok((track.lost, squares.sum::<f64>() / track.errors.len() as f64))
        };
        wanted.iter().map(one).collect()
    });
    runs.into_iter().collect()
}

impl Cell {
    fn note(&mut self, method: usize, (lost, square): Answer) {
        match lost {
            Some(Lost::Diverged) if METHODS[method].registry.is_none() => self.strayed += 1,
            Some(lost) => self.lost.note_lost(&lost),
            None => {}
        }
        self.kept.push(lost.is_none().then_some(square));
        self.ended.push(matches!(lost, None | Some(Lost::Diverged)).then_some(square));
    }
}

/// All runs at an interval.
pub(super) fn cells(plan: &Plan, interval: f64) -> Result<Cells, Trouble> {
    let wanted: Vec<_> = (0..METHODS.len()).flat_map(|method| STEPS.map(|steps| (method, steps))).collect();
    let mut cells = Cells::default();
    for run in answers(plan, interval, &wanted)? {
        for (at, answer) in run.into_iter().enumerate() {
            let method = at / STEPS.len();
            cells[method][at % STEPS.len()].note(method, answer);
        }
    }
    Ok(cells)
}

/// How many runs of one filter are lost, as the paper counts them: `key` is that of `expected/`, `interval` in seconds.
///
/// # Errors
/// A key that is none, or steps out of their range.
pub fn lost(plan: &Plan, key: &str, interval: f64, steps: usize) -> Result<usize, Trouble> {
    let method = METHODS.iter().position(|method| method.key == key);
    let method = method.ok_or_else(|| format!("no filter `{key}`"))?;
    let mut cell = Cell::default();
    for run in answers(plan, interval, &[(method, steps)])? {
        for answer in run {
            cell.note(method, answer);
        }
    }
    Ok(cell.lost.count())
}
