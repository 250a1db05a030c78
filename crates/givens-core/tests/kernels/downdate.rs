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

/// A pivot that is noise, of L and of what is taken: what stands below it stays in the rows that it belongs to.
fn is_kept_below_noise(pivot: f64, taken: f64, error: f64) {
    for n in 3..=7 {
        for k in 1..n - 1 {
            let entry = |i: usize, j: usize| Real::sin(1.0 + 1.7 * i as f64 + 0.6 * (j * j) as f64);
            let l = Matrix::new(n, n, |i, j| match i.cmp(&j) {
                core::cmp::Ordering::Equal if i == k => pivot,
                core::cmp::Ordering::Equal => 1.0 + entry(i, j).abs(),
                core::cmp::Ordering::Greater => entry(i, j),
                core::cmp::Ordering::Less => 0.0,
            });
            // of the directions behind pivot k, and of none before
            let u: Vec<f64> =
                (0..n).map(|j| if j > k { 0.5 * entry(j, k) / n as f64 } else { 0.0 }).collect();
            let mut v = moved(&l, &u, 1.0);
            v[k] = taken;
            let expected = difference(&l, &v);
            let found = downdated::<f64>(&l, &v).unwrap();
            assert!(is_factor(&found), "{n} {k}: {found:?}");
            assert!((0..n).all(|i| found.at(i, k) == 0.0), "{n} {k}: {found:?}");
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let off = (found.outer().at(i, j) - expected.at(i, j)).abs() / (l.norm(i) * l.norm(j));
                let allowed = if i == k || j == k { error } else { 1e-14 };
                assert!(off <= allowed, "{n} {k}: {i} {j} {off:e}");
            }
        }
    }
}

#[test]
fn what_stands_below_a_pivot_of_rounding_stays() {
    for taken in [1e-17, -1e-17] {
        is_kept_below_noise(1e-17, taken, 1e-14);
    }
}

#[test]
fn what_stands_below_a_pivot_whose_square_is_rounding_stays() {
    for taken in [1e-9, -1e-9] {
        is_kept_below_noise(1e-9, taken, 1e-8);
    }
}

#[test]
fn what_goes_with_a_pivot_whose_square_is_rounding_goes() {
    for n in 3..=7 {
        for k in 1..n - 1 {
            let entry = |i: usize, j: usize| Real::sin(1.0 + 1.7 * i as f64 + 0.6 * (j * j) as f64);
            let at = |i: usize, j: usize| if i == j { 1.0 + entry(i, j).abs() } else { entry(i, j) };
            let l = Matrix::new(n, n, |i, j| match (i, j) {
                _ if j > i => 0.0,
                _ if i == k && j == k => 1e-9,
                _ => at(i, j),
            });
            let v: Vec<f64> = (0..n).map(|i| l.at(i, k)).collect();
            let found = downdated::<f64>(&l, &v).unwrap();
            let expected = Matrix::new(n, n, |i, j| if j == k { 0.0 } else { l.at(i, j) });
            assert_eq!(found.data, expected.data, "{n} {k}");
        }
    }
}

#[test]
fn what_is_not_a_number_fails() {
    assert_eq!(downdate(&mut [f64::NAN], 1, 1, &mut [1.0]).failed(), Some(0));
    assert_eq!(downdate(&mut [1.0], 1, 1, &mut [f64::NAN]).failed(), Some(0));
    assert_eq!(downdate(&mut [1.0], 1, 1, &mut [f64::INFINITY]).failed(), Some(0));
}
