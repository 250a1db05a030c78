//! A downdate is the root of the difference, and fails where that has none.

use super::matrix::{Matrix, apart, factor, is_factor};
use givens_core::kernels::downdate;
use givens_core::scalar::Real;
use proptest::prelude::*;

/// L L ᵀ − v vᵀ.
fn difference(l: &Matrix, v: &[f64]) -> Matrix {
    let p = l.outer();
    Matrix::new(l.rows, l.rows, |i, j| p.at(i, j) - v[i] * v[j])
}

fn downdated<T: Real>(l: &Matrix, v: &[f64]) -> Result<Matrix, usize> {
    let (n, stride) = (l.rows, l.rows + 2);
    let mut memory = l.memory::<T>(stride, 7.0);
    let mut v: Vec<T> = v.iter().map(|&v| T::of(v)).collect();
    let failed = downdate(&mut memory, n, stride, &mut v).failed();
    assert!((0..n).all(|i| memory[i * stride + n].first() == 7.0), "what stands behind is the caller's");
    match failed {
        Some(pivot) => Err(pivot),
        None => Ok(Matrix::of(n, n, &memory, stride)),
    }
}

/// L, and a direction u of length one: v = length · L u takes 1 − length² of the variance along it.
fn parts() -> impl Strategy<Value = (Matrix, Vec<f64>)> {
    (1usize..=8).prop_flat_map(|n| (factor(n), prop::collection::vec(-1.0..1.0, n))).prop_filter_map(
        "a direction",
        |(l, u): (Matrix, Vec<f64>)| {
            let norm = u.iter().map(|x| x * x).sum::<f64>().sqrt();
            (norm > 1e-3).then(|| (l, u.into_iter().map(|x| x / norm).collect()))
        },
    )
}

fn moved(l: &Matrix, u: &[f64], length: f64) -> Vec<f64> {
    l.times(&Matrix::new(l.rows, 1, |i, _| length * u[i])).data
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn it_is_the_root_of_the_difference((l, u) in parts(), length in 0.0..0.95) {
        let v = moved(&l, &u, length);
        let expected = difference(&l, &v);
        for (found, epsilon) in [(downdated::<f64>(&l, &v), f64::EPSILON), (downdated::<f32>(&l, &v), f64::from(f32::EPSILON))] {
            prop_assert!(found.is_ok(), "pivot {:?}", found);
            let found = found.unwrap();
            prop_assert!(is_factor(&found));
            let error = apart(&found.outer(), &expected, |i| l.norm(i)) / epsilon;
            prop_assert!(error <= 32.0 * l.rows as f64 / (1.0 - length * length), "{error}");
        }
    }

    #[test]
    fn it_fails_at_the_first_minor_that_is_negative((l, u) in parts(), length in 1.05..3.0) {
        let v = moved(&l, &u, length);
        // the minor of order k + 1 is that of L Lᵀ times 1 − length² Σ_i≤k u_i²
        let left: Vec<f64> = u.iter().scan(1.0, |left, u| { *left -= length * length * u * u; Some(*left) }).collect();
        prop_assume!(left.iter().all(|left| left.abs() > 1e-3));
        let at = left.iter().position(|&left| left < 0.0);
        prop_assert_eq!(downdated::<f64>(&l, &v).err(), at);
        prop_assert_eq!(downdated::<f32>(&l, &v).err(), at);
    }

    #[test]
    fn nothing_to_take_changes_nothing(l in (1usize..=8).prop_flat_map(factor)) {
        let found = downdated::<f64>(&l, &vec![0.0; l.rows]);
        prop_assert_eq!(found.map(|found| found.data), Ok(l.data.clone()));
    }

    #[test]
    fn a_column_taken_whole_leaves_zeros(l in (1usize..=8).prop_flat_map(factor)) {
        let v: Vec<f64> = (0..l.rows).map(|i| l.at(i, 0)).collect();
        let found = downdated::<f64>(&l, &v).unwrap();
        prop_assert!((0..l.rows).all(|i| found.at(i, 0) == 0.0));
        prop_assert!(apart(&found.outer(), &difference(&l, &v), |i| l.norm(i)) < 1e-14);
    }
}

#[test]
fn what_is_not_a_number_fails() {
    assert_eq!(downdate(&mut [f64::NAN], 1, 1, &mut [1.0]).failed(), Some(0));
    assert_eq!(downdate(&mut [1.0], 1, 1, &mut [f64::NAN]).failed(), Some(0));
    assert_eq!(downdate(&mut [1.0], 1, 1, &mut [f64::INFINITY]).failed(), Some(0));
}
