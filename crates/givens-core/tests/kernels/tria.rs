//! Tria(A) is the lower-triangular root of A Aᵀ, in echelon form.

use super::matrix::{Matrix, any_matrix, apart, deficient, is_factor, turned};
use givens_core::kernels::tria;
use givens_core::scalar::Real;
use proptest::prelude::*;

/// Tria(A) and its error in units of ε ‖row i‖ ‖row j‖; what stands behind A must not matter.
fn triangular<T: Real>(a: &Matrix) -> (Matrix, f64) {
    triangular_in::<T>(a, a.rows.max(a.columns) + 1)
}

/// The same in rows of length `stride`: those that end in room for a whole pack have a kernel of their own.
fn triangular_in<T: Real>(a: &Matrix, stride: usize) -> (Matrix, f64) {
    let (n, k) = (a.rows, a.columns);
    let mut memory = a.memory::<T>(stride, f64::NAN);
    let stated = Matrix::of(n, k, &memory, stride);
    let health = tria(&mut memory, n, k, stride);
    assert!(health.failed().is_none());
    let s = Matrix::of(n, n, &memory, stride);
    let error = apart(&s.outer(), &stated.outer(), |i| stated.norm(i)) / T::EPSILON;
    (s, error)
}

fn is_root(a: &Matrix) -> Result<(), TestCaseError> {
    // every row has been through as many reflections as there are rows above it, each of them k products long
    let allowed = 8.0 * (a.rows * a.columns.max(1)) as f64;
    let whole = a.rows.max(a.columns).next_multiple_of(8);
    let ways = [triangular::<f64>(a), triangular::<f32>(a), triangular_in::<f64>(a, whole)];
    for (s, error) in ways {
        prop_assert!(is_factor(&s), "{s:?}");
        prop_assert!(error <= allowed, "{error}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn it_is_a_root_of_the_outer_product_row_by_row(a in any_matrix(1usize..=9, 0usize..=20)) {
        is_root(&a)?;
    }

    /// A row that repeats others leaves no more than the rounding of those, which may be larger than it is itself: of
    /// (3 0 3), (3 1 3) and their difference (0 1 0) a pivot of 4 ε remains.
    #[test]
    fn a_row_that_repeats_others_leaves_rounding_at_most((a, dependent) in (1usize..=6).prop_flat_map(turned)) {
        is_root(&a)?;
        let (s, _) = triangular::<f64>(&a);
        let first = dependent.iter().position(|&dependent| dependent).unwrap_or(a.rows);
        prop_assert!((0..first).all(|i| s.at(i, i) > 1e-6), "{:?}", s);
        if first < a.rows {
            let sizes: f64 = (0..=first).map(|i| a.norm(i)).sum();
            prop_assert!(s.at(first, first) <= 8.0 * a.columns as f64 * f64::EPSILON * sizes, "{:?}", s);
        }
    }

    #[test]
    fn it_is_in_echelon_form_of_few_columns((a, dependent) in (1usize..=8).prop_flat_map(deficient)) {
        let rank = dependent.iter().filter(|&&dependent| !dependent).count();
        let a = Matrix::new(a.rows, rank, |i, j| a.at(i, j));
        is_root(&a)?;
        let (s, _) = triangular::<f64>(&a);
        let found: Vec<bool> = (0..a.rows).map(|j| s.at(j, j) == 0.0).collect();
        prop_assert_eq!(found, dependent, "{:?}", s);
    }

    #[test]
    fn rows_of_whole_packs_have_the_same_root((a, _) in (1usize..=8).prop_flat_map(deficient)) {
        let (s, _) = triangular::<f64>(&a);
        let (packed, _) = triangular_in::<f64>(&a, a.rows.max(a.columns).next_multiple_of(4) + 4);
        for i in 0..a.rows {
            for j in 0..=i {
                prop_assert!((s.at(i, j) - packed.at(i, j)).abs() <= 1e-9 * a.norm(i), "{:?} {:?}", s, packed);
                prop_assert_eq!(s.at(j, j) == 0.0, packed.at(j, j) == 0.0);
            }
        }
    }

    #[test]
    fn it_is_in_echelon_form((a, dependent) in (1usize..=8).prop_flat_map(deficient)) {
        is_root(&a)?;
        let (s, _) = triangular::<f64>(&a);
        for (j, &dependent) in dependent.iter().enumerate() {
            prop_assert_eq!(s.at(j, j) == 0.0, dependent, "pivot {} of {:?}", j, s);
            if dependent {
                prop_assert!((j..s.rows).all(|i| s.at(i, j) == 0.0), "column {} of {:?}", j, s);
            }
        }
    }
}

#[test]
fn no_columns_leave_nothing() {
    let (s, _) = triangular::<f64>(&Matrix::new(3, 0, |_, _| 0.0));
    assert!(s.data.iter().all(|&x| x == 0.0));
}

#[test]
fn fewer_columns_than_rows_leave_pivots_of_zero() {
    let (s, error) = triangular::<f64>(&Matrix::new(3, 1, |i, _| [3.0, -6.0, 1.0][i]));
    for (found, expected) in s.data.iter().zip([3.0, 0.0, 0.0, -6.0, 0.0, 0.0, 1.0, 0.0, 0.0]) {
        assert!((found - expected).abs() <= 2.0 * f64::EPSILON * f64::abs(expected), "{s:?}");
    }
    assert!(error <= 4.0, "{error}");
}

#[test]
fn what_is_not_a_number_stays_none() {
    let (s, _) = triangular::<f64>(&Matrix::new(2, 2, |i, j| if (i, j) == (0, 1) { f64::NAN } else { 1.0 }));
    assert!(s.data.iter().any(|x| x.is_nan()));
}

/// Numbers in [−1, 1] without a pattern.
fn mixed(n: usize, k: usize) -> Matrix {
    Matrix::new(n, k, |i, j| {
        let mixed = (i * 1000 + j + 1) as u64;
        let mixed = mixed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (mixed << 21);
        (mixed.wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    })
}

/// Its root by every kernel: of rows that end in room for whole packs, and of those that do not.
fn every_way(a: &Matrix) -> Vec<Matrix> {
    let least = a.rows.max(a.columns);
    let whole = least.next_multiple_of(4);
    let roots = [whole + 1, whole, whole + 8].map(|stride| {
        let (s, error) = triangular_in::<f64>(a, stride);
        let (n, k) = (a.rows, a.columns);
        assert!(is_factor(&s) && error < 8.0 * k as f64, "{n} x {k} in {stride}: {error}");
        s
    });
    roots.into()
}

#[test]
fn long_rows_and_many_of_them_too() {
    for (n, k) in [(1, 60), (2, 70), (3, 61), (20, 60), (21, 64), (33, 33), (50, 64), (40, 170), (130, 300)] {
        every_way(&mixed(n, k));
    }
}

#[test]
fn rows_that_end_in_zeros_have_the_same_root() {
    for (n, k) in [(17, 52), (18, 60), (39, 120), (50, 100)] {
        let full = mixed(n, k);
        // diagonal noise behind a full block; staggered ends; a triangle, which is its own root but for signs
        every_way(&Matrix::new(n, k, |i, j| if j < k - n || j - (k - n) == i { full.at(i, j) } else { 0.0 }));
        every_way(&Matrix::new(n, k, |i, j| if j < 3 + (i * 7) % k { full.at(i, j) } else { 0.0 }));
        for s in every_way(&Matrix::new(n, k, |i, j| if j <= i { full.at(i, j) } else { 0.0 })) {
            for (i, j) in (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))) {
                assert!((s.at(i, j).abs() - full.at(i, j).abs()).abs() < 1e-14, "{i} {j}");
            }
        }
    }
}

