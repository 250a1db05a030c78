//! A model that counts how often its drift is evaluated.

use givens::model::{At, Sde, Varies};
use givens::scalar::Real;
use std::cell::Cell;

/// A model without overridden methods, and the evaluations of its drift.
///
/// One point in numbers counts as one. A dual carries a value and two derivatives and counts as three.
#[derive(Debug)]
pub struct Counted<M> {
    model: M,
    evaluations: Cell<usize>,
}

impl<M> Counted<M> {
    /// A model that has not been evaluated yet.
    pub const fn new(model: M) -> Self {
        Self { model, evaluations: Cell::new(0) }
    }

    /// The evaluations since this was last asked.
    pub fn take(&self) -> usize {
        self.evaluations.take()
    }
}

impl<M: Sde> Sde for Counted<M> {
    fn states(&self) -> usize {
        self.model.states()
    }

    fn noises(&self) -> usize {
        self.model.noises()
    }

    #[inline(always)]
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        let numbers = size_of::<T>() / size_of::<f64>();
        self.evaluations.set(self.evaluations.get() + numbers);
        self.model.drift(at, x, dx);
    }

    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        self.model.diffusion(at, x, g);
    }

    fn diffusion_varies(&self) -> Varies {
        self.model.diffusion_varies()
    }
}
