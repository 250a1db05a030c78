//! The sweep is Tria of the block that it is given, without its zeros.

use super::matrix::{Matrix, apart, factor, is_factor};
use core::ops::RangeInclusive;
use givens_core::kernels::{sweep, sweep_scratch, tria};
use givens_core::scalar::Real;
use proptest::prelude::*;

/// [L D; 0 S].
fn block(l: &Matrix, between: &Matrix, s: &Matrix) -> Matrix {
    let d = l.rows;
    Matrix::new(d + s.rows, d + s.rows, |i, j| match (i < d, j < d) {
        (true, true) => l.at(i, j),
        (true, false) => between.at(i, j - d),
        (false, true) => 0.0,
        (false, false) => s.at(i - d, j - d),
    })
}

fn swept<T: Real>(a: &Matrix, d: usize) -> Matrix {
    let size = a.columns;
    let mut memory = a.memory::<T>(size, 0.0);
    let mut scratch = vec![T::of(f64::NAN); sweep_scratch(d, size - d)];
    assert!(sweep(&mut memory, d, size - d, &mut scratch).failed().is_none());
    Matrix::of(a.rows, size, &memory, size)
}

fn triangular<T: Real>(a: &Matrix) -> Matrix {
    let size = a.rows;
    let mut memory = a.memory::<T>(size, 0.0);
    assert!(tria(&mut memory, size, size, size).failed().is_none());
    Matrix::of(size, size, &memory, size)
}

fn agree<T: Real>(a: &Matrix, d: usize) -> Result<(), TestCaseError> {
    let (t, reference) = (swept::<T>(a, d), triangular::<T>(a));
    prop_assert!(is_factor(&t), "{t:?}");
    let allowed = 8.0 * (a.rows * a.rows) as f64 * T::EPSILON;
    let stated = Matrix::of(a.rows, a.rows, &a.memory::<T>(a.rows, 0.0), a.rows);
    let error = apart(&t.outer(), &stated.outer(), |i| a.norm(i));
    prop_assert!(error <= allowed, "{error:e}");
    let error = apart(&t.outer(), &reference.outer(), |i| a.norm(i));
    prop_assert!(error <= 2.0 * allowed, "{error:e}");
    Ok(())
}

/// L and S of a measurement of `d` components and `n` states, and what is between them.
fn parts(
    d: RangeInclusive<usize>,
    n: RangeInclusive<usize>,
) -> impl Strategy<Value = (Matrix, Matrix, Matrix)> {
    (d, n).prop_flat_map(|(d, n)| {
        let between = prop::collection::vec(-2.0..2.0, d * n);
        let between = between.prop_map(move |of| Matrix::new(d, n, |i, j| of[i * n + j]));
        (factor(d), between, factor(n))
    })
}

