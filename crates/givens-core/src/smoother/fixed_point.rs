//! The fixed-point smoother: one past state, better known with every measurement (Särkkä & Hartikainen 2010).

use super::back::symmetrise;
use crate::filter::memory::{put_columns, take};
use crate::filter::predict::multiply;
use crate::filter::{Filter, Form, Grow, Method, StepError};
use crate::kernels::{add_outer, copy_lower, square, tria};
use crate::model::Transition;
use crate::scalar::Real;
use core::marker::PhantomData;

/// The state at the time when this was begun, given all measurements since.
///
/// With B_k = B_{k−1} G_{k−1}: m_{j|k} = m_{j|k−1} + B_k (m_k − m⁻_k), and in square-root form, with no subtraction,
/// D_k = Tria([D_{k−1}  B_{k−1} D'_{k−1}]), S_{j|k} = Tria([D_k  B_k S_k]), D' the conditional root of a step.
#[derive(Clone, Debug)]
pub struct FixedPoint<T, B> {
    states: usize,
    memory: B,
    scalar: PhantomData<T>,
}

struct Parts<'a, T> {
    mean: &'a mut [T],
    cov: &'a mut [T],
    chain: &'a mut [T],
    conditional: &'a mut [T],
    predicted_mean: &'a mut [T],
    predicted_cov: &'a mut [T],
    now: &'a mut [T],
    product: &'a mut [T],
    wide: &'a mut [T],
}

fn parts<T>(n: usize, mut memory: &mut [T]) -> Parts<'_, T> {
    let m = &mut memory;
    Parts {
        mean: take(m, n),
        cov: take(m, n * n),
        chain: take(m, n * n),
        conditional: take(m, n * n),
        predicted_mean: take(m, n),
        predicted_cov: take(m, n * n),
        now: take(m, n * n),
        product: take(m, n * n),
        wide: take(m, 2 * n * n),
    }
}

impl<T: Real, B: AsRef<[T]> + AsMut<[T]>> FixedPoint<T, B> {
    /// Scalars of memory for n `states`.
    #[must_use]
    pub const fn memory_len(states: usize) -> usize {
        2 * states + 8 * states * states
    }

    /// Begins at the filter's present time, with its belief, in at least [`memory_len`](Self::memory_len) scalars.
    pub fn begin<X: Method, M: Transition, C: Grow<T>>(
        filter: &Filter<'_, X, M, T, C>,
        mut memory: B,
    ) -> Self {
        let n = filter.mean().len();
        let parts = parts(n, memory.as_mut());
        parts.mean.copy_from_slice(filter.mean());
        filter.write_cov(parts.cov);
        parts.conditional.fill(T::zero());
        for (i, b) in parts.chain.iter_mut().enumerate() {
            *b = if i % (n + 1) == 0 { T::one() } else { T::zero() };
        }
        Self { states: n, memory, scalar: PhantomData }
    }

    /// Predicts with a filter that was started for smoothing, and notes what the prediction forgets.
    ///
    /// # Errors
    /// Those of [`Filter::predict`].
    pub fn predict<X: Method, M: Transition, C: Grow<T>>(
        &mut self,
        filter: &mut Filter<'_, X, M, T, C>,
        t: f64,
    ) -> Result<(), StepError> {
        filter.predict(t)?;
        let n = self.states;
        let parts = parts(n, self.memory.as_mut());
        let (gain, conditional) = filter.backward();
        if X::Form::SQUARE_ROOT {
            multiply(parts.product, n, parts.chain, conditional);
            put_columns(parts.wide, 2 * n, 0, parts.conditional, n);
            put_columns(parts.wide, 2 * n, n, parts.product, n);
            let _ = tria(parts.wide, n, 2 * n, 2 * n);
            copy_lower(parts.conditional, n, parts.wide, 2 * n);
        } else {
            filter.write_cov(parts.predicted_cov);
        }
        multiply(parts.product, n, parts.chain, gain);
        parts.chain.copy_from_slice(parts.product);
        parts.predicted_mean.copy_from_slice(filter.mean());
        Ok(())
    }

    /// Takes in what the filter has learnt since the last prediction; call it after the updates of one time.
    pub fn update<X: Method, M: Transition, C: Grow<T>>(&mut self, filter: &Filter<'_, X, M, T, C>) {
        let n = self.states;
        let parts = parts(n, self.memory.as_mut());
        for (i, m) in parts.mean.iter_mut().enumerate() {
            let change = filter.mean().iter().zip(&*parts.predicted_mean);
            let row = &parts.chain[i * n..(i + 1) * n];
            *m = row.iter().zip(change).fold(*m, |sum, (&b, (&x, &y))| b.mul_add(x - y, sum));
        }
        if X::Form::SQUARE_ROOT {
            multiply(parts.product, n, parts.chain, filter.factor());
            put_columns(parts.wide, 2 * n, 0, parts.conditional, n);
            put_columns(parts.wide, 2 * n, n, parts.product, n);
            square(parts.cov, n, parts.wide, 2 * n, 2 * n);
        } else {
            filter.write_cov(parts.now);
            for (x, &p) in parts.now.iter_mut().zip(&*parts.predicted_cov) {
                *x -= p;
            }
            multiply(parts.product, n, parts.chain, parts.now);
            add_outer(parts.cov, n, n, parts.product, n, parts.chain, n, n, 1.0);
            symmetrise(parts.cov, n);
        }
        // a second update at this time starts from here
        parts.predicted_mean.copy_from_slice(filter.mean());
        if !X::Form::SQUARE_ROOT {
            filter.write_cov(parts.predicted_cov);
        }
    }

    /// The estimate of the state at the time of [`begin`](Self::begin).
    pub fn mean(&self) -> &[T] {
        &self.memory.as_ref()[..self.states]
    }

    /// Its covariance, n × n.
    pub fn cov(&self) -> &[T] {
        &self.memory.as_ref()[self.states..self.states + self.states * self.states]
    }
}
