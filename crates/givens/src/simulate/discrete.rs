//! The path of a discrete model.

use super::Stream;
use super::rows::{Moves, finite, healthy};
use crate::filter::predict::{OneTransition, Plan, TimeUpdate};
use crate::filter::{Fault, Matrix, Quantity};
use crate::model::{At, Transition};

/// A transition and its memory.
pub(super) struct Discrete<'m, M> {
    model: &'m M,
    columns: usize,
    next: Vec<f64>,
    s_q: Vec<f64>,
    w: Vec<f64>,
}

impl<'m, M: Transition> Discrete<'m, M> {
    pub fn new(model: &'m M) -> Self {
        let n = model.states();
        let columns = model.noise().columns(n);
        Self { model, columns, next: vec![0.0; n], s_q: vec![0.0; n * columns], w: vec![0.0; columns] }
    }
}

impl<M: Transition> Moves for Discrete<'_, M> {
    fn states(&self) -> usize {
        self.model.states()
    }

    fn controls(&self) -> usize {
        self.model.controls()
    }

    fn parameters(&self) -> &[f64] {
        self.model.parameters()
    }

    fn advance(
        &mut self,
        from: f64,
        to: f64,
        u: &[f64],
        x: &mut [f64],
        stream: &mut Stream,
    ) -> Result<(), Fault> {
        let model = self.model;
        let Plan { count, dt } = OneTransition.plan(model, from, to)?;
        for k in 0..count {
            let at = At { t: from + k as f64 * dt, dt, u, p: model.parameters() };
            model.transition(&at, x, &mut self.next);
            healthy(model.noise_root(&at, &mut self.s_q), Matrix::ProcessNoise)?;
            finite(&self.s_q, self.columns.max(1), Quantity::ProcessNoise)?;
            x.copy_from_slice(&self.next);
            stream.add_noise(x, &self.s_q, self.columns, &mut self.w);
            finite(x, 1, Quantity::Transition)?;
        }
        Ok(())
    }
}
