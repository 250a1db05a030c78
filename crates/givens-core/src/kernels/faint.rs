//! Numbers so small that their squares have lost digits: what kernels do with them instead of squaring.

use crate::scalar::{Mask, Real};

/// Cosine and sine of the rotation that turns (x, y) into (length, 0), and the length, which has the sign of x if y is zero.
#[inline(always)]
pub(super) fn rotation<T: Real>(x: T, y: T) -> (T, T, T) {
    let still = y.same(T::zero());
    // a length of few digits is no divisor
    let small = x.abs().lt(T::of(T::FAINT)) & y.abs().lt(T::of(T::FAINT));
    let up = T::select(small, T::of(1.0 / T::FAINT), T::one());
    let (a, b) = (x * up, y * up);
    let length = a.hypot(b);
    let down = T::select(small, T::of(T::FAINT), T::one());
    (
        T::select(still, T::one(), a / length),
        T::select(still, T::zero(), b / length),
        T::select(still, x, length * down),
    )
}

/// ‖(start, row)‖ without squares that are too small.
#[inline(always)]
pub(super) fn length<T: Real>(row: &[T], start: T) -> T {
    let mut length = start.abs();
    for &x in row {
        length = length.hypot(x);
    }
    length
}

/// Makes what is left of a row, from column `used` to `end`, a unit vector in the lanes of `faint`, where all of it is
/// below [`FAINT`](Real::FAINT); there the answer is whether it is at most `bound` of the row, and its length.
#[cold]
#[inline(never)]
pub(super) fn unit_row<T: Real>(
    row: &mut [T],
    used: usize,
    end: usize,
    bound: T,
    faint: T::Mask,
) -> (T::Mask, T) {
    let mut largest = T::zero();
    for &x in &row[used..end] {
        largest = largest.max(x.abs());
    }
    if largest.same(T::zero()).all() {
        return (T::Mask::splat(true), largest);
    }
    let settled = length(&row[..used], T::zero());
    // a length of few digits is no divisor
    let (up, down) = (T::of(1.0 / T::FAINT), T::of(T::FAINT));
    for x in &mut row[used..end] {
        *x = T::select(faint, up * *x, *x);
    }
    let rest = length(&row[used..end], T::zero());
    for x in &mut row[used..end] {
        *x = T::select(faint, *x / rest, *x);
    }
    (rest.le(bound * up * settled), rest * down)
}
