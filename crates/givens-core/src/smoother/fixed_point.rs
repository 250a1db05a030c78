//! The fixed-point smoother: one past state, better known with every measurement (Särkkä & Hartikainen 2010).

use super::back::symmetrise;
use super::history::{OTHER_FORM, UNFOLLOWED, for_smoothing};
use crate::filter::backward::{multiply, multiply_lower};
use crate::filter::lanes::{endless, lanes};
use crate::filter::memory::{put_columns, take, vectors_and_matrices};
use crate::filter::{Fault, Filter, Form, Grow, Learnt, Matrix, Over, StepError};
use crate::kernels::{add_outer, cholesky_scaled, copy_lower, square_lower, tria};
use crate::scalar::{Mask, Real};
use core::marker::PhantomData;

/// The state at the time when this was begun, given all measurements since (docs/algorithms.md S6).
///
/// Square-root form: x_j = m_j + S_j u, and u is N(shift + chain u', Γ Γᵀ) given the coordinates u' of the filter's present
/// belief. Covariance form: m_{j|k} = m_{j|k−1} + B_k (m_k − m⁻_k) with B_k = B_{k−1} G_{k−1}.
#[derive(Clone, Debug)]
pub struct FixedPoint<T, B> {
    states: usize,
    square_root: bool,
    /// What [`Filter::moves`] was when this last took part: since then no move may have been missed.
    seen: (usize, f64),
    memory: B,
    scalar: PhantomData<T>,
}

struct Parts<'a, T> {
    mean: &'a mut [T],
    cov: &'a mut [T],
    factor: &'a mut [T],
    /// m_j and S_j in square-root form, m⁻_k and P⁻_k in covariance form.
    anchor_mean: &'a mut [T],
    anchor: &'a mut [T],
    /// In covariance form, what the variances of `cov` have been differences of.
    shift: &'a mut [T],
    chain: &'a mut [T],
    /// Γ in square-root form; P_k − P⁻_k in covariance form.
    conditional: &'a mut [T],
    product: &'a mut [T],
    wide: &'a mut [T],
}

fn parts<T>(n: usize, mut memory: &mut [T]) -> Parts<'_, T> {
    let m = &mut memory;
    Parts {
        mean: take(m, n),
        cov: take(m, n * n),
        factor: take(m, n * n),
        anchor_mean: take(m, n),
        anchor: take(m, n * n),
        shift: take(m, n),
        chain: take(m, n * n),
        conditional: take(m, n * n),
        product: take(m, n * n),
        wide: take(m, 2 * n * n),
    }
}

impl<T: Real, B: AsRef<[T]> + AsMut<[T]>> FixedPoint<T, B> {
    /// Scalars of memory for n `states`.
    #[must_use]
    pub const fn memory_len(states: usize) -> usize {
        vectors_and_matrices(states, 3, 8)
    }

    /// Begins at the filter's present time, with its belief; from then on this alone predicts with the filter, and a
    /// [`History`](super::History) that has followed it until now refuses it. It works in at least [`memory_len`](Self::memory_len) scalars. The
    /// filter must have been started for smoothing.
    ///
    /// # Errors
    /// It was not, or too little memory.
    pub fn begin<X: Over<M>, M, C: Grow<T>>(
        filter: &mut Filter<'_, X, M, T, C>,
        mut memory: B,
    ) -> Result<Self, StepError> {
        let n = filter.mean().len();
        for_smoothing(filter).map_err(|fault| filter.fail(fault))?;
        let (expected, found) = (Self::memory_len(n), memory.as_mut().len());
        if found < expected {
            return Err(filter.fail(Fault::Length { of: "the fixed point's memory", expected, found }));
        }
        let parts = parts(n, memory.as_mut());
        parts.mean.copy_from_slice(filter.mean());
        filter.write_cov(parts.cov);
        parts.anchor_mean.copy_from_slice(filter.mean());
        parts.anchor.copy_from_slice(if X::Form::SQUARE_ROOT { filter.factor() } else { parts.cov });
        parts.factor.copy_from_slice(filter.factor());
        parts.conditional.fill(T::zero());
        Learnt { shift: &mut *parts.shift, turn: parts.chain }.reset(n);
        if !X::Form::SQUARE_ROOT {
            parts.shift.iter_mut().zip(parts.cov.iter().step_by(n + 1)).for_each(|(to, &p)| *to = p);
        }
        filter.forget_learnt();
        let seen = filter.moves();
        Ok(Self { states: n, square_root: X::Form::SQUARE_ROOT, seen, memory, scalar: PhantomData })
    }

    /// Whether the filter goes with the one that this was begun with.
    fn fits<X: Over<M>, M, C: Grow<T>>(&self, filter: &Filter<'_, X, M, T, C>) -> Result<(), StepError> {
        let (n, found) = (self.states, filter.mean().len());
        if n != found {
            return Err(filter.fail(Fault::Length { of: "the filter's state", expected: n, found }));
        }
        if self.square_root != X::Form::SQUARE_ROOT {
            return Err(filter.fail(OTHER_FORM));
        }
        let whole = if self.seen == filter.moves() { Ok(()) } else { Err(UNFOLLOWED) };
        for_smoothing(filter).and(whole).map_err(|fault| filter.fail(fault))
    }

