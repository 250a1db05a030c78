//! Cholesky factorisation of what is semidefinite, and the pivot at which it fails of what is not.

use super::matrix::{Matrix, any_matrix, apart, deficient, factor, is_factor};
use givens_core::kernels::{cholesky, cholesky_again, cholesky_scaled, kept_root};
use givens_core::scalar::Real;
use proptest::prelude::*;

/// The factor, or the failing pivot. The strict upper triangle must not be read.
fn factorised<T: Real>(p: &Matrix) -> Result<Matrix, usize> {
    let n = p.rows;
    let lower = Matrix::new(n, n, |i, j| if j > i { f64::NAN } else { p.at(i, j) });
    let mut memory = lower.memory::<T>(n, 0.0);
    let failed = cholesky(&mut memory, n).failed();
    match failed {
        Some(pivot) => Err(pivot),
        None => Ok(Matrix::of(n, n, &memory, n)),
    }
}

fn is_root<T: Real>(a: &Matrix) -> Result<Matrix, TestCaseError> {
    let p = a.outer();
    let found = factorised::<T>(&p);
    prop_assert!(found.is_ok(), "pivot {:?}", found);
    let s = found.unwrap();
    prop_assert!(is_factor(&s));
    let error = apart(&s.outer(), &p, |i| a.norm(i)) / T::EPSILON;
    prop_assert!(error <= 16.0 * a.rows as f64, "{error}");
    Ok(s)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_definite_matrix_has_its_root(l in (1usize..=9).prop_flat_map(factor)) {
        is_root::<f64>(&l)?;
        is_root::<f32>(&l)?;
    }

    #[test]
    fn wide_matrices_of_any_units_have_their_root(a in any_matrix(1usize..=6, 20usize..=30)) {
        is_root::<f64>(&a)?;
        is_root::<f32>(&a)?;
    }

    #[test]
    fn a_semidefinite_matrix_has_its_root_in_echelon_form((a, dependent) in (1usize..=7).prop_flat_map(deficient)) {
        let s = is_root::<f64>(&a)?;
        for (j, &dependent) in dependent.iter().enumerate() {
            prop_assert_eq!(s.at(j, j) == 0.0, dependent, "pivot {} of {:?}", j, s);
            prop_assert!(!dependent || (j..s.rows).all(|i| s.at(i, j) == 0.0), "column {} of {:?}", j, s);
        }
    }

    /// P = L Δ Lᵀ with the first negative number of Δ at one pivot: the leading minors are positive up to it.
    #[test]
    fn an_indefinite_matrix_fails_at_the_first_negative_minor(
        (l, at) in (1usize..=8).prop_flat_map(|n| (factor(n), 0..n)),
        signs: u8,
    ) {
        let n = l.rows;
        let sign = |k: usize| match k.cmp(&at) {
            core::cmp::Ordering::Less => 1.0,
            core::cmp::Ordering::Equal => -1.0,
            core::cmp::Ordering::Greater => if signs >> k & 1 == 1 { 1.0 } else { -1.0 },
        };
        let p = Matrix::new(n, n, |i, j| (0..n).map(|k| l.at(i, k) * sign(k) * l.at(j, k)).sum());
        prop_assert_eq!(factorised::<f64>(&p).err(), Some(at));
        prop_assert_eq!(factorised::<f32>(&p).err(), Some(at));
    }

    #[test]
    fn a_zero_pivot_above_a_column_that_is_not_zero_fails(l in (2usize..=8).prop_flat_map(factor), at in 0usize..7) {
        let (n, at) = (l.rows, at % (l.rows - 1));
        // P_at,at as if the row had no direction of its own; the covariances with it stay
        let mut p = l.outer();
        p.data[at * (n + 1)] = l.row(at)[..at].iter().map(|x| x * x).sum();
        let below = (at + 1..n).any(|i| l.at(i, at).abs() > 1e-3);
        prop_assume!(below);
        prop_assert_eq!(factorised::<f64>(&p).err(), Some(at));
    }
}

#[test]
fn a_difference_is_judged_by_what_was_subtracted() {
    // 1 − 1 with the rounding of numbers of 1000
    let difference = [-1e-13, 0.0, 0.0, 1.0];
    assert_eq!(cholesky(&mut difference.clone(), 2).failed(), Some(0));
    let mut scaled = difference;
    assert!(cholesky_scaled(&mut scaled, 2, &[1000.0, 1.0]).failed().is_none());
    assert_eq!(scaled, [0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn what_is_not_a_number_fails_where_it_stands() {
    for bad in [f64::NAN, f64::NEG_INFINITY] {
        assert_eq!(cholesky(&mut [1.0, 0.0, 0.0, bad], 2).failed(), Some(1));
        assert_eq!(cholesky(&mut [bad, 0.0, 0.0, 1.0], 2).failed(), Some(0));
    }
    assert!(cholesky(&mut [1.0, 0.0, f64::NAN, 1.0], 2).failed().is_some());
}

#[test]
fn a_variance_that_is_infinite_is_told_and_is_not_zero() {
    for huge in [f64::INFINITY, f64::NAN] {
        let mut p = [1.0, 0.0, 0.0, huge];
        assert_eq!(cholesky(&mut p, 2).failed(), Some(1));
    }
}

#[test]
fn a_root_that_is_kept_is_that_of_the_covariance_at_hand() {
    let mut kept = [0.0; kept_root(2)];
    // the same again, a zero one, one that is none, and again; what stands above the diagonal is not read
    for (p, failed) in [
        ([4.0, 9.0, 2.0, 3.0], None),
        ([4.0, 7.0, 2.0, 3.0], None),
        ([4.0, 7.0, 2.0, 5.0], None),
        ([0.0, 0.0, 0.0, 0.0], None),
        ([1.0, 0.0, 2.0, 1.0], Some(1)),
        ([1.0, 0.0, 2.0, 1.0], Some(1)),
        ([f64::NAN, 0.0, 0.0, 1.0], Some(0)),
        ([4.0, 7.0, 2.0, 3.0], None),
    ] {
        let (mut again, mut anew) = (p, p);
        assert_eq!(cholesky_again(&mut again, 2, &mut kept).failed(), failed, "{p:?}");
        assert_eq!(cholesky(&mut anew, 2).failed(), failed, "{p:?}");
        if failed.is_none() {
            assert_eq!(again, anew, "{p:?}");
        }
    }
}

#[test]
fn a_root_of_any_size_is_kept() {
    for n in [1, 3, 4] {
        let mut kept = vec![0.0; kept_root(n)];
        // whole numbers, whose squares and roots are exact
        let of = |times: f64| {
            let s = Matrix::new(n, n, |i, j| if j <= i { times * (1 + i + j) as f64 } else { 0.0 });
            (s.outer().data, s.data)
        };
        for times in [1.0, 1.0, 2.0, 2.0, 1.0] {
            let (mut p, s) = of(times);
            assert!(cholesky_again(&mut p, n, &mut kept).failed().is_none());
            assert_eq!(p, s, "{n}");
        }
    }
}
