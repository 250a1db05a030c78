//! A sweep of Givens rotations: absorbs a linear map of a triangular factor into that factor.

use super::sweep_in_lanes::sweep_in_lanes;
use super::{Health, dot, outlined};
use crate::scalar::{Mask, Real};

outlined! {
    /// Triangularises [L D; 0 S] in place, L d × d and S n × n lower triangular, D d × n.
    ///
    /// The matrix `a`, in rows of length d + n, becomes [T11 0; T21 T22], lower triangular, with diagonal ≥ 0 if those of L
    /// and S are. Any number of S may stand below one another: the rotations do not depend on them, and S = I becomes the
    /// rotation itself. Every row of D is rotated into its pivot from the last column to the first, which leaves S
    /// triangular throughout; all cosines of a row come from one running sum of squares. It is the measurement update
    /// (2010 eq 36). A row that the earlier ones leave at most (d + n) ε of is zero; its pivot and column are then zero, as
    /// in [`tria`](super::tria()). `scratch` holds [`sweep_scratch`](super::sweep_scratch) scalars.
    pub fn sweep(a: &mut [T], d: usize, n: usize, scratch: &mut [T]) -> Health<T> = swept
}

#[inline(always)]
fn swept<T: Real>(a: &mut [T], d: usize, n: usize, scratch: &mut [T]) -> Health<T> {
    let size = d + n;
    let rows = a.len() / size.max(1);
    debug_assert!((rows - d).is_multiple_of(n.max(1)) && scratch.len() >= n);
    let absorbed = sweep_in_lanes(a, d, n, scratch);
    let norms = &mut scratch[..n];
    let mut health = Health::good();
    let bound = T::of(size as f64 * T::EPSILON);
    for q in absorbed..d {
        let row = &a[q * size..(q + 1) * size];
        let pivot = row[q];
        let settled = dot(&row[..q], &row[..q]);
        let mut sum = pivot * pivot;
        for (norm, &z) in norms.iter_mut().zip(&row[d..]).rev() {
            sum = z.mul_add(z, sum);
            *norm = sum;
        }
        // what overflows is not nothing
        let nothing = sum.le(bound * bound * (settled + sum)) & sum.finite();
        if nothing.all() {
            drop_row(a, d, n, q);
            continue;
        }
        health.note(nothing | (!sum.finite() & sum.same(sum)), q);
        let mut before = pivot;
        for j in (0..n).rev() {
            let after = norms[j].sqrt();
            let z = a[q * size + d + j];
            let still = z.same(T::zero());
            let (c, s) = (before / after, z / after);
            let (c, s) = (T::select(still, T::one(), c), T::select(still, T::zero(), s));
            before = T::select(still, before, after);
            // the rows of D still to come, and the rows of each S that column j reaches
            for i in q + 1..d {
                turn(&mut a[i * size..(i + 1) * size], q, d + j, c, s);
            }
            for top in (d..rows).step_by(n) {
                for i in top + j..top + n {
                    turn(&mut a[i * size..(i + 1) * size], q, d + j, c, s);
                }
            }
            a[q * size + d + j] = T::zero();
        }
        a[q * size + q] = before;
    }
    health
}

/// Turns columns `q` and `column` of a row by the angle of cosine c and sine s.
#[inline(always)]
fn turn<T: Real>(row: &mut [T], q: usize, column: usize, c: T, s: T) {
    let (x, y) = (row[column], row[q]);
    row[column] = c * x - s * y;
    row[q] = s.mul_add(x, c * y);
}

/// Row q has no pivot: zeroes what is left of it, and turns its column of L into those of the rows below.
#[inline(never)]
fn drop_row<T: Real>(a: &mut [T], d: usize, n: usize, q: usize) {
    let size = d + n;
    a[q * size + q] = T::zero();
    a[q * size + d..(q + 1) * size].fill(T::zero());
    for p in q + 1..d {
        let (x, y) = (a[p * size + p], a[p * size + q]);
        if y.same(T::zero()).all() {
            continue;
        }
        let norm = x.hypot(y);
        let (c, s) = (x / norm, y / norm);
        for i in p..d {
            let (x, y) = (a[i * size + p], a[i * size + q]);
            a[i * size + p] = c * x + s * y;
            a[i * size + q] = c * y - s * x;
        }
    }
}
