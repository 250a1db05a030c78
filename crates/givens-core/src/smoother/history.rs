//! The record of a filter's time updates, in memory that the caller lends: all of them, or a ring of the last ones.

use super::back::{Passage, back_scratch, mean_back, step_back};
use crate::filter::memory::take;
use crate::filter::{Belief, Covariance, Fault, Filter, Form, Grow, Over, Prior, SquareRoot, StepError};
use crate::scalar::Real;
use core::marker::PhantomData;

/// Time updates of a filter, one record each: a ring that forgets the oldest when it is full.
///
/// With room for every update it serves the fixed-interval smoother; with room for L, the fixed-lag smoother.
#[derive(Clone, Debug)]
pub struct History<T, B> {
    states: usize,
    square_root: bool,
    capacity: usize,
    oldest: usize,
    count: usize,
    memory: B,
    scalar: PhantomData<T>,
}

impl<T: Real, B: AsRef<[T]> + AsMut<[T]>> History<T, B> {
    /// Scalars of one record of a filter of n states.
    #[must_use]
    pub const fn record_len(states: usize, square_root: bool) -> usize {
        2 * states + states * states * if square_root { 2 } else { 3 }
    }

    /// Scalars of memory for `capacity` records and the backward pass.
    #[must_use]
    pub const fn memory_len(states: usize, square_root: bool, capacity: usize) -> usize {
        let belief = states + 2 * states * states;
        capacity * Self::record_len(states, square_root) + belief + back_scratch(states)
    }

    /// A history for filters of n `states`; it holds as many records as `memory` has room for.
    pub fn new(states: usize, square_root: bool, mut memory: B) -> Self {
        let fixed = Self::memory_len(states, square_root, 0);
        let room = memory.as_mut().len().saturating_sub(fixed);
        let capacity = room / Self::record_len(states, square_root).max(1);
        Self { states, square_root, capacity, oldest: 0, count: 0, memory, scalar: PhantomData }
    }

    /// Records held.
    pub fn len(&self) -> usize {
        self.count
    }

    /// No record yet.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Whether a belief of n `states` in this form goes with these records, and these into the memory.
    fn room<F: Form>(&mut self, states: usize) -> Result<(), Fault> {
        let record = |n, square_root| Self::record_len(n, square_root);
        let fixed = Self::memory_len(self.states, self.square_root, 0);
        for (of, expected, found) in [
            (
                "a record of the history",
                record(states, F::SQUARE_ROOT),
                record(self.states, self.square_root),
            ),
            ("the history's memory", fixed, fixed.min(self.memory.as_mut().len())),
        ] {
            if expected != found {
                return Err(Fault::Length { of, expected, found });
            }
        }
        Ok(())
    }

    /// Whether the filter goes with this history.
    fn fits<X: Over<M>, M, C: Grow<T>>(&mut self, filter: &Filter<'_, X, M, T, C>) -> Result<(), StepError> {
        let room = self.room::<X::Form>(filter.mean().len());
        room.and_then(|()| for_smoothing(filter)).map_err(|fault| filter.fail(fault))
    }

    /// Predicts, and records the update. The filter must have been started for smoothing.
    ///
    /// # Errors
    /// Those of [`Filter::predict`], or a filter that does not go with this history; nothing is recorded then.
    pub fn predict<X: Over<M>, M, C: Grow<T>>(
        &mut self,
        filter: &mut Filter<'_, X, M, T, C>,
        t: f64,
    ) -> Result<(), StepError> {
        let (n, square) = (self.states, if self.square_root { 0 } else { self.states * self.states });
        if self.capacity == 0 {
            return filter.predict(t);
        }
        self.fits(filter)?;
        // the belief before waits in memory of the way back: in a full ring, its record is still the oldest one's
        let (before, ..) = self.carve(square);
        before.mean.copy_from_slice(filter.mean());
        if square > 0 {
            filter.write_cov(before.cov);
        }
        filter.predict(t)?;
        let slot = (self.oldest + self.count) % self.capacity;
        let len = Self::record_len(n, self.square_root);
        let (records, mut belief) = self.memory.as_mut().split_at_mut(self.capacity * len);
        let mut after = &mut records[slot * len..(slot + 1) * len];
        take(&mut after, n).copy_from_slice(take(&mut belief, n));
        take(&mut belief, n * n);
        take(&mut after, square).copy_from_slice(take(&mut belief, square));
        take(&mut after, n).copy_from_slice(filter.mean());
        if square > 0 {
            filter.write_cov(take(&mut after, square));
        }
        let (gain, conditional) = filter.backward();
        take(&mut after, gain.len()).copy_from_slice(gain);
        take(&mut after, conditional.len()).copy_from_slice(conditional);
        if self.count == self.capacity {
            self.oldest = (self.oldest + 1) % self.capacity;
        } else {
            self.count += 1;
        }
        Ok(())
    }

