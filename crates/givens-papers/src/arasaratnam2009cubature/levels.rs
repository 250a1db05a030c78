//! True and estimated errors from 50 to 100 s: the levels of figures 8 and 10.

use super::turn::{OWN, Runs, SCANS, Scenario, first_lost, off, runs};
use crate::page::Table;
use crate::paired::ratio;
use crate::statistics::{root_mean, root_of};
use crate::{Estimate, Failures, Plan, Trouble};
use givens::Outcome;

/// The paper's filters, by the names of the registry.
const METHODS: [&str; 4] = ["sr-ekf", "sr-ukf", "sr-cdkf", "sr-ckf"];
pub(super) const NAMES: [&str; 4] = ["EKF", "UKF", "CDKF", "CKF"];
pub(super) const CDKF: usize = 2;
pub(super) const CKF: usize = 3;
/// What the errors are of, in the order of all arrays.
pub(super) const QUANTITIES: [&str; 3] = ["position, m", "velocity, m/s", "turn rate, °/s"];
/// The first scan that counts.
pub(super) const FIRST: usize = 50;

const LOST: &str = "further off than 500 m (these stand in the errors)";

/// One run of one filter, from 50 s on.
pub(super) struct Track {
    /// Squared errors of position, velocity and turn rate (°/s).
    squares: Vec<[f64; 3]>,
    /// The filter's own variances of them.
    variances: Vec<[f64; 3]>,
    lost: bool,
}

/// Which rows of a track.
type Rows = fn(&Track) -> &[[f64; 3]];
/// The true errors.
pub(super) const TRUE: Rows = |track| &track.squares;
/// Those that the filter estimates.
pub(super) const ESTIMATED: Rows = |track| &track.variances;

/// All runs of all filters.
pub(super) struct Levels {
    filters: Vec<Runs<Track>>,
}

impl Levels {
    /// Makes the runs.
    pub fn new(plan: &Plan, scenario: Scenario) -> Result<Self, Trouble> {
        Ok(Self { filters: runs(plan, scenario, plan.runs(OWN), &METHODS, track)? })
    }

    /// The root of the mean square over runs and scans of quantity `i`.
    pub fn level(&self, filter: usize, rows: Rows, i: usize) -> Estimate {
        root_of(self.filters[filter].ended().map(|track| mean(rows(track), i)))
    }

    /// The true error over the runs that were not lost.
    pub fn kept(&self, filter: usize, i: usize) -> Estimate {
        root_of(self.filters[filter].ended().filter(|track| !track.lost).map(|track| mean(&track.squares, i)))
    }

    /// One level over another, on the runs that both ended.
    pub fn ratio(&self, of: (usize, Rows), over: (usize, Rows), i: usize) -> Estimate {
        let squares = |(filter, rows): (usize, Rows)| -> Vec<Option<f64>> {
            let each = self.filters[filter].each.iter();
            each.map(|track| track.as_ref().map(|track| mean(rows(track), i))).collect()
        };
        ratio(&squares(of), &squares(over))
    }

    /// The error at scan 50 + `k` over the runs.
    pub fn at(&self, filter: usize, rows: Rows, k: usize, i: usize) -> f64 {
        root_mean(self.filters[filter].ended().map(|track| rows(track)[k][i]))
    }

    /// The highest point of a filter's curve of true position errors.
    pub fn peak(&self, filter: usize) -> f64 {
        (0..=SCANS - FIRST).map(|k| self.at(filter, TRUE, k, 0)).fold(0.0, f64::max)
    }

    /// How many tracks a filter lost.
    pub fn lost(&self, filter: usize) -> usize {
        self.filters[filter].ended().filter(|track| track.lost).count()
    }

    /// Runs that halted or were lost.
    pub fn failures(&self) -> Vec<(String, Failures)> {
        let of = |(name, runs): (&&str, &Runs<Track>)| {
            let mut failures = runs.halted.clone();
            runs.ended().filter(|track| track.lost).for_each(|_| failures.note_kind(LOST));
            (format!("{name}, square-root form"), failures)
        };
        NAMES.iter().zip(&self.filters).map(of).collect()
    }

    /// The levels of all filters.
    pub fn table(&self) -> Table {
        let columns =
            ["filter", "quantity", "true", "spread", "true, tracks kept", "estimated", "spread of it"];
        let mut table = Table::new("levels", &columns);
        for (filter, name) in NAMES.iter().enumerate() {
            for (i, quantity) in QUANTITIES.iter().enumerate() {
                let (actual, estimated) = (self.level(filter, TRUE, i), self.level(filter, ESTIMATED, i));
                let cells = [
                    actual.value,
                    actual.error,
                    self.kept(filter, i).value,
                    estimated.value,
                    estimated.error,
                ];
                let mut row = vec![(*name).into(), (*quantity).into()];
                row.extend(cells.map(Into::into));
                table.rows.push(row);
            }
        }
        table
    }
}

fn mean(rows: &[[f64; 3]], i: usize) -> f64 {
    rows.iter().map(|row| row[i]).sum::<f64>() / rows.len() as f64
}

fn track(outcome: &Outcome, truth: &[[f64; 5]]) -> Track {
    let est = &outcome.estimates;
    let degrees = 180.0 / core::f64::consts::PI;
    let window = FIRST - 1..SCANS;
    let square = |k: usize| {
        let (mean, truth) = (est.mean(k), &truth[k]);
        let of = |i: usize| (mean[i] - truth[i]).powi(2);
        [off(mean, truth), of(1) + of(3), degrees * degrees * of(4)]
    };
    let variance = |k: usize| {
        let of = |i: usize| est.cov(k)[i * 6];
        [of(0) + of(2), of(1) + of(3), degrees * degrees * of(4)]
    };
    Track {
        squares: window.clone().map(square).collect(),
        variances: window.map(variance).collect(),
        lost: first_lost(est, truth).is_some(),
    }
}