#[test]
fn a_long_row_may_have_nothing_left_wherever_it_stands() {
    for (n, k) in [(18, 60), (37, 80), (20, 16), (40, 38)] {
        for lost in [0, 1, 2, 3, 4, 7, n - 2, n - 1] {
            let full = mixed(n, k);
            // a row of zeros, and one that repeats the row above
            for repeats in [false, true] {
                let of = |i, j| match (i == lost, repeats && lost > 0) {
                    (true, false) => 0.0,
                    (true, true) => full.at(lost - 1, j),
                    _ => full.at(i, j),
                };
                for s in every_way(&Matrix::new(n, k, of)) {
                    assert!(s.at(lost, lost) < 1e-13, "{n} x {k}: {lost} {}", s.at(lost, lost));
                }
            }
        }
    }
}

#[test]
fn rows_below_those_that_are_told_stay_as_they_are() {
    for (n, k) in [(3, 5), (6, 21), (20, 60), (21, 60), (22, 60), (23, 60), (40, 70)] {
        let full = mixed(n + 5, k);
        for stride in [k.next_multiple_of(4), k.next_multiple_of(4) + 1] {
            leaves_those_below::<f64>(&full, n, stride);
            leaves_those_below::<f32>(&full, n, stride);
        }
    }
}

fn leaves_those_below<T: Real + PartialEq>(a: &Matrix, n: usize, stride: usize) {
    let mut memory = a.memory::<T>(stride, 7.0);
    let stated = memory.clone();
    assert!(tria(&mut memory, n, a.columns, stride).failed().is_none());
    assert_eq!(memory[n * stride..], stated[n * stride..], "{n} × {} in {stride}", a.columns);
}

