//! States drawn jointly from what the smoother knows of them (docs/algorithms.md S7).

use super::back::{Passage, mean_back, step_back};
use super::history::History;
use super::rotated::{Coordinates, Rotated};
use super::way_back::{Answer, present};
use crate::filter::{Fault, Filter, Form, Grow, Over, Quantity, StepError};
use crate::kernels::{dot, wild_row};
use crate::scalar::Real;

impl<T: Real, B: AsRef<[T]> + AsMut<[T]>> History<T, B> {
    /// Draws trajectories over at most `steps` records, the latest first, from the joint distribution of their states given
    /// all measurements. `draws` is memory of n scalars for each of them; `normal(i)` is asked for the next standard normal
    /// number of draw i, and `visit` is called with 0, i and the last state of draw i, then for each draw with 1 and the
    /// state one time update ago, and so on. No draw depends on how many there are.
    ///
    /// # Errors
    /// In covariance form, a covariance of a state given the next one that is not positive semidefinite; the time is the
    /// filter's. A state that is not finite. A filter that does not go with this history.
    pub fn sample<X: Over<M>, M, C: Grow<T>, A: Answer>(
        &mut self,
        filter: &Filter<'_, X, M, T, C>,
        steps: usize,
        draws: &mut [T],
        mut normal: impl FnMut(usize) -> T,
        mut visit: impl FnMut(usize, usize, &[T]) -> A,
    ) -> Result<(), StepError> {
        self.fits(filter)?;
        let (n, newest, capacity, count) = (self.states, self.oldest + self.count, self.capacity, self.count);
        let (records, mut rest) = self.carve();
        let mut belief = present(n, &mut rest);
        let record = |age: usize| {
            let len = Self::record_len(n);
            &records[(newest - age) % capacity * len..][..len]
        };
        let mut chance = |draw: usize, to: &mut [T]| to.fill_with(|| normal(draw));
        belief.mean.copy_from_slice(filter.mean());
        belief.factor.copy_from_slice(filter.factor());
        let (shift, turn) = filter.learnt();
        for (draw, own) in draws.chunks_exact_mut(n).enumerate() {
            let (x, scratch) = rest.split_at_mut(n);
            let u = &mut scratch[..n];
            chance(draw, u);
            belief.advanced(u, x);
            if X::Form::SQUARE_ROOT {
                affine(shift, turn, u, own);
            } else {
                own.copy_from_slice(x);
            }
            drawn(x).map_err(|fault| filter.fail(fault))?;
            if !visit(0, draw, x).goes_on() {
                return Ok(());
            }
        }
        let failed = |age: usize, fault| StepError { fault, time: filter.time(), step: newest - age };
        for age in 1..=steps.min(count) {
            if X::Form::SQUARE_ROOT {
                let record = Rotated::of(record(age), n);
                for (draw, own) in draws.chunks_exact_mut(n).enumerate() {
                    let (x, scratch) = rest.split_at_mut(n);
                    chance(draw, x);
                    let mut coordinates = Coordinates { mean: own, root: &mut [] };
                    coordinates.mean_back(&record, scratch);
                    add_lower(coordinates.mean, record.conditional, x);
                    coordinates.write_mean(&record, x);
                    drawn(x).map_err(|fault| failed(age, fault))?;
                    if !visit(age, draw, x).goes_on() {
                        return Ok(());
                    }
                }
                continue;
            }
            let before = if age < count { &record(age + 1)[2 * n + n * n..][..n * n] } else { &[] };
            let passage = Passage::of(record(age), before, n);
            // the next state is known exactly
            belief.cov.fill(T::zero());
            step_back(&passage, &mut belief, rest).map_err(|fault| failed(age, fault))?;
            for (draw, own) in draws.chunks_exact_mut(n).enumerate() {
                let (noise, scratch) = rest.split_at_mut(n);
                chance(draw, noise);
                mean_back(&passage, own, scratch);
                add_lower(own, belief.factor, noise);
                drawn(own).map_err(|fault| failed(age, fault))?;
                if !visit(age, draw, own).goes_on() {
                    return Ok(());
                }
            }
        }
        Ok(())
    }
}

/// A drawn state must be finite.
fn drawn<T: Real>(x: &[T]) -> Result<(), Fault> {
    match wild_row(x, 1) {
        Some(component) => Err(Fault::NotFinite { quantity: Quantity::Estimate, component }),
        None => Ok(()),
    }
}

/// `to` = shift + A u.
fn affine<T: Real>(shift: &[T], a: &[T], u: &[T], to: &mut [T]) {
    for ((to, &s), row) in to.iter_mut().zip(shift).zip(a.chunks_exact(u.len())) {
        *to = s + dot(row, u);
    }
}

/// x + S e, S lower triangular.
fn add_lower<T: Real>(x: &mut [T], s: &[T], e: &[T]) {
    let n = x.len();
    for (i, x) in x.iter_mut().enumerate() {
        *x += dot(&s[i * n..=i * n + i], &e[..=i]);
    }
}
