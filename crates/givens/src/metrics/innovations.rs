//! What the innovations of a run say about its model: their size, their mean, and whether each foretells the next.

use super::chi_squared_quantile;
use crate::Estimates;

/// So many of the rows that stand out most are kept.
const WORST: usize = 12;

/// The innovations of one measure, each in its own standard deviations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct MeasureSums {
    count: usize,
    sum: f64,
    squares: f64,
    /// Of each with the one before it.
    products: f64,
    pairs: usize,
    last: Option<f64>,
}

/// What is known of one measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureVerdict {
    /// How many innovations it had.
    pub count: usize,
    /// Their mean, in standard deviations; 0 if the model is right.
    pub mean: f64,
    /// Their mean square; 1 if the model is right.
    pub mean_square: f64,
    /// The correlation of each with the one before it; 0 if the model is right. NaN where there are no two.
    pub correlation: f64,
    /// How many there are of these.
    pub pairs: usize,
}

/// A row that stands out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Outlier {
    /// The track.
    pub track: usize,
    /// The row of the track.
    pub row: usize,
    /// Its NIS, and the degrees of freedom of that.
    pub nis: f64,
    /// See `nis`.
    pub dof: usize,
    /// Whether it was beyond the gate, and not taken in.
    pub gated: bool,
}

/// Sums over the innovations of a run, or of several.
///
/// ```
/// use givens::Data;
/// use givens::filter::{Gaussian, SrCkf};
/// use givens::metrics::InnovationSums;
/// use givens::model::zoo::{CoordinatedTurn, RangeBearing};
///
/// let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
/// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
/// let mut data = Data::new(2).starting_at(0.0);
/// data.push(1.0, &[1640.0, 0.65])?;
/// data.push(2.0, &[1890.0, 0.56])?;
/// let est = givens::filter(&SrCkf::default(), &turn, &radar, &data, &prior)?;
/// let mut sums = InnovationSums::new(2);
/// sums.add(0, 0, &est);
/// assert_eq!(sums.measures()[0].count, 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InnovationSums {
    measures: Vec<MeasureSums>,
    track: usize,
    /// Rows with a NIS, and of these beyond the quantiles 0.95 and 0.9999 of its distribution.
    rows: [usize; 3],
    worst: Vec<Outlier>,
    /// The quantiles 0.95 and 0.9999, by degrees of freedom.
    limits: Vec<[f64; 2]>,
}

impl InnovationSums {
    /// Nothing yet, of d `measures`.
    pub fn new(measures: usize) -> Self {
        Self { measures: vec![MeasureSums::default(); measures], ..Self::default() }
    }

    /// Adds rows of a track, the first of which is its row `from`. Those of one track follow each other. Rows beyond the gate are
    /// counted, and looked at no further. Estimates of another number of measures add nothing.
    pub fn add(&mut self, track: usize, from: usize, est: &Estimates) {
        if est.measures() != self.measures.len() {
            return;
        }
        if track != self.track {
            self.track = track;
            self.measures.iter_mut().for_each(|measure| measure.last = None);
        }
        for row in 0..est.len() {
            let gated = est.gated.get(row).copied().unwrap_or(false);
            self.note(Outlier { track, row: from + row, nis: est.nis[row], dof: est.nis_dof[row], gated });
            if gated {
                continue;
            }
            let (nu, cov, d) = (est.innovation(row), est.innovation_cov(row), self.measures.len());
            for (i, measure) in self.measures.iter_mut().enumerate() {
                if !nu[i].is_nan() {
                    measure.add(nu[i] / cov[i * d + i].sqrt());
                }
            }
        }
    }

    /// Counts a row, and keeps it if few stand out more.
    fn note(&mut self, row: Outlier) {
        if row.dof == 0 || row.nis.is_nan() {
            return;
        }
        for dof in self.limits.len()..=row.dof {
            self.limits.push([0.95, 0.9999].map(|p| chi_squared_quantile(dof.max(1) as f64, p)));
        }
        let limits = &self.limits;
        self.rows[0] += 1;
        self.rows[1] += usize::from(row.nis > limits[row.dof][0]);
        if row.nis > limits[row.dof][1] {
            self.rows[2] += 1;
            // of several degrees of freedom, by how far beyond
            let far = |row: &Outlier| row.nis / limits[row.dof][1];
            let at = self.worst.partition_point(|other| far(other) >= far(&row));
            self.worst.insert(at, row);
            self.worst.truncate(WORST);
        }
    }

