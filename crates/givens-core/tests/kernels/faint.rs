//! Units do not matter: of rows in powers of two, down to where squares have no digits, the factor is that of the rows
//! without them, in these units.

use super::matrix::Matrix;
use givens_core::kernels::{sweep, sweep_scratch, tria};
use givens_core::scalar::Real;

/// Numbers between −1 and 1.
fn entry(i: usize, j: usize) -> f64 {
    Real::sin(1.0 + 1.7 * i as f64 + 0.6 * (j * j) as f64)
}

/// Each element of `s` is that of `plain`, in the unit of its row and to the rounding of the largest of the row.
fn same<T: Real>(s: &[T], plain: &[T], stride: usize, unit: impl Fn(usize) -> f64) {
    for (i, (row, plain)) in s.chunks(stride).zip(plain.chunks(stride)).enumerate() {
        for (j, (x, y)) in row.iter().zip(plain).enumerate() {
            let error = (x.first() / unit(i) - y.first()).abs();
            assert!(error < 300.0 * T::EPSILON, "{i}, {j} of {}: {x:?}, {y:?}", plain.len());
        }
    }
}

/// Rows `low` and, if any, `lower` are in units of 2 to these powers.
fn of_rows<T: Real>(powers: [i32; 2]) {
    for (n, columns) in [(2_usize, 4_usize), (7, 22), (13, 40), (30, 90)] {
        for (low, lower) in [(0, 1), (0, n - 1), (n / 2, n - 1), (n - 2, n - 1), (n - 1, n)] {
            for stride in [columns + 1, columns.next_multiple_of(8)] {
                let unit = |i: usize| {
                    let power = if i == low { powers[0] } else { powers[1] };
                    if i == low || i == lower { 2_f64.powi(power) } else { 1.0 }
                };
                let plain = Matrix::new(n, columns, entry);
                let scaled = Matrix::new(n, columns, |i, j| unit(i) * entry(i, j));
                let [mut plain, mut s] = [plain, scaled].map(|a| a.memory::<T>(stride, 0.0));
                assert!(tria(&mut plain, n, columns, stride).failed().is_none());
                assert!(tria(&mut s, n, columns, stride).failed().is_none());
                same(&s, &plain, stride, unit);
            }
        }
    }
}

#[test]
fn rows_of_a_triangularisation() {
    for powers in [[-255, -265], [-265, -255], [-300, -600], [-510, -540], [-600, -300], [-900, -900]] {
        of_rows::<f64>(powers);
    }
    for powers in [[-34, -38], [-38, -34], [-45, -60], [-60, -66], [-70, -40], [-90, -90]] {
        of_rows::<f32>(powers);
    }
}

/// Row `low` of [L D] in the unit of a power of two.
fn of_measurements<T: Real>(power: i32) {
    for (d, n) in [(1, 2), (3, 7), (6, 20), (20, 9)] {
        for low in [0, d / 2, d - 1] {
            let unit = |i: usize| if i == low { 2_f64.powi(power) } else { 1.0 };
            let of = |i: usize, j: usize| match (i < d, j < d) {
                (true, false) => entry(i, j),
                (false, true) => 0.0,
                _ if j < i => entry(i, j),
                _ => f64::from(i == j),
            };
            let plain = Matrix::new(d + n, d + n, of);
            let scaled = Matrix::new(d + n, d + n, |i, j| unit(i) * of(i, j));
            let mut scratch = vec![T::zero(); sweep_scratch(d, n)];
            let [mut plain, mut s] = [plain, scaled].map(|a| a.memory::<T>(d + n, 0.0));
            assert!(sweep(&mut plain, d, n, &mut scratch).failed().is_none());
            assert!(sweep(&mut s, d, n, &mut scratch).failed().is_none());
            same(&s, &plain, d + n, unit);
        }
    }
}

#[test]
fn rows_of_a_sweep() {
    for power in [-255, -265, -400, -510, -530, -600, -900] {
        of_measurements::<f64>(power);
    }
    for power in [-34, -38, -50, -62, -66, -90] {
        of_measurements::<f32>(power);
    }
}

