//! The differential equations of a belief's mean and covariance, or of its lower triangular root (2012 §2.2).

use super::columns::gather;
use super::image::{Image, Imaged};
use super::integrate::Carrier;
use super::packed::{pack, packed_len, unpack, unpack_symmetric};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::lanes::{lanes, spoil};
use crate::filter::memory::{put_identity, take};
use crate::kernels::{cholesky, dot, solve_lower, square};
use crate::model::At;
use crate::ode::{System, Tolerance};
use crate::scalar::{Mask, Real};

/// y = m, then the lower triangle of P or of S, then, if `carried`, the matrix X with X(0) = S₀ that the drift alone moves:
/// X' = Cov\[f, x\] P⁻¹ X (docs/algorithms.md C9, C10, C13).
#[derive(Clone, Copy)]
pub(super) struct Moments<I> {
    pub image: I,
    pub square_root: bool,
    pub carried: bool,
}

impl<I: Image> Moments<I> {
    /// Where P or S and X stand in y.
    #[inline(always)]
    pub fn parts<'y, T>(&self, y: &'y [T]) -> (&'y [T], &'y [T], &'y [T]) {
        let n = self.image.states();
        let (mean, rest) = y.split_at(n);
        let (lower, x) = rest.split_at(packed_len(n));
        (mean, lower, x)
    }
}

impl<I: Image> Carrier for Moments<I> {
    type Image = I;

    #[inline(always)]
    fn image(&self) -> I {
        self.image
    }

    #[inline(always)]
    fn alone(&self) -> Self {
        Self { carried: false, ..*self }
    }

    #[inline(always)]
    fn begin<T: Real>(&self, belief: &Belief<T>, y: &mut [T]) {
        let n = self.image.states();
        let (mean, rest) = y.split_at_mut(n);
        let (lower, x) = rest.split_at_mut(packed_len(n));
        mean.copy_from_slice(belief.mean);
        pack(n, if self.square_root { belief.factor } else { belief.cov }, lower);
        if self.carried {
            x.copy_from_slice(belief.factor);
        }
    }

    #[inline(always)]
    fn factor<T: Real>(&self, y: &[T], factor: &mut [T]) -> Result<(), Fault> {
        let n = self.image.states();
        unpack(n, self.parts(y).1, factor);
        if self.square_root {
            spoil(positive(n, factor)?, &mut factor[0]);
        } else {
            spoil(lanes(cholesky(factor, n), Matrix::Predicted)?, &mut factor[0]);
        }
        Ok(())
    }

    #[inline(always)]
    fn covariance<T: Real>(&self, y: &[T], factor: &[T], cov: &mut [T]) {
        let n = self.image.states();
        if self.square_root {
            square(cov, n, factor, n, n);
        } else {
            unpack_symmetric(n, self.parts(y).1, cov);
        }
    }

    #[inline(always)]
    fn carried<'y, T>(&self, y: &'y [T]) -> &'y [T] {
        self.parts(y).2
    }
}

/// Length of the solver's state.
pub(super) const fn moments_len(n: usize, carried: bool) -> usize {
    n + packed_len(n) + if carried { n * n } else { 0 }
}

/// Scalars of scratch of a derivative, for `columns` columns of N and an image that needs `image`.
pub(super) const fn moments_scratch(n: usize, columns: usize, image: usize) -> usize {
    5 * n * n + n * columns + n + image
}

impl<I: Image> System for Moments<I> {
    type Fault = Fault;

    fn len(&self) -> usize {
        moments_len(self.image.states(), self.carried)
    }