    /// Goes back from the filter's present belief over at most `steps` records, the latest first. `visit` is called
    /// with 0 and the present belief, then with 1, 2, … and the smoothed belief that many time updates ago. Nothing
    /// is forgotten: a fixed-lag smoother calls this at every step.
    ///
    /// # Errors
    /// A smoothed covariance that is not positive semidefinite, in covariance form; the time is the filter's.
    pub fn smooth<X: Over<M>, M, C: Grow<T>>(
        &mut self,
        filter: &Filter<'_, X, M, T, C>,
        steps: usize,
        visit: impl FnMut(usize, &Belief<T>),
    ) -> Result<(), StepError> {
        self.fits(filter)?;
        let square = if self.square_root { 0 } else { self.states * self.states };
        let (belief, ..) = self.carve(square);
        belief.mean.copy_from_slice(filter.mean());
        belief.factor.copy_from_slice(filter.factor());
        if square > 0 {
            filter.write_cov(belief.cov);
        }
        self.go_back::<X::Form>(filter.time(), 0, steps, visit)
    }

    /// The same from any belief at the time of the latest record but `skip`.
    ///
    /// # Errors
    /// As [`smooth`](Self::smooth).
    pub fn smooth_from<F: Form>(
        &mut self,
        start: Prior,
        skip: usize,
        steps: usize,
        visit: impl FnMut(usize, &Belief<T>),
    ) -> Result<(), StepError> {
        self.room::<F>(start.mean.len()).map_err(|fault| StepError { fault, time: start.time, step: 0 })?;
        let square = if F::SQUARE_ROOT { 0 } else { self.states * self.states };
        let (belief, ..) = self.carve(square);
        let put = |to: &mut [T], from: &[f64]| to.iter_mut().zip(from).for_each(|(to, &x)| *to = T::of(x));
        put(belief.mean, start.mean);
        put(belief.factor, start.factor);
        put(belief.cov, start.cov);
        self.go_back::<F>(start.time, skip, steps, visit)
    }

    /// The means alone, by the gains alone (2011 §7, remark ii): `mean`, of length n, is that of the latest record's end,
    /// and becomes the smoothed one at each earlier time in turn.
    ///
    /// # Errors
    /// A mean of another length, or too little memory.
    pub fn smooth_means(
        &mut self,
        mean: &mut [T],
        steps: usize,
        mut visit: impl FnMut(usize, &[T]),
    ) -> Result<(), Fault> {
        let room = if self.square_root {
            self.room::<SquareRoot>(mean.len())
        } else {
            self.room::<Covariance>(mean.len())
        };
        room?;
        let (newest, capacity, count) = (self.oldest + self.count, self.capacity, self.count);
        let (square_root, len) = (self.square_root, Self::record_len(self.states, self.square_root));
        let (_, records, scratch) = self.carve(0);
        visit(0, mean);
        for age in 1..=steps.min(count) {
            let slot = (newest - age) % capacity;
            let passage = passage(&records[slot * len..(slot + 1) * len], &[], mean.len(), square_root);
            mean_back(&passage, mean, scratch);
            visit(age, mean);
        }
        Ok(())
    }

    /// The belief on its way back, the records, and scratch.
    fn carve(&mut self, square: usize) -> (Belief<'_, T>, &[T], &mut [T]) {
        let (n, len) = (self.states, Self::record_len(self.states, self.square_root));
        let (records, mut rest) = self.memory.as_mut().split_at_mut(self.capacity * len);
        let rest_of = &mut rest;
        let belief = Belief {
            mean: take(rest_of, n),
            factor: take(rest_of, n * n),
            cov: take(rest_of, square),
            moved: &mut [],
        };
        (belief, records, rest)
    }

    fn go_back<F: Form>(
        &mut self,
        time: f64,
        skip: usize,
        steps: usize,
        mut visit: impl FnMut(usize, &Belief<T>),
    ) -> Result<(), StepError> {
        let n = self.states;
        let (len, capacity, count) = (Self::record_len(n, self.square_root), self.capacity, self.count);
        let newest = self.oldest + count - skip.min(count);
        let square = if F::SQUARE_ROOT { 0 } else { n * n };
        let (mut belief, records, rest) = self.carve(square);
        visit(0, &belief);
        let held = count - skip.min(count);
        let record = |age: usize| {
            let slot = (newest - age) % capacity;
            &records[slot * len..(slot + 1) * len]
        };
        for age in 1..=steps.min(held) {
            let before = if age < held { &record(age + 1)[2 * n + square..][..square] } else { &[] };
            let passage = passage(record(age), before, n, F::SQUARE_ROOT);
            step_back::<T, F>(&passage, &mut belief, rest).map_err(|fault| StepError {
                fault,
                time,
                step: newest - age,
            })?;
            visit(age, &belief);
        }
        Ok(())
    }
}

/// A filter must leave what its smoother needs.
pub(super) fn for_smoothing<X: Over<M>, M, T: Real, C: Grow<T>>(
    filter: &Filter<'_, X, M, T, C>,
) -> Result<(), Fault> {
    let (expected, found) = (filter.factor().len(), filter.backward().0.len());
    if expected == found {
        return Ok(());
    }
    Err(Fault::Length { of: "the gain of a filter that was not started for smoothing", expected, found })
}

/// The arrays of one record; `before` is the predicted covariance of the one before it.
fn passage<'a, T>(mut record: &'a [T], before: &'a [T], n: usize, square_root: bool) -> Passage<'a, T> {
    let square = if square_root { 0 } else { n * n };
    let mut next = |len: usize| {
        let (head, tail) = record.split_at(len);
        record = tail;
        head
    };
    Passage {
        mean: next(n),
        cov: next(square),
        before,
        predicted_mean: next(n),
        predicted_cov: next(square),
        gain: next(n * n),
        conditional: next(n * n - square),
    }
}