/// Row `lost` repeats one above it: it has nothing left, and powers of two in all rows change no digit.
fn of_repeated_rows<T: Real>(powers: [i32; 2]) {
    let repeats = |lost: usize, i: usize| if i == lost { lost - 1 } else { i };
    for (n, columns) in [(2_usize, 4_usize), (7, 22), (13, 40), (30, 90), (40, 170)] {
        for lost in [1, n / 2, n - 1] {
            for stride in [columns + 1, columns.next_multiple_of(8)] {
                let triangular = |unit: f64| {
                    let a = Matrix::new(n, columns, |i, j| unit * entry(repeats(lost, i), j));
                    let mut a = a.memory::<T>(stride, 0.0);
                    assert!(tria(&mut a, n, columns, stride).failed().is_none());
                    Matrix::of(n, n, &a, stride)
                };
                let plain = triangular(1.0);
                assert_eq!(plain.at(lost, lost), 0.0, "{n} × {columns}: {lost}");
                for unit in powers.map(|power| 2_f64.powi(power)) {
                    let expected = Matrix::new(n, n, |i, j| unit * plain.at(i, j));
                    assert_eq!(triangular(unit).data, expected.data, "{n} × {columns}: {lost} in {unit}");
                }
            }
        }
    }
    for (d, n) in [(2, 3), (3, 7), (6, 20), (20, 9), (20, 30)] {
        for (lost, own) in [(1, 0.0), (d / 2, 1e-17), (d - 1, 1e-17)] {
            let size = d + n;
            let swept = |unit: f64| {
                let a = Matrix::new(size, size, |i, j| match (i < d, j < d) {
                    (true, false) => unit * entry(repeats(lost, i), j),
                    (false, true) => 0.0,
                    // a measure that repeats another has noise of its own that is rounding
                    (true, true) if i == lost && j == i => unit * own,
                    (true, true) if j <= repeats(lost, i) => unit * entry(repeats(lost, i), j).abs(),
                    _ => f64::from(i == j && i >= d),
                });
                let mut a = a.memory::<T>(size, 0.0);
                let mut scratch = vec![T::zero(); sweep_scratch(d, n)];
                assert!(sweep(&mut a, d, n, &mut scratch).failed().is_none());
                Matrix::of(size, size, &a, size)
            };
            let plain = swept(1.0);
            assert_eq!(plain.at(lost, lost), 0.0, "{d}, {n}: {lost}");
            for unit in powers.map(|power| 2_f64.powi(power)) {
                let expected =
                    Matrix::new(size, size, |i, j| if i < d { unit } else { 1.0 } * plain.at(i, j));
                assert_eq!(swept(unit).data, expected.data, "{d}, {n}: {lost} in {unit}");
            }
        }
    }
}

#[test]
fn a_row_that_repeats_another_has_nothing_left_in_any_units() {
    of_repeated_rows::<f64>([-60, 60]);
    of_repeated_rows::<f32>([-14, 14]);
}

/// A sweep of (pivot | z) over the unit matrix is a rotation, whose rows keep their lengths, and the row's own goes to the
/// pivot.
fn is_a_rotation<T: Real>(row: [f64; 4]) {
    let mut a = [T::zero(); 16];
    for (to, of) in a.iter_mut().zip(row) {
        *to = T::of(of);
    }
    for i in 1..4 {
        a[5 * i] = T::one();
    }
    let stated = a;
    assert!(sweep(&mut a, 1, 3, &mut [T::zero(); 6]).failed().is_none());
    let unit = stated[..4].iter().fold(0.0_f64, |most, x| most.max(x.first().abs()));
    for (i, (row, before)) in a.chunks(4).zip(stated.chunks(4)).enumerate() {
        let unit = if i == 0 { unit } else { 1.0 };
        let length = |row: &[T]| row.iter().map(|x| (x.first() / unit).powi(2)).sum::<f64>().sqrt();
        assert!((length(row) / length(before) - 1.0).abs() < 9.0 * T::EPSILON, "{stated:?}: {a:?}");
    }
}

#[test]
fn what_is_faint_may_stand_before_what_is_not() {
    for pivot in [0.0, 1e-38, 1e-20, 1e-12, 1e-3, -1e-20] {
        for last in [0.0, 1e-25, 3e-20, 1e-11, -1e-25] {
            for first in [1.0, 1e-19, 1e-30, 0.0] {
                if pivot != 0.0 || last != 0.0 || first != 0.0 {
                    is_a_rotation::<f32>([pivot, first, 0.3 * first, last]);
                }
            }
        }
    }
    is_a_rotation::<f64>([0.0, 1.0, 1e-170, 2e-170]);
    is_a_rotation::<f64>([5e-324, 1.0, 5e-324, 1e-323]);
    is_a_rotation::<f32>([1.5e-45, 1.0, 1.5e-45, 3e-45]);
    is_a_rotation::<f32>([1e18, 1e-40, 1e-41, 1e-42]);
    is_a_rotation::<f32>([1e-20, 1e18, 1e18, 1e-20]);
}
