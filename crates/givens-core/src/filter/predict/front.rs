//! The differential equations of the level set: the mean, and a root M of the covariance that is free to turn (2021).

use super::columns::gather;
use super::image::{Image, Imaged};
use super::integrate::Carrier;
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::lanes::{lanes, spoil};
use crate::filter::memory::take;
use crate::kernels::{dot, lu, lu_order, lu_solve, square, tria};
use crate::model::At;
use crate::ode::{System, Tolerance};
use crate::scalar::Real;

/// y = x̄, then M row by row, then, if `carried`, the matrix X of C13. M' = V + ½ N (M⁻¹ N)ᵀ (docs/algorithms.md C12).
#[derive(Clone, Copy)]
pub(super) struct Front<I> {
    pub image: I,
    pub carried: bool,
}

/// Length of the solver's state.
pub(super) const fn front_len(n: usize, carried: bool) -> usize {
    n + n * n * if carried { 2 } else { 1 }
}

/// Scalars of scratch of a derivative, for `columns` columns of N and an image that needs `image`.
pub(super) const fn front_scratch(n: usize, columns: usize, image: usize) -> usize {
    2 * n * n + n * columns + lu_order(n) + n + image
}

impl<I: Image> System for Front<I> {
    type Fault = Fault;

    fn len(&self) -> usize {
        front_len(self.image.states(), self.carried)
    }

    fn scratch(&self) -> usize {
        front_scratch(self.image.states(), self.image.noises().0, self.image.scratch())
    }

    #[inline(always)]
    fn derivative<T: Real>(
        &self,
        at: &At<T>,
        table: &[T],
        y: &[T],
        dy: &mut [T],
        mut scratch: &mut [T],
    ) -> Result<(), Fault> {
        let (n, columns) = (self.image.states(), self.image.noises().0);
        let (mean, rest) = y.split_at(n);
        let (m, x) = rest.split_at(n * n);
        let (velocity, rest) = dy.split_at_mut(n);
        let (slope, dx) = rest.split_at_mut(n * n);
        let dev = take(&mut scratch, n * n);
        let noise = take(&mut scratch, n * columns);
        let factors = take(&mut scratch, n * n);
        let order = take(&mut scratch, lu_order(n));
        let column = take(&mut scratch, n);
        self.image.image(at, table, mean, m, &mut Imaged { velocity, dev, noise }, scratch)?;
        slope.copy_from_slice(dev);
        if columns > 0 || self.carried {
            factors.copy_from_slice(m);
            let health = lu(factors, n, order);
            if let Some(pivot) = health.failed() {
                return Err(Fault::SingularFactor { pivot });
            }
            spoil(health.sick, &mut velocity[0]);
        }
        for j in 0..columns {
            gather(noise, columns, j, column);
            lu_solve(factors, n, order, column);
            for (i, row) in slope.chunks_exact_mut(n).enumerate() {
                let g = T::of(0.5) * noise[i * columns + j];
                for (to, &h) in row.iter_mut().zip(&*column) {
                    *to = g.mul_add(h, *to);
                }
            }
        }
        if self.carried {
            for j in 0..n {
                gather(x, n, j, column);
                lu_solve(factors, n, order, column);
                for i in 0..n {
                    dx[i * n + j] = dot(&dev[i * n..(i + 1) * n], column);
                }
            }
        }
        Ok(())
    }

    /// In standard deviations: |Δx̄_i|, |ΔM_ij| and |ΔX_ij| against σ_i = ‖row i of M‖.
    fn error<T: Real>(&self, tolerance: Tolerance, before: &[T], after: &[T], error: &[T]) -> f64 {
        let n = self.image.states();
        let row = |y: &[T], i: usize| {
            let row = &y[n + i * n..][..n];
            Real::sqrt(dot(row, row).first())
        };
        let mut worst = 0.0;
        for i in 0..n {
            let allowed = tolerance.of(row(before, i).max(row(after, i)));
            let size = before[i].first().abs().max(after[i].first().abs());
            let rows = error[n..].chunks_exact(n).skip(i).step_by(n).flatten();
            let spread = rows.map(|e| (e.first().abs(), allowed));
            let mean = (error[i].first().abs(), allowed.max(4.0 * T::EPSILON * size));
            for (error, allowed) in spread.chain(core::iter::once(mean)) {
                let size = if error == 0.0 { 0.0 } else { error / allowed };
                // a NaN is worse than anything
                if size > worst || size.is_nan() {
                    worst = size;
                }
            }
        }
        worst
    }
}

impl<I: Image> Carrier for Front<I> {
    type Image = I;

    fn image(&self) -> I {
        self.image
    }

    fn alone(&self) -> Self {
        Self { carried: false, ..*self }
    }

    #[inline(always)]
    fn begin<T: Real>(&self, belief: &Belief<T>, y: &mut [T]) {
        let n = self.image.states();
        y[..n].copy_from_slice(belief.mean);
        for to in y[n..].chunks_exact_mut(n * n) {
            to.copy_from_slice(belief.factor);
        }
    }

    #[inline(always)]
    fn factor<T: Real>(&self, y: &[T], factor: &mut [T]) -> Result<(), Fault> {
        let n = self.image.states();
        factor.copy_from_slice(&y[n..n + n * n]);
        spoil(lanes(tria(factor, n, n, n), Matrix::Predicted)?, &mut factor[0]);
        Ok(())
    }

    #[inline(always)]
    fn root<T: Real>(&self, y: &[T], _: &[T], root: &mut [T]) {
        let n = self.image.states();
        root.copy_from_slice(&y[n..n + n * n]);
    }

    #[inline(always)]
    fn covariance<T: Real>(&self, _: &[T], factor: &[T], cov: &mut [T]) {
        let n = self.image.states();
        square(cov, n, factor, n, n);
    }

    #[inline(always)]
    fn carried<'y, T>(&self, y: &'y [T]) -> &'y [T] {
        let n = self.image.states();
        &y[n + n * n..]
    }
}
