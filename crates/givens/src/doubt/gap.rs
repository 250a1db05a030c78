//! Whether steps of equal length were short enough.

use crate::filter::Gaussian;
use crate::filter::predict::Variant;
use crate::model::{Observation, Sde};
use crate::ode::Steps;
use crate::registry::{Choice, TimeName};

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

impl Gap {
    /// One that begins with this belief.
    pub(super) fn from(from: f64, mean: &[f64], cov: &[f64]) -> Self {
        Self { row: 0, from, to: from, mean: mean.to_vec(), cov: cov.to_vec() }
    }

    /// The same, up to a row.
    pub(super) fn until(self, row: usize, to: f64) -> Self {
        Self { row, to, ..self }
    }
}

impl Choice {
    /// The same with twice as many steps in a gap, if they are of equal length. The Itô–Taylor step with one noise for the
    /// whole gap is not finer for having more of them: in its place comes the simplified one.
    pub(super) fn finer(&self) -> Option<Self> {
        let equal = match self.time_update {
            TimeName::Transition => false,
            TimeName::ItoTaylor | TimeName::EulerMaruyama => true,
            TimeName::MomentOde | TimeName::LevelSet => !self.integrator.solver.adaptive(),
        };
        let mut finer = *self;
        finer.integrator.steps = match self.integrator.steps {
            Steps::Count(count) => Steps::Count(count.checked_mul(2)?),
            Steps::Longest(longest) => Steps::Longest(0.5 * longest),
        };
        if self.variant == Variant::NoiseOnce {
            finer.variant = Variant::Simplified;
        }
        equal.then_some(finer)
    }

    /// How far the prediction over a gap moves by twice as many steps of equal length: the largest of |Δm_i|/σ_i and |ΔP_ij|/(σ_i σ_j),
    /// with σ by the finer steps; infinite where those fail. None of a method that takes no such steps, and where its own fail.
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
        let reach = |choice: &Self| {
            let mut filter = choice.start_continuous(model, sensors, gap.from, &prior).ok()?;
            if !parameters.is_empty() {
                filter.set_parameters(parameters).ok()?;
            }
            filter.set_controls(controls).ok()?;
            filter.predict(gap.to).ok()?;
            Some((filter.mean().to_vec(), filter.cov()))
        };
        let (finer, (mean, cov)) = (self.finer()?, reach(self)?);
        let Some((finer, exact)) = reach(&finer) else { return Some(f64::INFINITY) };
        let n = mean.len();
        let sigma = |i: usize| exact[i * n + i].sqrt();
        // what is known exactly has no standard deviation to move by
        let share = |moved: f64, by: f64| if by > 0.0 { moved.abs() / by } else { 0.0 };
        let means = (0..n).map(|i| share(mean[i] - finer[i], sigma(i)));
        let covs = (0..n * n).map(|k| share(cov[k] - exact[k], sigma(k / n) * sigma(k % n)));
        Some(means.chain(covs).fold(0.0, f64::max))
    }
}
