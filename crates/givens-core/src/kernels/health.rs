//! What a kernel reports instead of a `Result`, so that one lane's failure does not stop the others.

use crate::scalar::{Mask, Real};

/// The lanes that a kernel could not serve, and the pivot at which each of them failed.
#[derive(Clone, Copy, Debug)]
#[must_use]
pub struct Health<T: Real> {
    /// True in the lanes that failed.
    pub sick: T::Mask,
    /// The first failing pivot of a sick lane, counted from zero.
    pub pivot: T,
}

impl<T: Real> Health<T> {
    /// No lane failed.
    #[inline(always)]
    pub fn good() -> Self {
        Self { sick: T::Mask::splat(false), pivot: T::zero() }
    }

    /// Notes that the lanes of `sick` failed at `pivot`, unless they had failed before.
    #[inline(always)]
    pub fn note(&mut self, sick: T::Mask, pivot: usize) {
        self.pivot = T::select(sick & !self.sick, T::of(pivot as f64), self.pivot);
        self.sick = self.sick | sick;
    }

    /// The failures of both, the earlier one's first.
    #[inline(always)]
    pub fn and(self, later: Self) -> Self {
        Self { sick: self.sick | later.sick, pivot: T::select(self.sick, self.pivot, later.pivot) }
    }

    /// The same with pivots counted from `by` further down.
    #[inline(always)]
    pub fn shifted(self, by: usize) -> Self {
        Self { sick: self.sick, pivot: self.pivot + T::of(by as f64) }
    }

    /// The failing pivot if every lane failed: a step then stops at once.
    #[inline(always)]
    pub fn failed(self) -> Option<usize> {
        self.sick.all().then(|| self.pivot.first() as usize)
    }
}
