//! The two steps of a filter: `predict(t)` and `update(sensor, z)`.

use super::Matrix;
use super::backward::accumulate;
use super::distinct::{distinct, judge, lower, note};
use super::error::{Fault, StepError};
use super::fits::fits;
use super::lanes::lanes;
use super::methods::Over;
use super::predict::{Given, Plan, Stopped, TimeUpdate};
use super::quantity::Quantity;
use super::stepper::{Filter, Parts, layout};
use super::update::{InnovationMut, Measurement, Present, update};
use crate::model::{At, Observation};
use crate::rule::Rule;
use crate::scalar::{Mask, Real};

/// Memory that may or may not be made longer.
pub trait Grow<T>: AsRef<[T]> + AsMut<[T]> {
    /// Makes the memory at least `len` long, if it can.
    fn grow(&mut self, len: usize);
}

#[cfg(feature = "alloc")]
impl<T: Real> Grow<T> for alloc::vec::Vec<T> {
    fn grow(&mut self, len: usize) {
        if self.try_reserve_exact(len.saturating_sub(self.len())).is_ok() {
            self.resize(len.max(self.len()), T::zero());
        }
    }
}

impl<T> Grow<T> for &mut [T] {
    fn grow(&mut self, _: usize) {}
}

impl<T, const N: usize> Grow<T> for [T; N] {
    fn grow(&mut self, _: usize) {}
}

