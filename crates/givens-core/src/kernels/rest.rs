//! How large rounding errors have become in a pivot.

use super::dot;
use super::solve::inverse_or_zero;
use crate::scalar::Real;

/// What is left of row k after the rows above it is row k less multiples of those rows, and so are its errors. Given
/// `error(a, row a)` of the rows above, this is Σ |multiple_a| error_a, to which the caller adds that of row k.
///
/// `l` is lower triangular down to row k, in rows of length `stride`; its column k above the diagonal must be zero, and
/// holds the multiples for a while. The sum is far above the error of any one row where the multiples are large.
#[inline(always)]
pub(super) fn errors_above<T: Real>(
    l: &mut [T],
    stride: usize,
    k: usize,
    error: impl Fn(usize, &[T]) -> T,
) -> T {
    let mut sum = T::zero();
    for a in (0..k).rev() {
        let mut rest = l[k * stride + a];
        for i in a + 1..k {
            rest = (-l[i * stride + k]).mul_add(l[i * stride + a], rest);
        }
        let row = &l[a * stride..=a * stride + a];
        let multiple = rest * inverse_or_zero(row[a]);
        sum = multiple.abs().mul_add(error(a, row), sum);
        l[a * stride + k] = multiple;
    }
    for a in 0..k {
        l[a * stride + k] = T::zero();
    }
    sum
}

/// The Euclidean norm of a row.
#[inline(always)]
pub(super) fn norm<T: Real>(row: &[T]) -> T {
    dot(row, row).sqrt()
}

#[cfg(test)]
mod tests {
    #[test]
    fn errors_of_the_rows_above_come_in_as_often_as_these_are_taken_away() {
        // the last row is 2, −3 and 5 times those above it
        let mut l = [4.0, 0.0, 0.0, 0.0, -1.0, 2.0, 0.0, 0.0, 6.0, -7.0, 3.0, 0.0, 41.0, -41.0, 15.0, 9.0];
        let stated = l;
        let sum = super::errors_above(&mut l, 4, 3, |a, row| {
            assert_eq!(row, &stated[4 * a..=5 * a]);
            [1.0, 10.0, 100.0][a]
        });
        assert_eq!(sum, 532.0);
        assert_eq!(l, stated);
    }
}
