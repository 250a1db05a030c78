//! Some rows of a long run, through which its figure is drawn: at equal distances, and whatever stands out between them.

use core::ops::Range;
use givens::Estimates;
use givens::metrics::{Truth, chi_squared_band};
use givens_io::figure::NisCounts;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Of a run of up to so many rows, all are drawn.
pub const ALL: usize = 1 << 16;
/// In so many stretches of a longer one the rows are kept at which a curve is lowest or highest.
const STRETCHES: usize = 1024;
/// Points of the line through the means of NIS.
const BLOCKS: usize = 150;

/// What was counted of all rows.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Counts {
    /// Of each state the rows whose error is within 2σ, and those that have one.
    pub states: Vec<[usize; 2]>,
    pub nis: NisCounts,
}

/// Rows that are kept, and what was counted of all.
#[derive(Clone, Serialize, Deserialize)]
pub struct Thinned {
    /// How many there will be.
    rows: usize,
    taken: usize,
    pub kept: Estimates,
    counts: Counts,
    /// Sums of time and of NIS, and how many, of the block at work.
    block: (f64, f64, usize),
    bands: HashMap<usize, (f64, f64)>,
}

impl Thinned {
    /// Nothing yet, of so many `rows` of which some have a measure.
    pub fn new(rows: usize, measured: usize) -> Self {
        let nis = NisCounts { block: (measured / BLOCKS).max(1), ..NisCounts::default() };
        let counts = Counts { nis, ..Counts::default() };
        let (kept, bands) = (Estimates::default(), HashMap::new());
        Self { rows, taken: 0, kept, counts, block: (0.0, 0.0, 0), bands }
    }

    /// What was counted, if not all rows are kept.
    pub fn counts(&self) -> Option<&Counts> {
        (self.rows > ALL).then_some(&self.counts)
    }

    /// Takes in the next rows; the truth of each, if there is one.
    pub fn add(&mut self, est: &Estimates, truth: Option<&Truth>) {
        if self.rows <= ALL {
            (0..est.len()).for_each(|row| self.keep(est, row));
            return;
        }
        self.count(est, truth);
        let (stretch, every) = (self.rows.div_ceil(STRETCHES), self.rows.div_ceil(ALL));
        for begin in (0..est.len()).step_by(stretch) {
            let rows = begin..(begin + stretch).min(est.len());
            let regular = rows.clone().filter(|row| (self.taken + row).is_multiple_of(every));
            let mut keep: Vec<usize> = regular.chain(extremes(est, truth, &rows)).collect();
            keep.extend(self.outliers(est, &rows));
            keep.sort_unstable();
            keep.dedup();
            for row in keep {
                self.keep(est, row);
            }
        }
        self.taken += est.len();
    }

    fn keep(&mut self, est: &Estimates, row: usize) {
        let kept = self.kept.push(est, row);
        debug_assert!(kept, "rows of one run");
    }

    fn band(&mut self, dof: usize) -> (f64, f64) {
        *self.bands.entry(dof).or_insert_with(|| chi_squared_band(dof as f64))
    }

    /// Of some rows those whose NIS is outside of its band, one for each height at which they would be drawn apart.
    fn outliers(&mut self, est: &Estimates, rows: &Range<usize>) -> Vec<usize> {
        let (mut seen, mut found) = (0_u64, Vec::new());
        for row in rows.clone() {
            let (nis, (low, high)) = (est.nis[row], self.band(est.nis_dof[row]));
            let height = 1_u64 << (16.0 * nis.ln_1p()).clamp(0.0, 63.0) as u32;
            if (nis < low || nis > high) && seen & height == 0 {
                seen |= height;
                found.push(row);
            }
        }
        found
    }

    fn count(&mut self, est: &Estimates, truth: Option<&Truth>) {
        let n = est.states();
        self.counts.states.resize(n, [0; 2]);
        for row in 0..est.len() {
            for (i, [inside, known]) in self.counts.states.iter_mut().enumerate() {
                let error = truth.map_or(f64::NAN, |truth| est.mean(row)[i] - truth.states[row * n + i]);
                let deviation = est.std(row, i);
                *known += usize::from(error.is_finite() && deviation.is_finite());
                *inside += usize::from(error.is_finite() && error.abs() <= 2.0 * deviation);
            }
            let (nis, dof) = (est.nis[row], est.nis_dof[row]);
            if est.gated[row] {
                self.counts.nis.gated += 1;
            }
            if !nis.is_finite() || est.gated[row] {
                continue;
            }
            let (low, high) = self.band(dof);
            let [inside, judged] = &mut self.counts.nis.inside;
            *judged += usize::from(low.is_finite() && high.is_finite());
            *inside += usize::from((low..=high).contains(&nis));
            let (time, sum, count) = &mut self.block;
            (*time, *sum, *count) = (*time + est.time[row], *sum + nis, *count + 1);
            if *count == self.counts.nis.block {
                let count = *count as f64;
                self.counts.nis.means.push([*time / count, *sum / count]);
                self.block = (0.0, 0.0, 0);
            }
        }
    }
}

/// The first and last of some rows, and those at which a curve of theirs is lowest or highest.
fn extremes(est: &Estimates, truth: Option<&Truth>, rows: &Range<usize>) -> Vec<usize> {
    let n = est.states();
    let mut found = vec![rows.start, rows.end - 1];
    let mut of = |curve: &dyn Fn(usize) -> f64| {
        let known = || rows.clone().map(|row| (curve(row), row)).filter(|(x, _)| !x.is_nan());
        let least = known().min_by(|(a, _), (b, _)| a.total_cmp(b));
        let most = known().max_by(|(a, _), (b, _)| a.total_cmp(b));
        found.extend([least, most].into_iter().flatten().map(|(_, row)| row));
    };
    of(&|row| est.nis[row]);
    for i in 0..n {
        of(&|row| est.mean(row)[i]);
        of(&|row| est.mean(row)[i] - 2.0 * est.std(row, i));
        of(&|row| est.mean(row)[i] + 2.0 * est.std(row, i));
        of(&|row| est.filtered_mean(row)[i]);
        if let Some(truth) = truth {
            of(&|row| est.mean(row)[i] - truth.states[row * n + i]);
        }
    }
    found
}