impl<X: Over<M>, M, T: Real, B: Grow<T>> Filter<'_, X, M, T, B> {
    /// Moves the belief to time `t`. A model with a fixed step takes as many as the gap holds; others take one of
    /// any length. At the present time nothing happens.
    ///
    /// # Errors
    /// A time in the past, a gap that is not whole steps, controls that were never set, a model that is not finite or
    /// whose noise is no covariance, a predicted covariance that is not positive definite. The belief is then that of
    /// the last step that succeeded.
    pub fn predict(&mut self, t: f64) -> Result<(), StepError> {
        let (from, gap) = (self.time, t - self.time);
        let refuse = |fault| Err(StepError { fault, time: from, step: self.step });
        if !(gap >= 0.0 && gap.is_finite()) {
            return refuse(Fault::Backwards { to: t });
        }
        let Plan { count, dt } = match self.method.time_update().plan(self.model, from, t) {
            Ok(plan) => plan,
            Err(fault) => return refuse(fault),
        };
        if count > 0 && !self.controlled {
            return refuse(Fault::ControlsNotSet { controls: self.layout.sizes.controls });
        }
        self.stand_still();
        for k in 0..count {
            let at = from + k as f64 * dt;
            self.one_step((at, T::of(at)), (dt, T::of(dt)), k > 0)?;
        }
        self.time = t;
        self.step = self.step.saturating_add(usize::from(count > 0));
        Ok(())
    }

    /// Before the first step of a gap: G = I, and nothing unknown about the state given itself.
    #[inline(always)]
    pub(super) fn stand_still(&mut self) {
        let n = self.layout.sizes.states;
        self.forget_learnt();
        if !self.layout.smoothing {
            return;
        }
        let total = self.parts().total;
        total.conditional.fill(T::zero());
        for (i, g) in total.gain.iter_mut().enumerate() {
            *g = if i % (n + 1) == 0 { T::one() } else { T::zero() };
        }
    }

    /// Forgets what the updates since the last prediction have learnt, once it is written down.
    #[inline(always)]
    pub(crate) fn forget_learnt(&mut self) {
        self.moves += 1;
        if self.layout.smoothing {
            let n = self.layout.sizes.states;
            self.parts().learnt.reset(n);
        }
    }

    /// One step of `dt` from `t`, both also lane by lane; the lanes in which it was not done.
    #[inline(always)]
    pub(super) fn step_inside(
        &mut self,
        (t, start): (f64, T),
        (dt, length): (f64, T),
        chained: bool,
    ) -> Result<T::Mask, StepError> {
        let (rule, time_update) = (self.method.rule(), self.method.time_update());
        let model = self.model;
        let (smoothing, step) = (self.layout.smoothing, self.step);
        let mut work = self.work;
        let parts = self.known_parts().map_err(|fault| StepError { fault, time: t, step })?;
        let Parts { kept, table, u, p, floor, before, mut belief, mut total, mut later, scratch, .. } = parts;
        let n = belief.mean.len();
        note(belief.mean, belief.factor, before);
        let reach = rule.reach(n);
        let blurred = distinct(reach, belief.mean, belief.factor, floor, before)
            .map_err(|fault| StepError { fault, time: t, step })?;
        let at = At { t: start, dt: length, u, p };
        // the way back is put together in the same scratch
        let mut given = Given { rule: &rule, table, model, at, again: chained && !smoothing, kept };
        let back = smoothing.then_some(if chained { &mut later } else { &mut total });
        let done = time_update.step::<T, _, X::Form>(&mut given, &mut belief, back, &mut work, scratch);
        let chain = match done {
            Ok(sick) if smoothing && chained => {
                let chain = accumulate(n, &mut total, &later, scratch);
                lanes(chain, Matrix::Conditional).map(|more| sick | more)
            }
            Ok(sick) => Ok(sick),
            Err(Stopped { reached, fault }) => {
                // a time of the solver is counted from that of the model, which may be rounded
                let time = reached.map_or(t + dt, |reached| reached + (t - start.first()));
                return Err(StepError { fault, time, step });
            }
        };
        let sick = chain.map_err(|fault| StepError { fault, time: t + dt, step })?;
        lower(reach, before, belief.mean, belief.factor, floor);
        self.work = work;
        self.moved = self.layout.moved;
        self.time = t + dt;
        Ok(sick | blurred)
    }

    /// Teaches the belief a whole measurement of `sensor` at the present time; where components are missing,
    /// [`update_present`](Self::update_present) takes the others.
    ///
    /// # Errors
    /// A measurement of the wrong length or that is not finite, a sensor model that is not finite or whose noise is no
    /// covariance, an innovation or posterior covariance that is not positive definite, too little memory. The belief
    /// is then as before, and the innovation empty.
    pub fn update<H: Observation>(&mut self, sensor: &H, z: &[f64]) -> Result<(), StepError> {
        self.make_ready(sensor, z, z.len())?;
        let learnt = self.learn_whole(sensor, T::of(self.time));
        learnt.map(|_| ()).map_err(|fault| self.fail(fault))
    }

    /// Teaches the belief the components of a measurement that are there: `present[i]` tells for component i. With
    /// none of them, the belief stays as predicted.
    ///
    /// # Errors
    /// As [`update`](Self::update).
    pub fn update_present<H: Observation>(
        &mut self,
        sensor: &H,
        z: &[f64],
        present: &[bool],
    ) -> Result<(), StepError> {
        self.make_ready(sensor, z, present.len())?;
        let learnt = self.learn(sensor, T::of(self.time), Present::Some(present), None);
        learnt.map(|_| ()).map_err(|fault| self.fail(fault))
    }

    /// Checks a measurement, of which it was `told` for so many components whether they are there, and lays it ready.
    pub(super) fn make_ready<H: Observation>(
        &mut self,
        sensor: &H,
        z: &[f64],
        told: usize,
    ) -> Result<(), StepError> {
        self.present = 0;
        self.parts().scores.fill(T::zero());
        let (time, step, d) = (self.time, self.step, sensor.measures());
        let fail = |fault| StepError { fault, time, step };
        for (of, expected, found) in [
            ("the sensor's state", self.layout.sizes.states, sensor.states()),
            ("measurement", d, z.len()),
            ("present", z.len(), told),
            (
                "the sensor's parameters",
                sensor.parameters(),
                sensor.parameters().min(self.layout.sizes.parameters),
            ),
            ("the sensor's controls", sensor.controls(), sensor.controls().min(self.layout.sizes.controls)),
        ] {
            if expected != found {
                return Err(fail(Fault::Length { of, expected, found }));
            }
        }
        if sensor.controls() > 0 && !self.controlled {
            return Err(fail(Fault::ControlsNotSet { controls: self.layout.sizes.controls }));
        }
        self.make_room(sensor).map_err(fail)?;
        fits::<T>(z, Quantity::Measurement).map_err(fail)?;
        self.parts().measured[..d].iter_mut().zip(z).for_each(|(to, &z)| *to = T::of(z));
        Ok(())
    }

    /// Takes in the measurement that lies ready, made at time `t`, unless its NIS is above `most` in every lane; the lanes in
    /// which that was not done.
    #[inline(always)]
    pub(super) fn learn_inside<H: Observation>(
        &mut self,
        sensor: &H,
        t: T,
        present: Present<T>,
        most: Option<T>,
    ) -> Result<T::Mask, Fault> {
        let d = sensor.measures();
        let (rule, block, moved) = (self.method.rule(), self.method.block(), self.moved);
        let Parts {
            table,
            u,
            p,
            floor,
            before,
            mut belief,
            mut learnt,
            measured,
            predicted,
            nu,
            factor,
            white,
            scores,
            scratch,
            ..
        } = self.known_parts()?;
        note(belief.mean, belief.factor, before);
        let reach = rule.reach(belief.mean.len());
        let mut sick = distinct(reach, belief.mean, belief.factor, floor, before)?;
        let at = At { t, dt: T::zero(), u, p };
        if !moved {
            belief.moved = &mut [];
        }
        let measurement = Measurement { z: &measured[..d], present };
        let (nis, log_likelihood) = scores.split_at_mut(1);
        let (nis, log_likelihood) = (&mut nis[0], &mut log_likelihood[0]);
        let mut innovation = InnovationMut { predicted, nu, factor, white, nis, log_likelihood };
        let updated = update::<_, _, _, X::Form>(
            &rule,
            block,
            table,
            sensor,
            &at,
            measurement,
            &belief,
            &mut innovation,
            !learnt.turn.is_empty(),
            scratch,
        )?;
        sick = sick | updated.sick;
        let present = updated.present;
        let gated = most.is_some_and(|most| most.lt(scores[0]).all());
        if gated {
            scores[1] = T::zero();
        } else if let Some(posterior) = updated.posterior {
            let more = judge(before, &posterior, updated.exact, floor);
            sick = sick | more.inspect_err(|_| scores.fill(T::zero()))?;
            posterior.settle(&mut belief, &mut learnt);
        }
        self.present = present;
        self.moved &= present == 0 || gated;
        self.step = self.step.saturating_add(1);
        Ok(sick)
    }

    /// Grows the memory for a sensor that is longer than those before, once.
    pub(super) fn make_room<H: Observation>(&mut self, sensor: &H) -> Result<(), Fault> {
        let sizes = self.layout.sizes.with_sensor(sensor, self.layout.shape);
        if self.layout.sizes.hold(&sizes) {
            return Ok(());
        }
        let layout = layout::<X, M>(&self.method, sizes, self.layout.smoothing);
        self.memory.grow(layout.len);
        let found = self.memory.as_ref().len();
        if found < layout.len {
            return Err(Fault::Length { of: "the filter's memory", expected: layout.len, found });
        }
        self.layout = layout;
        self.present = 0;
        Ok(())
    }
}