/// What stands below [L D; 0 S] is turned as that is, which does not notice.
fn turned_alike(l: &Matrix, between: &Matrix, s: &Matrix) -> Result<(), TestCaseError> {
    let (d, n) = (l.rows, s.rows);
    let a = block(l, between, s);
    let alone = swept::<f64>(&a, d);
    let stacked = Matrix::new(d + 2 * n, d + n, |i, j| match i.checked_sub(d + n) {
        None => a.at(i, j),
        Some(i) => f64::from(j == d + i),
    });
    let both = swept::<f64>(&stacked, d);
    for (i, j) in (0..d + n).flat_map(|i| (0..d + n).map(move |j| (i, j))) {
        prop_assert_eq!(both.at(i, j), alone.at(i, j));
    }
    // [T21 T22] = S [A B], what stands below with I in place of S
    for (i, j) in (0..n).flat_map(|i| (0..d + n).map(move |j| (i, j))) {
        let product: f64 = (0..n).map(|k| s.at(i, k) * both.at(d + n + k, j)).sum();
        prop_assert!((both.at(d + i, j) - product).abs() < 1e-13 * s.norm(i).max(1e-300));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn it_is_tria_of_the_assembled_block((l, between, s) in parts(1..=6, 1..=6), noiseless: bool) {
        let d = l.rows;
        // without noise L is zero, and D alone has to fill the pivots
        let l = if noiseless { Matrix::new(d, d, |_, _| 0.0) } else { l };
        let a = block(&l, &between, &s);
        agree::<f64>(&a, d)?;
        agree::<f32>(&a, d)?;
    }

    #[test]
    fn what_stands_below_is_turned_alike((l, between, s) in parts(1..=6, 1..=6)) {
        turned_alike(&l, &between, &s)?;
    }
}

// sizes at which rows go side by side
proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn large_ones_are_tria_too((l, between, s) in parts(1..=20, 8..=40)) {
        agree::<f64>(&block(&l, &between, &s), l.rows)?;
        turned_alike(&l, &between, &s)?;
    }

    /// A measure without noise, one that has no spread either, and one that repeats the first.
    #[test]
    fn a_large_one_may_lack_any_row((l, between, s) in parts(2..=20, 8..=30), row in 0usize..20, kind in 0..3) {
        let d = l.rows;
        let row = if kind == 2 { 1 + row % (d - 1) } else { row % d };
        let of = |from: &Matrix, keep: bool| {
            let at = |i: usize, j| if i != row { from.at(i, j) } else if keep { from.at(0, j) } else { 0.0 };
            Matrix::new(d, from.columns, at)
        };
        let (noise, spread) = match kind {
            0 => (of(&l, false), between),
            1 => (of(&l, false), of(&between, false)),
            _ => (of(&l, true), of(&between, true)),
        };
        let a = block(&noise, &spread, &s);
        agree::<f64>(&a, d)?;
        if kind == 1 {
            let t = swept::<f64>(&a, d);
            prop_assert!((0..a.rows).all(|i| t.at(i, row) == 0.0), "{}: {:?}", row, t);
        }
    }
}

#[test]
fn one_measure_of_many_states_is_absorbed() {
    for n in [11, 12, 20, 33] {
        let between = Matrix::new(1, n, |_, j| 1.0 + Real::sin(j as f64));
        let s = Matrix::new(n, n, |i, j| {
            f64::from(i == j) + if j < i { Real::sin((3 * i + j) as f64) } else { 0.0 }
        });
        let a = block(&Matrix::new(1, 1, |_, _| 0.5), &between, &s);
        agree::<f64>(&a, 1).unwrap();
    }
}

/// Measures that are nearly without noise: a product of some of their cosines is no number any more.
#[test]
fn pivots_may_be_far_below_their_rows() {
    for (noise, d, n) in [(1e-45, 6, 20), (1e-60, 6, 20), (1e-98, 9, 13)] {
        let of = |i: usize, j: usize| Real::sin((7 * i + 3 * j + i * j) as f64);
        let l = Matrix::new(d, d, |i, j| if j < i { of(j, i) } else { noise * f64::from(i == j) });
        let s = Matrix::new(n, n, |i, j| f64::from(i == j) + if j < i { of(i, j) } else { 0.0 });
        agree::<f64>(&block(&l, &Matrix::new(d, n, of), &s), d).unwrap();
    }
}

#[test]
fn what_is_not_a_number_stays_none() {
    for (d, n, bad) in [(2, 3, 1), (9, 20, 0), (9, 20, 8), (20, 33, 12)] {
        let size = d + n;
        let mut a = Matrix::new(size, size, |i, j| {
            f64::from(j <= i && (i < d) == (j < d)) + f64::from(j >= d && i < d)
        });
        a.data[bad * size + d + 1] = f64::NAN;
        let t = swept::<f64>(&a, d);
        assert!(t.at(bad, bad).is_nan(), "{d} {n}");
        assert!((0..bad).all(|i| t.row(i).iter().all(|x| x.is_finite())));
    }
}

#[test]
fn a_row_whose_squares_overflow_is_told_and_is_not_zero() {
    for (d, n) in [(1, 2), (3, 7), (6, 20)] {
        let size = d + n;
        let mut a = vec![0.0; size * size];
        for i in 0..size {
            for j in 0..=i {
                a[i * size + j] = if i == j { 1.0 } else { Real::sin((3 * i + j) as f64) };
            }
        }
        for q in 0..d {
            a[q * size + d..][..n].fill(0.5);
        }
        a[d * size - 1] = 1e160;
        let mut scratch = vec![0.0; sweep_scratch(d, n)];
        assert_eq!(sweep(&mut a, d, n, &mut scratch).failed(), Some(d - 1), "{d}, {n}");
    }
}
