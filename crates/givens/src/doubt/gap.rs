//! Whether steps of equal length were short enough.

use crate::filter::Gaussian;
use crate::filter::predict::Variant;
use crate::model::{Observation, Sde};
use crate::ode::Steps;
use crate::registry::{Choice, Precision};

/// A gap before a row, and the belief with which it begins.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gap {
    /// The row behind it.
    pub row: usize,
    /// When it begins.
    pub from: f64,
    /// When it ends.
    pub to: f64,
    mean: Vec<f64>,
    cov: Vec<f64>,
}

/// What is believed when a gap begins.
#[derive(Clone, Copy)]
pub(super) struct Stand<'a> {
    pub from: f64,
    pub mean: &'a [f64],
    pub cov: &'a [f64],
}

impl Stand<'_> {
    /// By how much, at most, a prediction from here widens a standard deviation, and moves a mean in standard deviations.
    pub fn reach(self, mean: &[f64], cov: &[f64]) -> [f64; 2] {
        let n = mean.len();
        let (mut wider, mut moved) = (0.0, 0.0);
        for i in 0..n {
            let own = self.cov[i * n + i].sqrt();
            if own > 0.0 {
                wider = f64::max(wider, cov[i * n + i].sqrt() / own);
                moved = f64::max(moved, (mean[i] - self.mean[i]).abs() / own);
            }
        }
        [wider, moved]
    }

    /// The gap from here to a row.
    pub fn until(self, row: usize, to: f64) -> Gap {
        Gap { row, from: self.from, to, mean: self.mean.to_vec(), cov: self.cov.to_vec() }
    }
}

impl Gap {
    /// Where it begins.
    pub(super) fn stand(&self) -> Stand<'_> {
        Stand { from: self.from, mean: &self.mean, cov: &self.cov }
    }
}

impl Choice {
    /// The same with twice as many steps in a gap, and one more: a period that all steps hit is not hit by these. Rounding is not
    /// asked about: both are in double precision. The Itô–Taylor step with one noise for the whole gap is not finer for having
    /// more of them: in its place comes the simplified one.
    fn finer(&self, gap: f64) -> Option<Self> {
        let taken = match self.integrator.steps {
            Steps::Count(count) => count,
            Steps::Longest(longest) => (gap / longest).ceil() as usize,
        };
        let mut finer = Self { precision: Precision::F64, ..*self };
        let count = taken.max(1).checked_mul(2)?.checked_add(1)?.min(finer.integrator.limit);
        finer.integrator.steps = Steps::Count(count);
        if self.variant == Variant::NoiseOnce {
            finer.variant = Variant::Simplified;
        }
        // what is nearly as fine already says nothing
        (self.steps_are_equal() && 2 * count > 3 * taken).then_some(finer)
    }

    /// How far the prediction over a gap moves by twice as many steps of equal length and one more: the largest of |Δm_i|/σ_i and
    /// |ΔP_ij|/(σ_i σ_j), with σ by the finer steps, but for what the rounding of the means may do; of a mean that is known exactly
    /// |Δm_i|/|m_i|. Infinite where the finer steps fail. None of a method that takes no such steps, or as many as it may, and
    /// where its own fail.
    ///
    /// `controls` and `parameters` are those that hold in the gap; no parameters: the model's.
    pub fn halved<M: Sde + Sync, H: Observation + Sync>(
        &self,
        model: &M,
        sensors: &H,
        controls: &[f64],
        parameters: &[f64],
        gap: &Gap,
    ) -> Option<f64> {
        let prior = Gaussian::from_cov(&gap.mean, &gap.cov).ok()?;
        let finer = self.finer(gap.to - gap.from)?;
        let reach = |choice: &Self| {
            let mut filter = choice.start_continuous(model, sensors, gap.from, &prior).ok()?;
            if !parameters.is_empty() {
                filter.set_parameters(parameters).ok()?;
            }
            filter.set_controls(controls).ok()?;
            filter.predict(gap.to).ok()?;
            Some((filter.mean().to_vec(), filter.cov()))
        };
        let (mean, cov) = reach(&Self { precision: Precision::F64, ..*self })?;
        let Some((exact, exact_cov)) = reach(&finer) else { return Some(f64::INFINITY) };
        let n = mean.len();
        let sigma = |i: usize| exact_cov[i * n + i].sqrt();
        let Steps::Count(count) = finer.integrator.steps else { return None };
        let means = (0..n).map(|i| {
            let rounding = f64::EPSILON * count as f64 * exact[i].abs();
            let moved = ((mean[i] - exact[i]).abs() - rounding).max(0.0);
            match (sigma(i), exact[i].abs()) {
                _ if moved == 0.0 => 0.0,
                (by, _) if by > 0.0 => moved / by,
                (_, size) => moved / size,
            }
        });
        let covs = (0..n * n).map(|k| {
            let by = sigma(k / n) * sigma(k % n);
            if by > 0.0 { (cov[k] - exact_cov[k]).abs() / by } else { 0.0 }
        });
        Some(means.chain(covs).fold(0.0, f64::max))
    }
}
