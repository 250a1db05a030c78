//! The way back over a history: fixed interval, and fixed lag over a ring.

use super::back::{Passage, mean_back, step_back};
use super::history::History;
use super::rotated::{Coordinates, Rotated, rotate_back};
use crate::filter::lanes::endless;
use crate::filter::memory::take;
use crate::filter::{Belief, Filter, Form, Grow, Over, Prior, StepError};
use crate::kernels::{solve_lower, solve_lower_rows};
use crate::scalar::{Mask, Real};
use core::ops::ControlFlow;

/// What a visitor of the way back answers: nothing, or whether to go on.
pub trait Answer {
    /// Whether to go on.
    fn goes_on(self) -> bool;
}

impl Answer for () {
    fn goes_on(self) -> bool {
        true
    }
}

impl Answer for ControlFlow<()> {
    fn goes_on(self) -> bool {
        self.is_continue()
    }
}

impl<T: Real, B: AsRef<[T]> + AsMut<[T]>> History<T, B> {
    /// Goes back from the filter's present belief over at most `steps` records, the latest first. `visit` is called
    /// with 0 and the present belief, then with 1, 2, … and the smoothed belief that many time updates ago. Nothing
    /// is forgotten: a fixed-lag smoother calls this at every step. A `visit` that answers `ControlFlow::Break` ends the way.
    ///
    /// # Errors
    /// A smoothed covariance that is not positive semidefinite, in covariance form; a smoothed estimate that is not finite;
    /// the time is the filter's.
    #[inline(always)]
    pub fn smooth<X: Over<M>, M, C: Grow<T>, A: Answer>(
        &mut self,
        filter: &Filter<'_, X, M, T, C>,
        steps: usize,
        visit: impl FnMut(usize, &Smoothed<T>) -> A,
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
    /// before its next prediction. In square-root form the latest record must be [closed](Self::close) if none is skipped.
    ///
    /// # Errors
    /// As [`smooth`](Self::smooth).
    pub fn smooth_from<F: Form, A: Answer>(
        &mut self,
        start: Prior,
        skip: usize,
        steps: usize,
        visit: impl FnMut(usize, &Smoothed<T>) -> A,
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
    /// [closed](Self::close): states between two rows are smoothed beside the recursion over the rows. Where the filters of
    /// both have come to different beliefs, it is to be [seen from](Smoothed::seen_from) this one's.
    ///
    /// # Errors
    /// As [`smooth`](Self::smooth).
    pub fn smooth_on<A: Answer>(
        &mut self,
        time: f64,
        from: &Smoothed<T>,
        visit: impl FnMut(usize, &Smoothed<T>) -> A,
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
    pub fn smooth_means<X: Over<M>, M, C: Grow<T>, A: Answer>(
        &mut self,
        filter: &Filter<'_, X, M, T, C>,
        steps: usize,
        mut visit: impl FnMut(usize, &[T]) -> A,
    ) -> Result<(), StepError> {
        self.fits(filter)?;
        let (n, newest, capacity, count) = (self.states, self.oldest + self.count, self.capacity, self.count);
        let (records, mut rest) = self.carve();
        let mean = take(&mut rest, n);
        mean.copy_from_slice(filter.mean());
        if !visit(0, mean).goes_on() {
            return Ok(());
        }
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
                if !visit(age, mean).goes_on() {
                    return Ok(());
                }
            }
        } else {
            for age in 1..=steps.min(count) {
                mean_back(&Passage::of(record(age), &[], n), mean, rest);
                if !visit(age, mean).goes_on() {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn go_back<A: Answer>(
        &mut self,
        time: f64,
        (shift, turn): (&[T], &[T]),
        skip: usize,
        steps: usize,
        mut visit: impl FnMut(usize, &Smoothed<T>) -> A,
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
        let failed = |age: usize, fault| StepError { fault, time, step: newest - age };
        if square_root {
            let mut coordinates = Coordinates::start(n, &[], &[], &mut rest);
            let mut smoothed = Smoothed { belief, shift: coordinates.mean, root: coordinates.root };
            if !visit(0, &smoothed).goes_on() {
                return Ok(());
            }
            if !turn.is_empty() {
                smoothed.shift.copy_from_slice(shift);
                smoothed.root.copy_from_slice(turn);
            }
            for age in 1..=steps.min(held) {
                let record = Rotated::of(record(age), n);
                coordinates = Coordinates { mean: smoothed.shift, root: smoothed.root };
                rotate_back(&mut coordinates, &record, &mut smoothed.belief, rest);
                (smoothed.shift, smoothed.root) = (coordinates.mean, coordinates.root);
                endless(smoothed.belief.mean, smoothed.belief.factor, n)
                    .map_err(|fault| failed(age, fault))?;
                if !visit(age, &smoothed).goes_on() {
                    return Ok(());
                }
            }
            return Ok(());
        }
        let mut smoothed = Smoothed { belief, shift: &mut [], root: &mut [] };
        if !visit(0, &smoothed).goes_on() {
            return Ok(());
        }
        for age in 1..=steps.min(held) {
            let before = if age < held { &record(age + 1)[2 * n + n * n..][..n * n] } else { &[] };
            let passage = Passage::of(record(age), before, n);
            step_back(&passage, &mut smoothed.belief, rest)
                .and_then(|_| endless(smoothed.belief.mean, smoothed.belief.factor, n))
                .map_err(|fault| failed(age, fault))?;
            if !visit(age, &smoothed).goes_on() {
                return Ok(());
            }
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

impl<T: Real> Smoothed<'_, T> {
    /// The same belief in the coordinates of another, of the given `mean` and lower triangular `factor`: writes its
    /// `shift` and `root`. A coordinate that the factor does not reach is as free as ever. Square-root form only.
    pub fn seen_from(&self, mean: &[T], factor: &[T], shift: &mut [T], root: &mut [T]) {
        let n = mean.len();
        shift.iter_mut().zip(&*self.belief.mean).zip(mean).for_each(|((to, &x), &m)| *to = x - m);
        root.copy_from_slice(self.belief.factor);
        solve_lower(factor, n, shift);
        solve_lower_rows(factor, n, root, n);
        for i in (0..n).filter(|i| factor[i * n + i].same(T::zero()).all()) {
            root[i * n + i] = T::one();
        }
    }
}

/// The belief on its way back.
#[inline(always)]
pub(super) fn present<'a, T>(n: usize, memory: &mut &'a mut [T]) -> Belief<'a, T> {
    Belief { mean: take(memory, n), factor: take(memory, n * n), cov: take(memory, n * n), moved: &mut [] }
}
