//! One loop for all explicit Runge–Kutta methods (docs/algorithms.md O1, O2).

use super::System;
use super::field::{Failed, Field, Method};
use super::segment::hermite;
use super::tableau::Tableau;
use crate::scalar::Real;

/// Scalars of memory of the slopes.
pub(super) const fn explicit_scratch(tableau: &Tableau, len: usize) -> usize {
    (tableau.stages + 1) * len
}

/// A method given by its tableau.
pub(super) struct Explicit<'a, T> {
    pub tableau: &'static Tableau,
    /// The slopes k_i, one behind the other, and last the slope at the end of the step.
    pub k: &'a mut [T],
    pub len: usize,
}

impl<T: Real> Explicit<'_, T> {
    /// Component `r` of Σ `weights`_i k_i, in the order of the stages.
    #[inline(always)]
    fn sum(&self, weights: &[f64], r: usize) -> T {
        let slopes = self.k[r..].iter().step_by(self.len);
        let terms = weights.iter().zip(slopes).filter(|(weight, _)| **weight != 0.0);
        terms.fold(T::zero(), |sum, (&weight, &k)| k.mul_add(T::of(weight), sum))
    }
}

impl<T: Real, S: System> Method<T, S> for Explicit<'_, T> {
    const ERROR_ORDER: i32 = 5;

    #[inline(always)]
    fn start(&mut self, field: &mut Field<S, T>, t: T, y: &[T]) -> Result<(), S::Fault> {
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
            for r in 0..self.len {
                end[r] = self.sum(row, r).mul_add(h, y[r]);
            }
            let time = T::of(self.tableau.c[i]).mul_add(h, t);
            field.slope(time, end, &mut self.k[i * self.len..][..self.len])?;
        }
        for r in 0..self.len {
            end[r] = self.sum(self.tableau.b, r).mul_add(h, y[r]);
        }
        Ok(())
    }

    #[inline(always)]
    fn finish(&mut self, field: &mut Field<S, T>, t: T, end: &[T]) -> Result<(), S::Fault> {
        field.slope(t, end, &mut self.k[self.tableau.stages * self.len..][..self.len])
    }

    fn slopes(&self) -> (&[T], &[T]) {
        (&self.k[..self.len], &self.k[self.tableau.stages * self.len..])
    }

    #[inline(always)]
    fn error(&self, h: T, error: &mut [T]) {
        for (r, error) in error.iter_mut().enumerate() {
            *error = h * self.sum(self.tableau.error, r);
        }
    }

    fn curve(&self, h: T, y: &[T], end: &[T], ended: bool, curve: &mut [T]) {
        let slopes = (&self.k[..self.len], &self.k[self.tableau.stages * self.len..]);
        hermite(h, y, end, slopes, ended, curve);
        for (r, quartic) in curve[2 * self.len..].iter_mut().enumerate() {
            *quartic = h * self.sum(self.tableau.dense, r);
        }
    }

    #[inline(always)]
    fn accept(&mut self) {
        let last = self.tableau.stages * self.len;
        self.k.copy_within(last..last + self.len, 0);
    }
}