    fn scratch(&self) -> usize {
        let (plus, minus) = self.image.noises();
        moments_scratch(self.image.states(), plus + minus, self.image.scratch())
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
        let n = self.image.states();
        let (plus, minus) = self.image.noises();
        let columns = plus + minus;
        let (mean, lower, x) = self.parts(y);
        let (velocity, dy) = dy.split_at_mut(n);
        let (slope, dx) = dy.split_at_mut(packed_len(n));
        let s = take(&mut scratch, n * n);
        let p = take(&mut scratch, n * n);
        let dev = take(&mut scratch, n * n);
        let noise = take(&mut scratch, n * columns);
        let bend = take(&mut scratch, n * n);
        let solved = take(&mut scratch, n * n);
        let column = take(&mut scratch, n);
        // D = J if the rule is of first order and P is carried: nothing is then factorised
        let jacobian = self.image.first_order() && !self.square_root;
        let mut sick = T::Mask::splat(false);
        if self.square_root {
            unpack(n, lower, s);
            sick = positive(n, s)?;
        } else {
            unpack_symmetric(n, lower, p);
            if jacobian {
                s.fill(T::zero());
                put_identity(s, n, 0, n);
            } else {
                s.copy_from_slice(p);
                sick = lanes(cholesky(s, n), Matrix::Predicted)?;
            }
        }
        self.image.image(at, table, mean, s, &mut Imaged { velocity, dev, noise }, scratch)?;
        spoil(sick, &mut velocity[0]);
        if self.square_root {
            // S' = S Φ[Y + Yᵀ + H Hᵀ], Y = S⁻¹ D, H = S⁻¹ N
            bend.fill(T::zero());
            for j in 0..n {
                gather(dev, n, j, column);
                solve_lower(s, n, column);
                for (i, &y) in column.iter().enumerate() {
                    bend[i.max(j) * n + i.min(j)] += if i == j { y + y } else { y };
                }
            }
            for j in 0..columns {
                gather(noise, columns, j, column);
                solve_lower(s, n, column);
                add_square(bend, n, column, j < plus);
            }
            for i in 0..n {
                bend[i * n + i] *= T::of(0.5);
            }
            let mut out = slope.iter_mut();
            for i in 0..n {
                for (j, to) in (0..=i).zip(&mut out) {
                    *to = T::zero();
                    for k in j..=i {
                        *to = s[i * n + k].mul_add(bend[k * n + j], *to);
                    }
                }
            }
        } else {
            // P' = D Sᵀ + S Dᵀ + N J Nᵀ, or J P + P Jᵀ + N J Nᵀ
            let with = if jacobian { &*p } else { &*s };
            for i in 0..n {
                for j in 0..=i {
                    let mut sum = T::zero();
                    for k in 0..n {
                        let one = dev[i * n + k].mul_add(with[j * n + k], sum);
                        sum = with[i * n + k].mul_add(dev[j * n + k], one);
                    }
                    bend[i * n + j] = sum;
                }
            }
            for j in 0..columns {
                gather(noise, columns, j, column);
                add_square(bend, n, column, j < plus);
            }
            pack(n, bend, slope);
        }
        if self.carried {
            for j in 0..n {
                gather(x, n, j, column);
                if !jacobian {
                    solve_lower(s, n, column);
                }
                for (i, row) in solved.chunks_exact_mut(n).enumerate() {
                    row[j] = dot(&dev[i * n..(i + 1) * n], column);
                }
            }
            dx.copy_from_slice(solved);
        }
        Ok(())
    }

    /// In standard deviations: |Δm_i|, |ΔS_ij| and |ΔX_ij| against those of state i, |ΔP_ij| against both.
    fn error<T: Real>(&self, tolerance: Tolerance, before: &[T], after: &[T], error: &[T]) -> f64 {
        let n = self.image.states();
        let ((m0, l0, _), (m1, l1, _), (dm, dl, dx)) =
            (self.parts(before), self.parts(after), self.parts(error));
        let sigma = |i: usize| {
            let at = packed_len(i);
            let of = |l: &[T]| {
                let row = &l[at..=at + i];
                if self.square_root { dot(row, row).first() } else { row[i].first().abs() }
            };
            Real::sqrt(of(l0).max(of(l1)))
        };
        let mut worst = 0.0;
        let mut note = |error: T, allowed: f64| {
            let error = error.first().abs();
            let size = if error == 0.0 { 0.0 } else { error / allowed };
            // a NaN is worse than anything
            if size > worst || size.is_nan() {
                worst = size;
            }
        };
        for i in 0..n {
            let own = tolerance.of(sigma(i));
            let size = m0[i].first().abs().max(m1[i].first().abs());
            note(dm[i], own.max(4.0 * T::EPSILON * size));
            for j in 0..=i {
                let other = || 0.5 * (own * sigma(j) + tolerance.of(sigma(j)) * sigma(i));
                note(dl[packed_len(i) + j], if self.square_root { own } else { other() });
            }
            dx.iter().skip(i * n).take(n).for_each(|&error| note(error, own));
        }
        worst
    }
}

/// The lanes of a factor that cannot be divided by, if not all.
#[inline(always)]
pub(super) fn positive<T: Real>(n: usize, s: &[T]) -> Result<T::Mask, Fault> {
    let mut sick = T::Mask::splat(false);
    for pivot in 0..n {
        let x = s[pivot * n + pivot];
        if x.same(T::zero()).all() {
            return Err(Fault::SingularFactor { pivot });
        }
        let wrong = !T::zero().lt(x);
        if wrong.all() {
            return Err(Fault::NotPositive { matrix: Matrix::Predicted, pivot });
        }
        sick = sick | wrong;
    }
    Ok(sick)
}

/// A + v vᵀ (or A − v vᵀ) in the lower triangle.
#[inline(always)]
fn add_square<T: Real>(a: &mut [T], n: usize, v: &[T], plus: bool) {
    for i in 0..n {
        let x = if plus { v[i] } else { -v[i] };
        for (a, &y) in a[i * n..=i * n + i].iter_mut().zip(v) {
            *a = x.mul_add(y, *a);
        }
    }
}
