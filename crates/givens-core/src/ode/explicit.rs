//! One loop for all explicit Runge–Kutta methods (docs/algorithms.md O1, O2).

use super::System;
use super::field::{Failed, Field, Method};
use super::segment::hermite;
use super::tableau::{Tableau, combine};
use crate::scalar::Real;

/// Scalars of memory of the slopes.
pub(super) const fn explicit_scratch(tableau: &Tableau, len: usize) -> usize {
    len.saturating_mul(tableau.stages + 1)
}

/// A method given by its tableau.
pub(super) struct Explicit<'a, T> {
    pub tableau: &'static Tableau,
    /// The slopes k_i, one behind the other, and last the slope at the end of the step.
    pub k: &'a mut [T],
    pub len: usize,
}

impl<T: Real> Explicit<'_, T> {
    /// y + h Σ weights_i k_i.
    #[inline(always)]
    fn reach(&self, weights: &[f64], h: T, y: &[T], out: &mut [T]) {
        combine(weights, self.k, out);
        for (out, &y) in out.iter_mut().zip(y) {
            *out = out.mul_add(h, y);
        }
    }

    /// h Σ weights_i k_i.
    #[inline(always)]
    fn increment(&self, weights: &[f64], h: T, out: &mut [T]) {
        combine(weights, self.k, out);
        for out in out {
            *out *= h;
        }
    }

    /// The slopes at the start and at the end.
    #[inline(always)]
    fn ends(&self) -> (&[T], &[T]) {
        (&self.k[..self.len], &self.k[self.tableau.stages * self.len..])
    }
}

impl<T: Real, S: System> Method<T, S> for Explicit<'_, T> {
    // that of the one pair among them
    const ERROR_ORDER: i32 = 5;

    #[inline(always)]
    fn start(&mut self, field: &mut Field<S, T>, t: T, y: &[T]) -> Result<(), Failed<S::Fault>> {
        field.slope(t, y, &mut self.k[..self.len])
    }

    #[inline(always)]
    fn step(
        &mut self,
        field: &mut Field<S, T>,
        t: T,
        h: T,
        y: &[T],
        end: &mut [T],
    ) -> Result<(), Failed<S::Fault>> {
        let mut weights = self.tableau.a;
        for i in 1..self.tableau.stages {
            let (row, rest) = weights.split_at(i);
            weights = rest;
            self.reach(row, h, y, end);
            let time = T::of(self.tableau.c[i]).mul_add(h, t);
            field.slope(time, end, &mut self.k[i * self.len..][..self.len])?;
        }
        self.reach(self.tableau.b, h, y, end);
        Ok(())
    }

    #[inline(always)]
    fn finish(&mut self, field: &mut Field<S, T>, t: T, end: &[T]) -> Result<(), Failed<S::Fault>> {
        field.slope(t, end, &mut self.k[self.tableau.stages * self.len..][..self.len])
    }

    #[inline(always)]
    fn slopes(&self) -> (&[T], &[T]) {
        self.ends()
    }

    fn error(&self, h: T, error: &mut [T]) {
        self.increment(self.tableau.error, h, error);
    }

    #[inline(always)]
    fn curve(&self, h: T, y: &[T], end: &[T], ended: bool, curve: &mut [T]) {
        hermite(h, y, end, self.ends(), ended, curve);
        self.increment(self.tableau.dense, h, &mut curve[2 * self.len..]);
    }

    #[inline(always)]
    fn accept(&mut self) {
        let last = self.tableau.stages * self.len;
        self.k.copy_within(last..last + self.len, 0);
    }
}
