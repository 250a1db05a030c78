//! The record of a filter's time updates, in memory that the caller lends: all of them, or a ring of the last ones.

use super::back::{Passage, back_scratch, mean_back, step_back};
use super::rotated::{Coordinates, Rotated, rotated_len};
use crate::filter::memory::take;
use crate::filter::predict::multiply;
use crate::filter::{Belief, Fault, Filter, Form, Grow, Over, Prior, StepError};
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
    /// A prediction has failed within its gap: the records no longer lead to the filter's belief.
    broken: bool,
    memory: B,
    scalar: PhantomData<T>,
}

impl<T: Real, B: AsRef<[T]> + AsMut<[T]>> History<T, B> {
    /// Scalars of one record of a filter of n states.
    #[must_use]
    pub const fn record_len(states: usize) -> usize {
        2 * states + 3 * states * states
    }

    /// Scalars of memory for `capacity` records and the backward pass.
    #[must_use]
    pub const fn memory_len(states: usize, capacity: usize) -> usize {
        let belief = states + 2 * states * states;
        let (back, rotated) = (back_scratch(states), rotated_len(states));
        capacity * Self::record_len(states) + belief + if back > rotated { back } else { rotated }
    }

    /// A history for filters of n `states`; it holds as many records as `memory` has room for.
    pub fn new(states: usize, square_root: bool, mut memory: B) -> Self {
        let room = memory.as_mut().len().saturating_sub(Self::memory_len(states, 0));
        let capacity = room / Self::record_len(states).max(1);
        Self {
            states,
            square_root,
            capacity,
            oldest: 0,
            count: 0,
            broken: false,
            memory,
            scalar: PhantomData,
        }
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
    fn room(&mut self, states: usize, square_root: bool) -> Result<(), Fault> {
        let fixed = Self::memory_len(self.states, 0);
        for (of, expected, found) in [
            ("the history's states", self.states, states),
            ("the roots of the history's records", usize::from(self.square_root), usize::from(square_root)),
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
        let room = self.room(filter.mean().len(), X::Form::SQUARE_ROOT);
        let whole = if self.broken { Err(BROKEN) } else { Ok(()) };
        room.and_then(|()| for_smoothing(filter)).and(whole).map_err(|fault| filter.fail(fault))
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
        if self.capacity == 0 {
            return filter.predict(t);
        }
        self.fits(filter)?;
        self.close(filter);
        // the belief before waits in memory of the way back: in a full ring, its record is still the oldest one's
        let n = self.states;
        let (mean, rest) = self.carve().1.split_at_mut(n);
        mean.copy_from_slice(filter.mean());
        if X::Form::SQUARE_ROOT {
            rest[..n * n].copy_from_slice(filter.factor());
        } else {
            filter.write_cov(&mut rest[..n * n]);
        }
        let start = filter.time();
        filter.predict(t).inspect_err(|_| self.broken = filter.time() > start)?;
        let slot = (self.oldest + self.count) % self.capacity;
        let (records, belief) = self.memory.as_mut().split_at_mut(self.capacity * Self::record_len(n));
        let mut record = &mut records[slot * Self::record_len(n)..][..Self::record_len(n)];
        take(&mut record, n + n * n).copy_from_slice(&belief[..n + n * n]);
        let (gain, conditional) = filter.backward();
        if X::Form::SQUARE_ROOT {
            take(&mut record, n).fill(T::zero());
        } else {
            take(&mut record, n).copy_from_slice(filter.mean());
            filter.write_cov(take(&mut record, n * n));
        }
        take(&mut record, n * n).copy_from_slice(gain);
        record.copy_from_slice(conditional);
        if self.count == self.capacity {
            self.oldest = (self.oldest + 1) % self.capacity;
        } else {
            self.count += 1;
        }
        Ok(())
    }

    /// Completes the newest record, in square-root form, by what the updates at its end have learnt. [`predict`](Self::predict)
    /// does so first; by hand it is needed before [`smooth_on`](Self::smooth_on) alone.
    pub fn close<X: Over<M>, M, C: Grow<T>>(&mut self, filter: &mut Filter<'_, X, M, T, C>) {
        let (n, len) = (self.states, Self::record_len(self.states));
        if self.count == 0 || !self.square_root {
            return;
        }
        let slot = (self.oldest + self.count - 1) % self.capacity;
        let (records, belief) = self.memory.as_mut().split_at_mut(self.capacity * len);
        let record = &mut records[slot * len..(slot + 1) * len];
        let (shift, rest) = record[n + n * n..].split_at_mut(n);
        let (gain, product) = (&mut rest[..n * n], &mut belief[..n * n]);
        let (learnt, turn) = filter.learnt();
        for (shift, row) in shift.iter_mut().zip(gain.chunks_exact(n)) {
            *shift = row.iter().zip(learnt).fold(*shift, |sum, (&g, &x)| g.mul_add(x, sum));
        }
        multiply(product, n, gain, turn);
        gain.copy_from_slice(product);
        filter.forget_learnt();
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
        visit: impl FnMut(usize, &Smoothed<T>),
    ) -> Result<(), StepError> {
        self.fits(filter)?;
        let (n, (_, mut rest)) = (self.states, self.carve());
        let belief = present(n, &mut rest);
        belief.mean.copy_from_slice(filter.mean());
        belief.factor.copy_from_slice(filter.factor());
        filter.write_cov(belief.cov);
        self.go_back(filter.time(), filter.learnt(), 0, steps, visit)
    }

    /// The same from a belief at the time of the latest record but `skip`, with every update at that time: the filter's own
    /// before its next prediction.
    ///
    /// # Errors
    /// As [`smooth`](Self::smooth).
    pub fn smooth_from<F: Form>(
        &mut self,
        start: Prior,
        skip: usize,
        steps: usize,
        visit: impl FnMut(usize, &Smoothed<T>),
    ) -> Result<(), StepError> {
        let room = self.room(start.mean.len(), F::SQUARE_ROOT);
        room.map_err(|fault| StepError { fault, time: start.time, step: 0 })?;
        let (n, (_, mut rest)) = (self.states, self.carve());
        let belief = present(n, &mut rest);
        let put = |to: &mut [T], from: &[f64]| to.iter_mut().zip(from).for_each(|(to, &x)| *to = T::of(x));
        put(belief.mean, start.mean);
        put(belief.factor, start.factor);
        put(belief.cov, start.cov);
        self.go_back(start.time, (&[], &[]), skip, steps, visit)
    }

    /// The same from a smoothed belief that another history has found at the end of the newest record, which must be
    /// [closed](Self::close): states between two rows are smoothed beside the recursion over the rows.
    ///
    /// # Errors
    /// As [`smooth`](Self::smooth).
    pub fn smooth_on(
        &mut self,
        time: f64,
        from: &Smoothed<T>,
        visit: impl FnMut(usize, &Smoothed<T>),
    ) -> Result<(), StepError> {
        let room = self.room(from.belief.mean.len(), !from.root.is_empty());
        room.map_err(|fault| StepError { fault, time, step: 0 })?;
        let (n, steps, (_, mut rest)) = (self.states, self.count, self.carve());
        let belief = present(n, &mut rest);
        belief.mean.copy_from_slice(from.belief.mean);
        belief.factor.copy_from_slice(from.belief.factor);
        belief.cov.copy_from_slice(from.belief.cov);
        self.go_back(time, (from.shift, from.root), 0, steps, visit)
    }

    /// The means alone, by the gains alone (2011 §7, remark ii): `visit` is called as in [`smooth`](Self::smooth).
    ///
    /// # Errors
    /// A filter that does not go with this history.
    pub fn smooth_means<X: Over<M>, M, C: Grow<T>>(
        &mut self,
        filter: &Filter<'_, X, M, T, C>,
        steps: usize,
        mut visit: impl FnMut(usize, &[T]),
    ) -> Result<(), StepError> {
        self.fits(filter)?;
        let (n, newest, capacity, count) = (self.states, self.oldest + self.count, self.capacity, self.count);
        let (records, mut rest) = self.carve();
        let mean = take(&mut rest, n);
        mean.copy_from_slice(filter.mean());
        visit(0, mean);
        let record = |age: usize| {
            let len = Self::record_len(n);
            &records[(newest - age) % capacity * len..][..len]
        };
        if X::Form::SQUARE_ROOT {
            let (shift, turn) = filter.learnt();
            let mut coordinates = Coordinates::start(n, shift, turn, &mut rest);
            for age in 1..=steps.min(count) {
                let record = Rotated::of(record(age), n);
                coordinates.mean_back(&record, rest);
                coordinates.write_mean(&record, mean);
                visit(age, mean);
            }
        } else {
            for age in 1..=steps.min(count) {
                mean_back(&Passage::of(record(age), &[], n), mean, rest);
                visit(age, mean);
            }
        }
        Ok(())
    }

    /// The records, and memory beside them.
    fn carve(&mut self) -> (&[T], &mut [T]) {
        let (records, rest) =
            self.memory.as_mut().split_at_mut(self.capacity * Self::record_len(self.states));
        (records, rest)
    }

    fn go_back(
        &mut self,
        time: f64,
        (shift, turn): (&[T], &[T]),
        skip: usize,
        steps: usize,
        mut visit: impl FnMut(usize, &Smoothed<T>),
    ) -> Result<(), StepError> {
        let (n, square_root, capacity) = (self.states, self.square_root, self.capacity);
        let held = self.count - skip.min(self.count);
        let newest = self.oldest + held;
        let (records, mut rest) = self.carve();
        let belief = present(n, &mut rest);
        let record = |age: usize| {
            let len = Self::record_len(n);
            &records[(newest - age) % capacity * len..][..len]
        };
        if square_root {
            let mut coordinates = Coordinates::start(n, &[], &[], &mut rest);
            let mut smoothed = Smoothed { belief, shift: coordinates.mean, root: coordinates.root };
            visit(0, &smoothed);
            if !turn.is_empty() {
                smoothed.shift.copy_from_slice(shift);
                smoothed.root.copy_from_slice(turn);
            }
            for age in 1..=steps.min(held) {
                let record = Rotated::of(record(age), n);
                coordinates = Coordinates { mean: smoothed.shift, root: smoothed.root };
                coordinates.back(&record, rest);
                coordinates.write(&record, &mut smoothed.belief);
                (smoothed.shift, smoothed.root) = (coordinates.mean, coordinates.root);
                visit(age, &smoothed);
            }
            return Ok(());
        }
        let mut smoothed = Smoothed { belief, shift: &mut [], root: &mut [] };
        visit(0, &smoothed);
        for age in 1..=steps.min(held) {
            let before = if age < held { &record(age + 1)[2 * n + n * n..][..n * n] } else { &[] };
            let passage = Passage::of(record(age), before, n);
            step_back(&passage, &mut smoothed.belief, rest).map_err(|fault| StepError {
                fault,
                time,
                step: newest - age,
            })?;
            visit(age, &smoothed);
        }
        Ok(())
    }
}

/// A belief on its way back.
#[derive(Debug)]
pub struct Smoothed<'a, T> {
    /// mˢ, Sˢ and, in covariance form, Pˢ.
    pub belief: Belief<'a, T>,
    /// Square-root form: x = m + S u with m and S as filtered, and the mean of u, length n. Empty in covariance form.
    pub shift: &'a mut [T],
    /// A root of the covariance of u, n × n. Empty in covariance form.
    pub root: &'a mut [T],
}

/// The belief on its way back.
fn present<'a, T>(n: usize, memory: &mut &'a mut [T]) -> Belief<'a, T> {
    Belief { mean: take(memory, n), factor: take(memory, n * n), cov: take(memory, n * n), moved: &mut [] }
}

/// The filter has moved and no record says how.
pub(super) const BROKEN: Fault = Fault::Mismatch {
    why: "a prediction has failed within its gap, and the filter has moved without a record; start anew from its belief",
};

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
