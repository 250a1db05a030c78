//! Whether a filter's innovations are as large as it says they are.

use super::chi_squared::chi_squared_band;
use crate::Estimates;
use crate::scalar::Shown;
use core::iter::repeat;

/// The NIS of a run against its χ² band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Consistency {
    /// Mean of NIS per degree of freedom: 1 for a filter that is right.
    pub ratio: f64,
    /// Central 95 % band of that mean, for this many degrees of freedom.
    pub band: (f64, f64),
    /// Degrees of freedom, of all rows together.
    pub dof: usize,
}

/// The same of rows that come in portions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ConsistencySums {
    nis: f64,
    dof: usize,
}

impl ConsistencySums {
    /// Adds the rows of some estimates that were taken in.
    pub fn add(&mut self, est: &Estimates) {
        let gated = est.gated.iter().copied().chain(repeat(false));
        for ((&nis, &dof), gated) in est.nis.iter().zip(&est.nis_dof).zip(gated) {
            if !gated {
                self.nis += if nis.is_nan() { 0.0 } else { nis };
                self.dof += dof;
            }
        }
    }

    /// Of all rows so far.
    pub fn consistency(&self) -> Consistency {
        Consistency::of_sum(self.nis, self.dof)
    }
}

/// What the mean NIS says, in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing was measured.
    Unknown,
    /// Within its band.
    Consistent,
    /// Above: the innovations are larger than the filter expects.
    Overconfident,
    /// Below: they are smaller.
    Underconfident,
}

impl Consistency {
    /// Of a run over one trajectory, or of several together: of the rows that were taken in, without those beyond a
    /// [gate](crate::Gated).
    pub fn of<'a>(runs: impl IntoIterator<Item = &'a Estimates>) -> Self {
        let mut sums = ConsistencySums::default();
        runs.into_iter().for_each(|est| sums.add(est));
        sums.consistency()
    }

    /// Of the sum of all NIS, of so many degrees of freedom together.
    pub fn of_sum(nis: f64, dof: usize) -> Self {
        let k = dof as f64;
        let (low, high) = chi_squared_band(k);
        Self { ratio: nis / k, band: (low / k, high / k), dof }
    }

    /// The verdict on the mean NIS.
    pub fn verdict(&self) -> Verdict {
        match (self.dof, self.ratio) {
            (0, _) => Verdict::Unknown,
            (_, ratio) if ratio > self.band.1 => Verdict::Overconfident,
            (_, ratio) if ratio < self.band.0 => Verdict::Underconfident,
            _ => Verdict::Consistent,
        }
    }
}

impl core::fmt::Display for Consistency {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let (low, high) = self.band;
        let mean = |f: &mut core::fmt::Formatter<'_>, word: &str| {
            write!(
                f,
                "{word}: mean NIS {:.3} per degree of freedom, 95 % band {low:.3} to {high:.3}",
                Shown(self.ratio)
            )
        };
        match self.verdict() {
            Verdict::Unknown => write!(f, "nothing was measured"),
            Verdict::Consistent => mean(f, "consistent"),
            Verdict::Overconfident => mean(f, "overconfident (innovations larger than expected)"),
            Verdict::Underconfident => mean(f, "underconfident (innovations smaller than expected)"),
        }
    }
}
