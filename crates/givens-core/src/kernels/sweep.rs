//! A sweep of Givens rotations: absorbs a linear map of a triangular factor into that factor.

use super::faint::{length, rotation};
use super::sweep_in_lanes::sweep_in_lanes;
use super::{Health, dot, outlined, sized};
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
    debug_assert!(scratch.len() >= 2 * n && a.len() >= d * (d + n));
    let absorbed = sweep_in_lanes(a, d, n, scratch);
    let mut health = Health::good();
    sized!(n => for q in absorbed..d {
        absorb(a, d, n, q, scratch, &mut health);
    });
    health
}

/// Rotates row q of D into its pivot.
#[inline(always)]
fn absorb<T: Real>(a: &mut [T], d: usize, n: usize, q: usize, scratch: &mut [T], health: &mut Health<T>) {
    let size = d + n;
    let (c, s) = scratch.split_at_mut(n);
    let (c, s) = (&mut c[..n], &mut s[..n]);
    let (head, below) = a.split_at_mut((q + 1) * size);
    let (settled, z) = head[q * size..].split_at_mut(d);
    let z = &mut z[..n];
    let bound = T::of(size as f64 * T::EPSILON);
    let turned = if settled[q].abs().lt(T::of(T::FAINT)).any() {
        one_by_one(&mut settled[..=q], z, c, s, bound)
    } else {
        at_once(&mut settled[..=q], z, c, s, bound)
    };
    if turned.nothing.all() {
        drop_row(a, d, n, q);
        return;
    }
    health.note(turned.nothing | turned.endless, q);
    // the rows of D still to come, and of the rows of each S the triangle
    let mut top = 0;
    while top < (d - q - 1) * size {
        turn(&mut below[top..][..size], q, d, n, c, s);
        top += size;
    }
    while top < below.len() {
        for i in 0..n {
            turn(&mut below[top + i * size..][..size], q, d, i + 1, c, s);
        }
        top += n.max(1) * size;
    }
}

/// The lanes in which a row has nothing left, and those in which its squares overflow.
struct Turned<T: Real> {
    nothing: T::Mask,
    endless: T::Mask,
}

/// Turns what is left of a row, (pivot, z), into the pivot, the last element of `row`: cosines and sines.
#[inline(always)]
fn at_once<T: Real>(row: &mut [T], z: &mut [T], c: &mut [T], s: &mut [T], bound: T) -> Turned<T> {
    let (n, q) = (z.len(), row.len() - 1);
    let (pivot, turned) = (row[q], sums(row, z, c, bound));
    // the norms of what a column and those after it hold, then their ratios: no root and no quotient waits for another
    let mut before = pivot;
    for j in (0..n).rev() {
        before = T::select(z[j].same(T::zero()), before, c[j].sqrt());
        c[j] = before;
    }
    for j in 0..n {
        let (still, norm) = (z[j].same(T::zero()), c[j]);
        let before = if j + 1 < n { c[j + 1] } else { pivot };
        c[j] = T::select(still, T::one(), before / norm);
        s[j] = T::select(still, T::zero(), z[j] / norm);
        z[j] = T::zero();
    }
    row[q] = before;
    turned
}

/// In `c` the squares of what a column and those after it hold.
#[inline(always)]
fn sums<T: Real>(row: &[T], z: &[T], c: &mut [T], bound: T) -> Turned<T> {
    let q = row.len() - 1;
    let settled = dot(&row[..q], &row[..q]);
    let mut sum = row[q] * row[q];
    for j in (0..z.len()).rev() {
        sum = z[j].mul_add(z[j], sum);
        c[j] = sum;
    }
    let whole = settled + sum;
    // what overflows is not nothing
    let nothing = sum.le(bound * bound * whole) & whole.finite();
    Turned { nothing, endless: !whole.finite() & whole.same(whole) }
}

/// The same from a pivot that is faint in some lanes, where squares may have lost digits: a rotation after the other.
#[cold]
#[inline(never)]
fn one_by_one<T: Real>(row: &mut [T], z: &mut [T], c: &mut [T], s: &mut [T], bound: T) -> Turned<T> {
    let q = row.len() - 1;
    let faint = row[q].abs().lt(T::of(T::FAINT));
    let (usual, whole) = (sums(row, z, c, bound), length(z, row[q]));
    let nothing = whole.le(bound * length(&row[..q], T::zero()));
    let mut before = row[q];
    for j in (0..z.len()).rev() {
        let still = z[j].same(T::zero());
        let (cosine, sine, length) = rotation(before, z[j]);
        let norm = T::select(still, before, c[j].sqrt());
        c[j] = T::select(faint, cosine, T::select(still, T::one(), before / norm));
        s[j] = T::select(faint, sine, T::select(still, T::zero(), z[j] / norm));
        before = T::select(faint, length, norm);
        z[j] = T::zero();
    }
    row[q] = before;
    Turned { nothing: (faint & nothing) | (!faint & usual.nothing), ..usual }
}

/// Turns column q of a row into its columns `first`… by the angles of cosines c and sines s, from the last of `reach` on.
#[inline(always)]
fn turn<T: Real>(row: &mut [T], q: usize, first: usize, reach: usize, c: &[T], s: &[T]) {
    let mut y = row[q];
    let x = &mut row[first..][..reach];
    for j in (0..reach).rev() {
        let own = x[j];
        x[j] = c[j] * own - s[j] * y;
        y = s[j].mul_add(own, c[j] * y);
    }
    row[q] = y;
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
        let (c, s, _) = rotation(x, y);
        for i in p..d {
            let (x, y) = (a[i * size + p], a[i * size + q]);
            a[i * size + p] = c * x + s * y;
            a[i * size + q] = c * y - s * x;
        }
        // of its own element a rounding may be left
        a[p * size + q] = T::zero();
    }
}
