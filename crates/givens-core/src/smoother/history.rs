//! The record of a filter's time updates, in memory that the caller lends: all of them, or a ring of the last ones.

use super::back::back_scratch;
use super::rotated::rotated_len;
use crate::filter::backward::multiply;
use crate::filter::memory::{larger, take, vectors_and_matrices};
use crate::filter::{Fault, Filter, Form, Grow, Over, StepError};
use crate::scalar::Real;
use core::marker::PhantomData;

/// Time updates of a filter, one record each: a ring that forgets the oldest when it is full.
///
/// With room for every update it serves the fixed-interval smoother; with room for L, the fixed-lag smoother. It follows one
/// filter: that filter is predicted by it alone, and no clone of the filter takes its place.
#[derive(Clone, Debug)]
pub struct History<T, B> {
    pub(super) states: usize,
    pub(super) square_root: bool,
    pub(super) capacity: usize,
    pub(super) oldest: usize,
    pub(super) count: usize,
    /// What [`Filter::moves`] was when the newest record was made or completed: since then none may have been missed.
    pub(super) seen: (usize, f64),
    pub(super) memory: B,
    pub(super) scalar: PhantomData<T>,
}

impl<T: Real, B: AsRef<[T]> + AsMut<[T]>> History<T, B> {
    /// Scalars of one record of a filter of n states.
    #[must_use]
    pub const fn record_len(states: usize) -> usize {
        vectors_and_matrices(states, 2, 3)
    }

    /// Scalars of memory for `capacity` records and the backward pass.
    #[must_use]
    pub const fn memory_len(states: usize, capacity: usize) -> usize {
        let belief = vectors_and_matrices(states, 1, 2);
        let beside = belief.saturating_add(larger(back_scratch(states), rotated_len(states)));
        capacity.saturating_mul(Self::record_len(states)).saturating_add(beside)
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
            seen: (0, 0.0),
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
    #[inline(always)]
    pub(super) fn room(&mut self, states: usize, square_root: bool) -> Result<(), Fault> {
        if self.square_root != square_root {
            return Err(OTHER_FORM);
        }
        let fixed = Self::memory_len(self.states, 0);
        for (of, expected, found) in [
            ("the history's states", self.states, states),
            ("the history's memory", fixed, fixed.min(self.memory.as_mut().len())),
        ] {
            if expected != found {
                return Err(Fault::Length { of, expected, found });
            }
        }
        Ok(())
    }

    /// Whether the filter goes with this history.
    #[inline(always)]
    pub(super) fn fits<X: Over<M>, M, C: Grow<T>>(
        &mut self,
        filter: &Filter<'_, X, M, T, C>,
    ) -> Result<(), StepError> {
        let room = self.room(filter.mean().len(), X::Form::SQUARE_ROOT);
        let whole = if self.count > 0 && self.seen != filter.moves() { Err(UNFOLLOWED) } else { Ok(()) };
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
        self.open(filter)?;
        let start = filter.time();
        let done = filter.predict(t);
        if done.is_ok() || filter.time() == start {
            self.seen = filter.moves();
        }
        done?;
        self.append(filter);
        Ok(())
    }

    /// Closes the newest record, and notes the belief from which the next one starts.
    #[inline(always)]
    pub(super) fn open<X: Over<M>, M, C: Grow<T>>(
        &mut self,
        filter: &mut Filter<'_, X, M, T, C>,
    ) -> Result<(), StepError> {
        self.close(filter)?;
        // the belief before waits in memory of the way back: in a full ring, its record is still the oldest one's
        let n = self.states;
        let (mean, rest) = self.carve().1.split_at_mut(n);
        mean.copy_from_slice(filter.mean());
        if X::Form::SQUARE_ROOT {
            rest[..n * n].copy_from_slice(filter.factor());
        } else {
            filter.write_cov(&mut rest[..n * n]);
        }
        Ok(())
    }

    /// Records the prediction that has just been made.
    #[inline(always)]
    pub(super) fn append<X: Over<M>, M, C: Grow<T>>(&mut self, filter: &Filter<'_, X, M, T, C>) {
        let n = self.states;
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
    }

    /// Completes the newest record, in square-root form, by what the updates at its end have learnt. [`predict`](Self::predict)
    /// does so first; by hand it is needed before [`smooth_on`](Self::smooth_on) alone.
    ///
    /// # Errors
    /// A filter that does not go with this history.
    #[inline(always)]
    pub fn close<X: Over<M>, M, C: Grow<T>>(
        &mut self,
        filter: &mut Filter<'_, X, M, T, C>,
    ) -> Result<(), StepError> {
        self.fits(filter)?;
        let (n, len) = (self.states, Self::record_len(self.states));
        if self.count == 0 || !self.square_root {
            return Ok(());
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
        self.seen = filter.moves();
        Ok(())
    }

    /// The records, and memory beside them.
    #[inline(always)]
    pub(super) fn carve(&mut self) -> (&[T], &mut [T]) {
        let (records, rest) =
            self.memory.as_mut().split_at_mut(self.capacity * Self::record_len(self.states));
        (records, rest)
    }
}

/// A smoother's memory is laid out for one form.
pub(super) const OTHER_FORM: Fault =
    Fault::Mismatch { why: "the smoother was made for filters of the other form (covariance, square root)" };

/// The filter has moved, or another smoother has taken what it has learnt, and no record says how.
pub(super) const UNFOLLOWED: Fault = Fault::Mismatch {
    why: "the filter was predicted without its smoother, or a prediction has failed within its gap, or another smoother follows it; start anew from its belief",
};

/// A filter must leave what its smoother needs.
#[inline(always)]
pub(super) fn for_smoothing<X: Over<M>, M, T: Real, C: Grow<T>>(
    filter: &Filter<'_, X, M, T, C>,
) -> Result<(), Fault> {
    let (expected, found) = (filter.factor().len(), filter.backward().0.len());
    if expected == found {
        return Ok(());
    }
    Err(Fault::Length { of: "the gain of a filter that was not started for smoothing", expected, found })
}
