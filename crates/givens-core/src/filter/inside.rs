//! The steps of a filter as functions of their own, compiled with the instructions of their numbers: see [`Real::within`].

use super::error::{Fault, StepError};
use super::methods::Over;
use super::stepper::Filter;
use super::steps::Grow;
use super::update::Present;
use crate::model::Observation;
use crate::scalar::{Inside, Real};

impl<X: Over<M>, M, T: Real, B: Grow<T>> Filter<'_, X, M, T, B> {
    /// One step of a length from a time, both also lane by lane; the lanes in which it was not done.
    pub(super) fn one_step(
        &mut self,
        from: (f64, T),
        length: (f64, T),
        chained: bool,
    ) -> Result<T::Mask, StepError> {
        T::within(OneStep { filter: self, from, length, chained })
    }

    /// Takes in the measurement that lies ready, made at time `t`, unless its NIS is above `most` in every lane; the lanes in
    /// which that was not done.
    pub(super) fn learn<H: Observation>(
        &mut self,
        sensor: &H,
        t: T,
        present: Present<T>,
        most: Option<T>,
    ) -> Result<T::Mask, Fault> {
        T::within(Learn { filter: self, sensor, t, present, most })
    }

    /// The same of a measurement with all its components and without a gate, which the compiler then knows the number of.
    pub(super) fn learn_whole<H: Observation>(&mut self, sensor: &H, t: T) -> Result<T::Mask, Fault> {
        T::within(LearnWhole { filter: self, sensor, t })
    }
}

struct OneStep<'f, 'm, X, M, T, B> {
    filter: &'f mut Filter<'m, X, M, T, B>,
    from: (f64, T),
    length: (f64, T),
    chained: bool,
}

impl<X: Over<M>, M, T: Real, B: Grow<T>> Inside for OneStep<'_, '_, X, M, T, B> {
    type Output = Result<T::Mask, StepError>;
    #[inline(always)]
    fn go(self) -> Self::Output {
        self.filter.step_inside(self.from, self.length, self.chained)
    }
}

struct Learn<'f, 'm, X, M, T: Real, B, H> {
    filter: &'f mut Filter<'m, X, M, T, B>,
    sensor: &'f H,
    t: T,
    present: Present<'f, T>,
    most: Option<T>,
}

impl<X: Over<M>, M, T: Real, B: Grow<T>, H: Observation> Inside for Learn<'_, '_, X, M, T, B, H> {
    type Output = Result<T::Mask, Fault>;
    #[inline(always)]
    fn go(self) -> Self::Output {
        self.filter.learn_inside(self.sensor, self.t, self.present, self.most)
    }
}

struct LearnWhole<'f, 'm, X, M, T, B, H> {
    filter: &'f mut Filter<'m, X, M, T, B>,
    sensor: &'f H,
    t: T,
}

impl<X: Over<M>, M, T: Real, B: Grow<T>, H: Observation> Inside for LearnWhole<'_, '_, X, M, T, B, H> {
    type Output = Result<T::Mask, Fault>;
    #[inline(always)]
    fn go(self) -> Self::Output {
        self.filter.learn_inside(self.sensor, self.t, Present::All, None)
    }
}