    /// What is known of each measure.
    pub fn measures(&self) -> Vec<MeasureVerdict> {
        self.measures.iter().map(MeasureSums::verdict).collect()
    }

    /// Rows with a NIS, and of these beyond the quantiles 0.95 and 0.9999 of its distribution.
    pub fn rows(&self) -> [usize; 3] {
        self.rows
    }

    /// The rows beyond the quantile 0.9999 that stand out most.
    pub fn worst(&self) -> &[Outlier] {
        &self.worst
    }
}

impl MeasureSums {
    fn add(&mut self, e: f64) {
        self.count += 1;
        self.sum += e;
        self.squares += e * e;
        if let Some(last) = self.last.replace(e) {
            self.products += last * e;
            self.pairs += 1;
        }
    }

    fn verdict(&self) -> MeasureVerdict {
        let count = self.count as f64;
        let mean_square = self.squares / count;
        MeasureVerdict {
            count: self.count,
            mean: self.sum / count,
            mean_square,
            correlation: self.products / self.pairs as f64 / mean_square,
            pairs: self.pairs,
        }
    }
}

impl MeasureVerdict {
    /// So many standard deviations off is told: one in sixteen thousand right models is beyond.
    const TELLING: f64 = 4.0;

    /// Whether the mean is not zero.
    pub fn is_biased(&self) -> bool {
        self.mean.abs() > Self::TELLING * (self.mean_square / self.count as f64).sqrt()
    }

    /// Whether each foretells the next.
    pub fn is_correlated(&self) -> bool {
        self.correlation.abs() > Self::TELLING / (self.pairs as f64).sqrt()
    }

    /// Whether they are larger, or smaller, than the model says; a Gaussian's square has variance 2.
    pub fn is_of_other_size(&self) -> bool {
        (self.mean_square - 1.0).abs() > Self::TELLING * (2.0 / self.count as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::{InnovationSums, MeasureVerdict};
    use crate::Estimates;

    /// Rows of one measure with these innovations, each of standard deviation 2.
    fn rows(nu: &[f64]) -> Estimates {
        let mut est = Estimates::new(1, 1, false);
        for &nu in nu {
            est.time.push(0.0);
            est.innovation.push(nu);
            est.innovation_cov.push(4.0);
            est.nis.push(nu * nu / 4.0);
            est.nis_dof.push(usize::from(!nu.is_nan()));
            est.gated.push(nu > 1e3);
        }
        est
    }

    #[test]
    fn means_squares_and_products_are_those_by_hand() {
        let mut sums = InnovationSums::new(1);
        sums.add(0, 0, &rows(&[2.0, -4.0, f64::NAN]));
        sums.add(0, 3, &rows(&[6.0, 2e3]));
        // another track: no pair with the one before
        sums.add(1, 0, &rows(&[10.0, 2.0]));
        let found = sums.measures()[0];
        // 1, -2, 3 and 5, 1: squares 40; products -2, -6, 5
        assert_eq!((found.count, found.pairs), (5, 3));
        assert!((found.mean - 1.6).abs() < 1e-15 && (found.mean_square - 8.0).abs() < 1e-15);
        assert!((found.correlation - (-3.0 / 3.0 / 8.0)).abs() < 1e-15);
        // χ² of one degree: 0.95 at 3.84, 0.9999 at 15.1
        assert_eq!(sums.rows(), [6, 4, 2]);
        let worst: Vec<_> = sums.worst().iter().map(|row| (row.track, row.row, row.gated)).collect();
        assert_eq!(worst, [(0, 4, true), (1, 0, false)]);
    }

    #[test]
    fn four_standard_deviations_are_told_and_less_is_not() {
        let of = |mean, mean_square, correlation| MeasureVerdict {
            count: 1600,
            mean,
            mean_square,
            correlation,
            pairs: 1600,
        };
        // of 1600: a mean of 0.1, a mean square of 1 ± 0.1414, a correlation of 0.1
        let told =
            |found: MeasureVerdict| [found.is_biased(), found.is_of_other_size(), found.is_correlated()];
        assert_eq!(told(of(0.099, 1.14, 0.099)), [false; 3]);
        assert_eq!(told(of(-0.101, 1.0, 0.0)), [true, false, false]);
        assert_eq!(told(of(0.0, 0.858, 0.0)), [false, true, false]);
        assert_eq!(told(of(0.0, 1.0, -0.101)), [false, false, true]);
    }
}
