//! What a pivot of a downdate is taken for beside the rounding that may be in it (docs/algorithms.md K5), on both sides of
//! each bound, in any units of the rows.

use givens_core::kernels::downdate;
use givens_core::scalar::Real;

/// Units of the rows, powers of two, which change no digit.
fn units<const N: usize>(powers: &[i32]) -> impl Iterator<Item = [f64; N]> {
    let count = powers.len();
    (0..count.pow(N as u32))
        .map(move |k| core::array::from_fn(|i| 2_f64.powi(powers[k / count.pow(i as u32) % count])))
}

/// The downdate of `l` by `v`, whose rows are in these units and stand two numbers apart.
fn judge<T: Real, const N: usize>(
    l: [[f64; N]; N],
    v: [f64; N],
    units: [f64; N],
) -> Result<[[f64; N]; N], usize> {
    let stride = N + 2;
    let mut a = vec![T::zero(); N * stride];
    for i in 0..N {
        for j in 0..N {
            a[i * stride + j] = T::of(units[i] * l[i][j]);
        }
    }
    let mut v: Vec<T> = (0..N).map(|i| T::of(units[i] * v[i])).collect();
    let failed = downdate(&mut a, N, stride, &mut v).failed();
    let of = |i: usize, j: usize| a[i * stride + j].first() / units[i];
    failed.map_or(Ok(core::array::from_fn(|i| core::array::from_fn(|j| of(i, j)))), Err)
}

/// The square of the last pivot is known to `tau`: zero to half of that, and from twice of it on what it is.
fn is_known_to<T: Real, const N: usize>(l: [[f64; N]; N], tau: f64, powers: &[i32]) {
    let last = l[N - 1][N - 1];
    for units in units::<N>(powers) {
        let of = |left: f64| {
            let mut v = [0.0; N];
            v[N - 1] = (last * last - left).sqrt();
            judge::<T, N>(l, v, units).map(|l| l[N - 1][N - 1])
        };
        for left in [-0.5, 0.5] {
            assert_eq!(of(left * tau), Ok(0.0), "{left} in {units:?}");
        }
        assert_eq!(of(-2.0 * tau), Err(N - 1), "{units:?}");
        let left = of(2.0 * tau).unwrap();
        assert!((left * left / tau - 2.0).abs() < 0.1, "{left} in {units:?}");
    }
}

#[test]
fn a_square_is_zero_within_the_rounding_that_is_in_it() {
    for powers in [[-30, 0, 30], [-60, 0, 60]] {
        is_known_to::<f64, 1>([[2.0]], 64.0 * f64::EPSILON * 2.0 * 2.0, &powers);
        // the norm of the row is 5, and it goes with three times that above
        let tau = |epsilon: f64| 64.0 * epsilon * (5.0 + 3.0) * 4.0;
        is_known_to::<f64, 2>([[1.0, 0.0], [3.0, 4.0]], tau(f64::EPSILON), &powers);
        // with 8 times that of norm √577, and −192 times the first
        let tau = |epsilon: f64| 64.0 * epsilon * (10.0 + 8.0 * 577_f64.sqrt() + 192.0) * 6.0;
        let l = [[1.0, 0.0, 0.0], [24.0, 1.0, 0.0], [0.0, 8.0, 6.0]];
        is_known_to::<f64, 3>(l, tau(f64::EPSILON), &powers);
    }
    let powers = [-30, 0, 30];
    is_known_to::<f32, 1>([[2.0]], 64.0 * f64::from(f32::EPSILON) * 2.0 * 2.0, &powers);
}

/// A column that is taken whole but for `x` in the last row, whose largest number is 3.
fn column<T: Real>(x: f64, units: [f64; 4]) -> Option<usize> {
    let l = [[1.0, 0.0, 0.0, 0.0], [0.5, 1.0, 0.0, 0.0], [2.0, -1.0, 1.5, 0.0], [1.0, -0.25, 0.75, 3.0]];
    let mut v = l.map(|row| row[0]);
    v[3] += x;
    judge::<T, 4>(l, v, units).map_or_else(Some, |found| {
        for (found, mut row) in found.into_iter().zip(l) {
            row[0] = 0.0;
            assert_eq!(found, row);
        }
        None
    })
}

fn columns<T: Real>() {
    for units in units::<4>(&[-30, 0, 30]) {
        // e of row 0 is 64 ε of its pivot
        let bound = 2.0 * (64.0 * T::EPSILON).sqrt() * 3.0;
        for sign in [-1.0, 1.0] {
            assert_eq!(column::<T>(0.5 * sign * bound, units), None, "{units:?}");
            assert_eq!(column::<T>(2.0 * sign * bound, units), Some(0), "{units:?}");
        }
    }
}

#[test]
fn what_stands_below_a_square_of_zero_goes_with_it_within_the_largest_of_its_row() {
    columns::<f64>();
    columns::<f32>();
}

/// Of a pivot in a row of norm 3, which is 3 times the one above: what stands below it and is not taken stays if the pivot
/// is noise, and is told if not.
fn noise<T: Real>() {
    for units in units::<3>(&[-30, 0, 30]) {
        let of = |pivot: f64| {
            let l = [[1.0, 0.0, 0.0], [3.0, pivot, 0.0], [0.0, 1.0, 1.0]];
            judge::<T, 3>(l, [0.0, pivot, 0.0], units)
        };
        let bound = (64.0 * T::EPSILON * (3.0 + 3.0) * 3.0).sqrt();
        let [_, middle, last] = of(0.5 * bound).unwrap();
        assert_eq!((middle[0], middle[1], last[0], last[1]), (3.0, 0.0, 0.0, 0.0), "{units:?}");
        assert!((last[2] / 2_f64.sqrt() - 1.0).abs() < 4.0 * T::EPSILON, "{units:?}");
        assert_eq!(of(2.0 * bound), Err(1), "{units:?}");
    }
}

#[test]
fn a_pivot_is_noise_within_the_root_of_the_rounding_of_its_row() {
    noise::<f64>();
    noise::<f32>();
}

/// Just above the rounding of the row, where the pivot and what is taken of it are not alike any more: all that stands below
/// goes with it, and the columns after it keep their digits.
#[test]
fn a_pivot_that_is_hardly_more_than_rounding_takes_its_column_with_it() {
    let rounding = 64.0 * f64::EPSILON * (3.0 + 3.0);
    for units in units::<3>(&[-30, 0, 30]) {
        for below in [0.3, -0.7, 1.9] {
            let l = [[1.0, 0.0, 0.0], [3.0, 0.5 * rounding, 0.0], [0.2, below, 1.3]];
            let found = judge::<f64, 3>(l, [0.0, 1.1 * rounding, below], units);
            assert_eq!(found, Ok([l[0], [3.0, 0.0, 0.0], [0.2, 0.0, 1.3]]), "{units:?}");
        }
    }
}
