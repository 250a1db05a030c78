//! A filter of a method chosen at run time, stepped by hand.

use super::stepping::{Stepping, With};
use crate::filter::{Innovation, Over, Snapshot, StepError};
use crate::model::Observation;
use crate::ode::Work;
use crate::run::{OwnFilter, scatter};
use crate::scalar::Element;

/// A filter in motion whose method was chosen at run time: predicted and updated by hand. What it tells is in `f64`, also where
/// it computes in `f32`.
///
/// It gives the numbers of [`Choice::run`](super::Choice::run) to the bit if it is stepped as that is: predict to a row's time, set the row's
/// controls, update.
///
/// ```
/// use givens::filter::Gaussian;
/// use givens::model::zoo::{CoordinatedTurn, RangeBearing};
/// use givens::registry::resolve;
///
/// let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
/// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
/// let mut f = resolve("sr-ukf", &[])?.start(&turn, &radar, 0.0, &prior)?;
/// f.predict(1.0)?;
/// f.update(&[1640.0, f64::NAN])?; // the bearing is missing
/// assert!((f.mean()[0] - 1300.0).abs() < 20.0);
/// assert_eq!((f.dof(), f.present()), (1, [true, false].as_slice()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct AnyFilter<'m> {
    inner: Box<dyn Stepping + Send + Sync + 'm>,
    /// Which components of the last measurement were there.
    present: Vec<bool>,
    /// Whether it was beyond the gate.
    gated: bool,
}

impl<'m> AnyFilter<'m> {
    pub(super) fn of<X, M, H, T: Element>(
        filter: OwnFilter<'m, X, M, T>,
        sensors: &'m H,
        limits: Vec<f64>,
    ) -> Self
    where
        X: Over<M> + Send + Sync + 'static,
        M: Sync,
        H: Observation + Sync,
    {
        let present = vec![false; sensors.measures()];
        Self { inner: Box::new(With::new(filter, sensors, limits)), present, gated: false }
    }
}

impl AnyFilter<'_> {
    /// Moves the belief to time `t`; see [`Filter::predict`](crate::filter::Filter::predict).
    ///
    /// # Errors
    /// A time in the past, a gap that is not whole steps, controls that were never set, a model that is not finite or
    /// whose noise is no covariance, a predicted covariance that is not positive definite. The belief is then that of
    /// the last step that succeeded.
    pub fn predict(&mut self, t: f64) -> Result<(), StepError> {
        self.inner.predict(t)
    }

    /// Teaches the belief a measurement of all sensors at the present time, of length d: NaN where a component is missing.
    /// With none of them, the belief stays as predicted, and so it does by one beyond the [gate](Self::gated).
    ///
    /// # Errors
    /// A measurement of the wrong length or that is infinite, a sensor model that is not finite or whose noise is no
    /// covariance, an innovation or posterior covariance that is not positive definite. The belief is then as before,
    /// and the innovation empty.
    pub fn update(&mut self, z: &[f64]) -> Result<(), StepError> {
        self.present.fill(false);
        self.present.iter_mut().zip(z).for_each(|(there, z)| *there = !z.is_nan());
        let done = self.inner.update(z, &self.present);
        if done.is_err() {
            self.present.fill(false);
        }
        self.gated = matches!(done, Ok(false));
        done.map(|_| ())
    }

    /// Sets the controls, which hold until they are set again. A model that has some neither predicts nor is measured by
    /// them before.
    ///
    /// # Errors
    /// A wrong number of them, or one that is not finite.
    pub fn set_controls(&mut self, u: &[f64]) -> Result<(), StepError> {
        self.inner.set_controls(u)
    }

    /// Sets the parameters, in place of the model's own.
    ///
    /// # Errors
    /// A wrong number of them, or one that is not finite.
    pub fn set_parameters(&mut self, p: &[f64]) -> Result<(), StepError> {
        self.inner.set_parameters(p)
    }

    /// The time at which the belief holds.
    pub fn time(&self) -> f64 {
        self.inner.time()
    }

    /// Length n of the state.
    pub fn states(&self) -> usize {
        self.mean().len()
    }

    /// Length d of the measurement, all sensors together.
    pub fn measures(&self) -> usize {
        self.present.len()
    }

    /// The state estimate, length n.
    pub fn mean(&self) -> &[f64] {
        self.inner.mean()
    }

    /// S with P = S Sᵀ, lower triangular n × n, diagonal ≥ 0.
    pub fn factor(&self) -> &[f64] {
        self.inner.factor()
    }

    /// P, n × n: the filter's own in covariance form, S Sᵀ in square-root form.
    pub fn cov(&self) -> Vec<f64> {
        self.inner.cov()
    }

    /// Which of the d components the last measurement had; none before the first and after an error.
    pub fn present(&self) -> &[bool] {
        &self.present
    }

    /// Whether the last measurement was beyond the gate, and so not taken in; see [`Gated`](crate::Gated).
    pub fn gated(&self) -> bool {
        self.gated
    }

    /// What the last measurement said, of the components that were [there](Self::present); empty before the first and
    /// after an error.
    pub fn innovation(&self) -> Innovation<'_, f64> {
        self.inner.innovation()
    }

    /// The same for all d components: ν of length d and P_zz, d × d, NaN where one was missing.
    pub fn whole_innovation(&self) -> (Vec<f64>, Vec<f64>) {
        let d = self.measures();
        let (mut nu, mut cov) = (vec![f64::NAN; d], vec![f64::NAN; d * d]);
        scatter(&self.innovation(), &self.present, &mut nu, &mut cov);
        (nu, cov)
    }

    /// νᵀ P_zz⁻¹ ν of the last measurement; NaN if nothing was measured.
    pub fn nis(&self) -> f64 {
        if self.dof() == 0 { f64::NAN } else { self.innovation().nis }
    }

    /// How many components the last measurement had.
    pub fn dof(&self) -> usize {
        self.innovation().nu.len()
    }

    /// Log-likelihood of the last measurement; 0 if nothing was measured, or taken in.
    pub fn log_likelihood(&self) -> f64 {
        self.innovation().log_likelihood
    }

    /// What the solvers of the predictions have done so far.
    pub fn work(&self) -> Work {
        self.inner.work()
    }

    /// What the filter carries to its next step, as plain data: [`Choice::resume`](super::Choice::resume) and its sister for continuous methods start
    /// from it. What the last measurement said is not in it.
    pub fn snapshot(&self) -> Snapshot {
        self.inner.snapshot()
    }
}

impl core::fmt::Debug for AnyFilter<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { inner, present, gated } = self;
        let mut of = f.debug_struct("AnyFilter");
        of.field("time", &inner.time()).field("mean", &inner.mean()).field("factor", &inner.factor());
        of.field("present", present).field("gated", gated).finish()
    }
}
