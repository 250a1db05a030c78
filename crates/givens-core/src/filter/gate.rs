//! The gate: a measurement that the filter believes all but impossible is looked at, and not taken in.

use super::error::{Fault, StepError};
use super::memory::take;
use super::methods::Over;
use super::stepper::{Filter, Parts};
use super::steps::Grow;
use super::update::Present;
use crate::model::Observation;
use crate::rule::RuleError;
use crate::scalar::{Mask, Pack, Real};

impl<X: Over<M>, M, T: Real, B: Grow<T>> Filter<'_, X, M, T, B> {
    /// Teaches the belief the components of a measurement that are there, as [`update_present`](Self::update_present) does,
    /// unless νᵀ P_zz⁻¹ ν is above `limit`. Such a measurement leaves the belief as predicted, to the bit that of a row in
    /// which nothing was measured; the answer is then false. [`innovation`](Self::innovation) tells what it said all the
    /// same, with a log-likelihood of zero.
    ///
    /// A limit is a quantile of the χ² distribution with as many degrees of freedom as components are there.
    ///
    /// ```
    /// use givens_core::filter::{Gaussian, Method, SrCkf};
    /// use givens_core::model::zoo::{CoordinatedTurn, RangeBearing};
    ///
    /// let (model, radar) = (CoordinatedTurn::default(), RangeBearing::published());
    /// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
    /// let mut f = SrCkf::default().start(&model, 0.0, prior)?;
    /// f.predict(1.0)?;
    /// let predicted = f.mean().to_vec();
    /// // of two components, one row in ten thousand is beyond 18.42
    /// assert!(!f.update_gated(&radar, &[2640.0, 0.65], &[true; 2], 18.42)?);
    /// assert!(f.mean() == predicted && f.innovation().nis > 18.42);
    /// assert!(f.update_gated(&radar, &[1640.0, 0.65], &[true; 2], 18.42)?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`update`](Self::update), and a limit that is below zero or no number.
    pub fn update_gated<H: Observation>(
        &mut self,
        sensor: &H,
        z: &[f64],
        present: &[bool],
        limit: f64,
    ) -> Result<bool, StepError> {
        let (time, step) = (self.time, self.step);
        let fail = |fault| StepError { fault, time, step };
        if limit.is_nan() || limit < 0.0 {
            let must = "must be a number, zero or more";
            return Err(fail(Fault::Option(RuleError { option: "limit", value: limit, must })));
        }
        self.make_ready(sensor, z, present.len())?;
        let most = T::of(limit);
        self.learn(sensor, T::of(time), Present::Some(present), Some(most)).map_err(fail)?;
        Ok(!most.lt(self.parts().scores[0]).all())
    }
}

impl<X: Over<M>, M, P: Pack, B: Grow<P>> Filter<'_, X, M, P, B> {
    /// Teaches each of the lanes that were `measured` its own measurement, as [`update_lanes`](Self::update_lanes) does, unless
    /// νᵀ P_zz⁻¹ ν is above that lane's `limit`. The other lanes, and those beyond their limits, stay as predicted to the bit,
    /// and their log-likelihood is zero. The answer is the lanes that could not take their measurement in, of which nothing is
    /// to be used any more, and those beyond their limits.
    ///
    /// `spare` has [`spare_len`](Self::spare_len) packs; where all lanes are measured and none has a limit it is not used.
    #[inline(always)]
    pub fn update_lanes_gated<H: Observation>(
        &mut self,
        sensor: &H,
        t: &[f64],
        z: &[P],
        present: Option<&[P::Mask]>,
        measured: P::Mask,
        limit: Option<P>,
        spare: &mut [P],
    ) -> (P::Mask, P::Mask) {
        let nobody = P::Mask::splat(false);
        if !measured.any() {
            self.present = 0;
            self.parts().scores.fill(P::zero());
            return (nobody, nobody);
        }
        let all_stay = measured.all() && limit.is_none();
        if !all_stay {
            let mut rest = &mut *spare;
            for from in taught(self.parts()) {
                take(&mut rest, from.len()).copy_from_slice(from);
            }
        }
        let sick = self.update_lanes(sensor, t, z, present) & measured;
        if all_stay {
            return (sick, nobody);
        }
        let beyond = limit.map_or(nobody, |limit| limit.lt(self.parts().scores[0])) & measured;
        let as_before = beyond | !measured;
        let mut rest = spare;
        for to in taught(self.parts()) {
            let before = take(&mut rest, to.len());
            for (to, &mut before) in to.iter_mut().zip(before) {
                *to = P::select(as_before, before, *to);
            }
        }
        let log_likelihood = &mut self.parts().scores[1];
        *log_likelihood = P::select(as_before, P::zero(), *log_likelihood);
        (sick, beyond)
    }
}

/// What an update changes of a filter's memory, but for the innovation.
#[inline(always)]
fn taught<T>(parts: Parts<'_, T>) -> [&mut [T]; 7] {
    let Parts { belief, floor, learnt, .. } = parts;
    [belief.mean, floor, belief.factor, belief.cov, belief.moved, learnt.shift, learnt.turn]
}
