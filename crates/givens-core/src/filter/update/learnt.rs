//! What the measurement updates since the last prediction leave for the way back.

use super::Sensed;
use crate::filter::error::{Fault, Matrix};
use crate::filter::memory::take;
use crate::filter::predict::split;
use crate::kernels::{downdate, sweep, tria};
use crate::scalar::{Mask, Real};

/// x = m⁻ + S⁻ a before the updates and x = m + S u after them: a = shift + turn u (docs/algorithms.md S4). Empty in
/// covariance form, and in a filter that was not started for smoothing.
#[derive(Debug)]
pub struct Learnt<'a, T> {
    /// Length n.
    pub shift: &'a mut [T],
    /// n × n.
    pub turn: &'a mut [T],
}

/// Scalars of scratch of [`turned`], for `rest` columns of E and noise.
pub(super) const fn turned_scratch(n: usize, d: usize, rest: usize) -> usize {
    let wide = if rest > d { rest } else { d };
    (d + n) * (d + n) + d * wide + (d + n) + 2 * n + 2 * n * n
}

/// The rotation of an update.
pub(super) struct Rotation<'a, T> {
    /// d + n rows of that length, [T11 0; A B].
    pub block: &'a [T],
    /// S = S⁻ B, lower triangular n × n.
    pub posterior: &'a [T],
}

/// [T11 0; A B] = Tria([Z S_R; I 0]): the rotation of the joint update (docs/algorithms.md U2).
#[inline(always)]
pub(super) fn turned<'a, T: Real>(
    sensed: &Sensed<T>,
    n: usize,
    factor: &[T],
    scratch: &mut &'a mut [T],
) -> Result<(Rotation<'a, T>, T::Mask), Fault> {
    let (d, stride) = (sensed.d, sensed.stride);
    let (rest, size) = (stride - n, d + n);
    let wide = rest.max(d);
    let block = take(scratch, size * size);
    let posterior = take(scratch, n * n);
    let (noise, more) = scratch.split_at_mut(d * wide);
    let (column, more) = more.split_at_mut(size);
    for (to, from) in noise.chunks_exact_mut(wide).zip(sensed.dev.chunks_exact(stride)) {
        to[..rest].copy_from_slice(&from[n..]);
    }
    let mut sick = tria(noise, d, rest, wide).sick;
    block.fill(T::zero());
    for i in 0..d {
        block[i * size..][..d].copy_from_slice(&noise[i * wide..][..d]);
        block[i * size + d..][..n].copy_from_slice(&sensed.dev[i * stride..][..n]);
    }
    for i in 0..n {
        block[(d + i) * size + d + i] = T::one();
    }
    sick = sick | sweep(block, d, n, more).sick;
    for k in 0..sensed.lost {
        column.fill(T::zero());
        for (v, row) in column.iter_mut().zip(sensed.minus.chunks_exact(sensed.lost)).take(d) {
            *v = row[k];
        }
        sick = sick | split(downdate(block, size, size, column), d, Matrix::Innovation, Matrix::Posterior)?;
    }
    for i in 0..n {
        for j in 0..n {
            let column = (j..=i).map(|k| (factor[i * n + k], block[(d + k) * size + d + j]));
            posterior[i * n + j] = column.fold(T::zero(), |sum, (s, b)| s.mul_add(b, sum));
        }
    }
    Ok((Rotation { block, posterior }, sick))
}

impl<T: Real> Rotation<'_, T> {
    /// Puts the posterior's root into the coordinates of this rotation. A root by other means is the same but for
    /// rounding, and stays as it is, unless the posterior is nearly singular: its root is then not unique.
    pub fn settle(&self, factor: &mut [T]) {
        let n = factor.len().isqrt();
        let rounding = T::of(64.0 * n as f64 * T::EPSILON);
        let apart = factor.chunks_exact(n).zip(self.posterior.chunks_exact(n)).any(|(s, other)| {
            let norm = other.iter().fold(T::zero(), |sum, &x| x.mul_add(x, sum)).sqrt();
            s.iter().zip(other).any(|(&x, &y)| (rounding * norm).lt((x - y).abs()).any())
        });
        if apart {
            factor.copy_from_slice(self.posterior);
        }
    }
}

impl<T: Real> Learnt<'_, T> {
    /// Nothing learnt: a = u.
    pub fn reset(&mut self, n: usize) {
        self.shift.fill(T::zero());
        for (i, x) in self.turn.iter_mut().enumerate() {
            *x = if i % (n + 1) == 0 { T::one() } else { T::zero() };
        }
    }

    /// Adds an update: shift ← shift + turn A e, turn ← turn B, e = T11⁻¹ ν.
    #[inline(always)]
    pub(super) fn add(&mut self, block: &[T], d: usize, white: &[T], scratch: &mut [T]) {
        let n = self.shift.len();
        let size = d + n;
        let (product, rest) = scratch.split_at_mut(n * n);
        let moved = &mut rest[..n];
        for (i, moved) in moved.iter_mut().enumerate() {
            let row = &block[(d + i) * size..][..d];
            *moved = row.iter().zip(white).fold(T::zero(), |sum, (&a, &e)| a.mul_add(e, sum));
        }
        for (shift, row) in self.shift.iter_mut().zip(self.turn.chunks_exact(n)) {
            *shift = row.iter().zip(&*moved).fold(*shift, |sum, (&t, &x)| t.mul_add(x, sum));
        }
        product.copy_from_slice(self.turn);
        for (to, row) in self.turn.chunks_exact_mut(n).zip(product.chunks_exact(n)) {
            to.fill(T::zero());
            for (k, &x) in row.iter().enumerate() {
                for (to, &y) in to.iter_mut().zip(&block[(d + k) * size + d..][..n]) {
                    *to = x.mul_add(y, *to);
                }
            }
        }
    }
}