#[test]
fn what_stands_behind_a_row_does_not_matter_and_is_zero_after() {
    for (n, k) in [(1, 3), (3, 3), (4, 1), (5, 4), (6, 18), (20, 59), (33, 42), (40, 30), (40, 170)] {
        let a = mixed(n, k);
        for stride in 0..9 {
            let stride = n.max(k) + stride;
            let mut memory = a.memory::<f64>(stride, 7.0);
            assert!(tria(&mut memory, n, k, stride).failed().is_none());
            let whole = Matrix::of(n, stride, &memory, stride);
            assert!(is_factor(&whole), "{n} × {k} in {stride}");
            let error = apart(&whole.outer(), &a.outer(), |i| a.norm(i)) / f64::EPSILON;
            assert!(error < 8.0 * (n * k) as f64, "{n} × {k} in {stride}: {error}");
        }
    }
}

#[test]
fn what_is_not_a_number_stays_none_in_long_rows_too() {
    for (n, k, bad) in [(18, 60_usize, 0), (18, 60, 5), (40, 120, 39)] {
        let whole = k.next_multiple_of(4);
        let full = mixed(n, k);
        let a = Matrix::new(n, k, |i, j| if (i, j) == (bad, k - 1) { f64::NAN } else { full.at(i, j) });
        let (s, _) = triangular_in::<f64>(&a, whole);
        assert!(
            s.at(bad, bad).is_nan() && (0..bad).all(|i| s.row(i).iter().all(|x| x.is_finite())),
            "{n} {bad}"
        );
    }
}

#[test]
fn a_row_whose_squares_overflow_is_told_and_is_not_zero() {
    for (n, columns) in [(2_usize, 4_usize), (7, 22), (13, 40), (30, 90)] {
        for row in [0, n / 2, n - 1] {
            for stride in [columns + 1, columns.next_multiple_of(8)] {
                let mut a: Vec<f64> = (0..n * stride).map(|i| Real::sin(1.0 + 0.7 * i as f64)).collect();
                a[row * stride + row + 1] = 1e160;
                assert_eq!(
                    tria(&mut a, n, columns, stride).failed(),
                    Some(row),
                    "{n} × {columns} in {stride}"
                );
            }
        }
    }
    // more rows than columns
    let mut tall = [f64::NAN; 16];
    let _ = tria(&mut tall, 4, 2, 4);
    assert!(tall[0].is_nan());
}