    /// Predicts with a filter that was started for smoothing, and notes what the prediction forgets.
    ///
    /// # Errors
    /// Those of [`Filter::predict`], or a filter that was not started for smoothing or is of another length or form.
    pub fn predict<X: Over<M>, M, C: Grow<T>>(
        &mut self,
        filter: &mut Filter<'_, X, M, T, C>,
        t: f64,
    ) -> Result<(), StepError> {
        self.fits(filter)?;
        let n = self.states;
        if X::Form::SQUARE_ROOT {
            let parts = parts(n, self.memory.as_mut());
            let (learnt, turn) = filter.learnt();
            follow(parts.shift, parts.chain, learnt);
            multiply(parts.product, n, parts.chain, turn);
            parts.chain.copy_from_slice(parts.product);
            filter.forget_learnt();
            self.seen = filter.moves();
        } else {
            self.update(filter)?;
        }
        let start = filter.time();
        let done = filter.predict(t);
        if done.is_ok() || filter.time() == start {
            self.seen = filter.moves();
        }
        done?;
        let parts = parts(n, self.memory.as_mut());
        let (gain, conditional) = filter.backward();
        if X::Form::SQUARE_ROOT {
            multiply(parts.product, n, parts.chain, conditional);
            put_columns(parts.wide, 2 * n, 0, parts.conditional, n);
            put_columns(parts.wide, 2 * n, n, parts.product, n);
            let _ = tria(parts.wide, n, 2 * n, 2 * n);
            copy_lower(parts.conditional, n, parts.wide, 2 * n);
        } else {
            parts.anchor_mean.copy_from_slice(filter.mean());
            filter.write_cov(parts.anchor);
        }
        multiply(parts.product, n, parts.chain, gain);
        parts.chain.copy_from_slice(parts.product);
        Ok(())
    }

    /// Takes in what the filter has learnt since the last prediction, for [`mean`](Self::mean), [`cov`](Self::cov) and
    /// [`factor`](Self::factor).
    ///
    /// # Errors
    /// A filter of another length or form than the one that this was begun with; a smoothed covariance that is not positive
    /// semidefinite, in covariance form; an estimate that is not finite.
    pub fn update<X: Over<M>, M, C: Grow<T>>(
        &mut self,
        filter: &Filter<'_, X, M, T, C>,
    ) -> Result<(), StepError> {
        self.fits(filter)?;
        let n = self.states;
        let parts = parts(n, self.memory.as_mut());
        if X::Form::SQUARE_ROOT {
            let (learnt, turn) = filter.learnt();
            let shift = &mut parts.product[..n];
            shift.copy_from_slice(parts.shift);
            follow(shift, parts.chain, learnt);
            parts.mean.copy_from_slice(parts.anchor_mean);
            follow(parts.mean, parts.anchor, shift);
            // the root of the state: S_j Tria([Γ  chain turn])
            multiply(parts.product, n, parts.chain, turn);
            put_columns(parts.wide, 2 * n, 0, parts.conditional, n);
            put_columns(parts.wide, 2 * n, n, parts.product, n);
            let _ = tria(parts.wide, n, 2 * n, 2 * n);
            copy_lower(parts.product, n, parts.wide, 2 * n);
            multiply_lower(parts.factor, n, parts.anchor, parts.product);
            square_lower(parts.cov, n, parts.factor);
            let done = endless(parts.mean, parts.factor, n);
            return done.map(|_| ()).map_err(|fault| filter.fail(fault));
        }
        let change = &mut parts.product[..n];
        for (to, (&x, &y)) in change.iter_mut().zip(filter.mean().iter().zip(&*parts.anchor_mean)) {
            *to = x - y;
        }
        follow(parts.mean, parts.chain, change);
        filter.write_cov(parts.conditional);
        for (x, &p) in parts.conditional.iter_mut().zip(&*parts.anchor) {
            *x -= p;
        }
        if parts.conditional.iter().all(|x| x.same(T::zero()).all()) {
            return Ok(()); // nothing learnt since the last call
        }
        multiply(parts.product, n, parts.chain, parts.conditional);
        add_outer(parts.cov, n, n, parts.product, n, parts.chain, n, n, 1.0);
        symmetrise(parts.cov, n);
        // the rounding of the sum is that of its terms
        for (scale, row) in parts.shift.iter_mut().zip(parts.chain.chunks_exact(n)) {
            let variances = parts.anchor.iter().step_by(n + 1);
            let sigma =
                row.iter().zip(variances).fold(T::zero(), |sum, (&b, &p)| b.abs().mul_add(p.sqrt(), sum));
            *scale = scale.max(sigma * sigma);
        }
        parts.factor.copy_from_slice(parts.cov);
        let done = lanes(cholesky_scaled(parts.factor, n, parts.shift), Matrix::Smoothed);
        // a second update at this time starts from here
        parts.anchor_mean.copy_from_slice(filter.mean());
        filter.write_cov(parts.anchor);
        let done = done.and_then(|_| endless(parts.mean, parts.factor, n));
        done.map(|_| ()).map_err(|fault| filter.fail(fault))
    }

    /// The estimate of the state at the time of [`begin`](Self::begin).
    pub fn mean(&self) -> &[T] {
        &self.memory.as_ref()[..self.states]
    }

    /// Its covariance, n × n.
    pub fn cov(&self) -> &[T] {
        &self.memory.as_ref()[self.states..self.states + self.states * self.states]
    }

    /// S with S Sᵀ the covariance, lower triangular n × n, diagonal ≥ 0.
    pub fn factor(&self) -> &[T] {
        let square = self.states * self.states;
        &self.memory.as_ref()[self.states + square..self.states + 2 * square]
    }
}

/// x + A v.
fn follow<T: Real>(x: &mut [T], a: &[T], v: &[T]) {
    for (x, row) in x.iter_mut().zip(a.chunks_exact(v.len().max(1))) {
        *x = row.iter().zip(v).fold(*x, |sum, (&a, &v)| a.mul_add(v, sum));
    }
}
