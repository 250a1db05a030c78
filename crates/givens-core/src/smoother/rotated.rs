//! One step back in square-root form, in the coordinates of the roots (docs/algorithms.md S2–S5).

use crate::filter::backward::{multiply, multiply_lower};
use crate::filter::lanes::spoil;
use crate::filter::memory::{put_columns, take, vectors_and_matrices};
use crate::filter::{Belief, Learnt};
use crate::kernels::{copy_lower, outlined, tria};
use crate::scalar::Real;

/// What was recorded of the time update from k to k + 1 and of the updates at k + 1: given all of them, x_k = m_k + S_k u
/// with u ~ N(shift + gain u', conditional conditionalᵀ), u' being the same of k + 1.
#[derive(Debug)]
pub(super) struct Rotated<'a, T> {
    /// m_k, filtered.
    pub mean: &'a [T],
    /// S_k, filtered.
    pub factor: &'a [T],
    /// Length n.
    pub shift: &'a [T],
    /// n × n.
    pub gain: &'a [T],
    /// Lower triangular, n × n.
    pub conditional: &'a [T],
}

impl<'a, T> Rotated<'a, T> {
    /// The arrays of one record.
    #[inline(always)]
    pub fn of(record: &'a [T], n: usize) -> Self {
        let (mean, rest) = record.split_at(n);
        let (factor, rest) = rest.split_at(n * n);
        let (shift, rest) = rest.split_at(n);
        let (gain, conditional) = rest.split_at(n * n);
        Self { mean, factor, shift, gain, conditional }
    }
}

/// Scalars of the coordinates on their way back, with the scratch of a step.
pub(super) const fn rotated_len(n: usize) -> usize {
    vectors_and_matrices(n, 2, 4)
}

/// N(mean, root rootᵀ) of the coordinates u.
#[derive(Debug)]
pub(super) struct Coordinates<'a, T> {
    pub mean: &'a mut [T],
    pub root: &'a mut [T],
}

outlined! {
    /// Takes the coordinates back to those of the record's belief, and writes the belief that they make of it.
    pub(super) fn rotate_back(
        coordinates: &mut Coordinates<'_, T>,
        record: &Rotated<'_, T>,
        belief: &mut Belief<'_, T>,
        scratch: &mut [T]
    ) -> () = rotated_back
}

#[inline(always)]
fn rotated_back<T: Real>(
    coordinates: &mut Coordinates<T>,
    record: &Rotated<T>,
    belief: &mut Belief<T>,
    scratch: &mut [T],
) {
    coordinates.root_back(record, scratch);
    coordinates.write(record, belief);
}

impl<'a, T: Real> Coordinates<'a, T> {
    /// From what the updates since the last prediction have learnt, or, if that is empty, from the present belief itself.
    #[inline(always)]
    pub fn start(n: usize, shift: &[T], turn: &[T], memory: &mut &'a mut [T]) -> Self {
        let (mean, root) = (take(memory, n), take(memory, n * n));
        if turn.is_empty() {
            Learnt { shift: mean, turn: root }.reset(n);
        } else {
            mean.copy_from_slice(shift);
            root.copy_from_slice(turn);
        }
        Self { mean, root }
    }

    /// To the coordinates of the record's belief.
    #[inline(always)]
    pub fn mean_back(&mut self, record: &Rotated<T>, scratch: &mut [T]) {
        let n = self.mean.len();
        let moved = &mut scratch[..n];
        for (i, moved) in moved.iter_mut().enumerate() {
            let row = record.gain[i * n..(i + 1) * n].iter().zip(&*self.mean);
            *moved = row.fold(record.shift[i], |sum, (&g, &u)| g.mul_add(u, sum));
        }
        self.mean.copy_from_slice(moved);
    }

    /// The same with the root.
    #[inline(always)]
    fn root_back(&mut self, record: &Rotated<T>, mut scratch: &mut [T]) {
        let n = self.mean.len();
        self.mean_back(record, scratch);
        let wide = take(&mut scratch, 2 * n * n);
        let product = take(&mut scratch, n * n);
        multiply(product, n, record.gain, self.root);
        put_columns(wide, 2 * n, 0, record.conditional, n);
        put_columns(wide, 2 * n, n, product, n);
        let health = tria(wide, n, 2 * n, 2 * n);
        copy_lower(self.root, n, wide, 2 * n);
        spoil(health.sick, &mut self.root[0]);
    }

    /// mˢ = m + S u.
    #[inline(always)]
    pub fn write_mean(&self, record: &Rotated<T>, mean: &mut [T]) {
        let n = mean.len();
        for (i, m) in mean.iter_mut().enumerate() {
            let row = record.factor[i * n..(i + 1) * n].iter().zip(&*self.mean);
            *m = row.fold(record.mean[i], |sum, (&s, &u)| s.mul_add(u, sum));
        }
    }

    /// mˢ, and Sˢ = S times the root.
    #[inline(always)]
    fn write(&self, record: &Rotated<T>, belief: &mut Belief<T>) {
        self.write_mean(record, belief.mean);
        multiply_lower(belief.factor, belief.mean.len(), record.factor, self.root);
    }
}
