//! What a pivot of a Cholesky factorisation is taken for beside the rounding that may be in it (docs/algorithms.md K4), from
//! half of the bound to twice of it, in any units.

use givens_core::kernels::{Health, cholesky, cholesky_scaled};
use givens_core::scalar::Real;

/// Powers of two change no digit: these are about 1e-9, 1 and 1e9.
const UNITS: [i32; 3] = [-30, 0, 30];

/// The lower triangle in a unit, and numbers behind the matrix that are the caller's.
fn memory<T: Real>(p: &[f64], unit: f64) -> Vec<T> {
    p.iter().map(|x| T::of(unit * x)).chain([T::of(7.0); 16]).collect()
}

fn judge<T: Real>(
    n: usize,
    p: &[f64],
    unit: f64,
    root: impl Fn(&mut [T]) -> Health<T>,
) -> Result<Vec<f64>, usize> {
    let mut a = memory::<T>(p, unit);
    let failed = root(&mut a).failed();
    assert!(a[n * n..].iter().all(|x| x.first() == 7.0), "what stands behind the matrix is the caller's");
    failed.map_or(Ok(a[..n * n].iter().map(|x| x.first() / unit.sqrt()).collect()), Err)
}

/// Row 1 is `times` row 0, but for a rest; the others are those of the unit matrix.
fn repeated(n: usize, times: f64, rest: f64) -> Vec<f64> {
    let mut p = vec![0.0; n * n];
    for i in 0..n {
        p[i * n + i] = 1.0;
    }
    (p[n], p[n + 1]) = (times, times * times + rest);
    p
}

/// The rest of pivot 1 is zero to half of `bound`, and from twice of it on what it is.
fn is_known_to<T: Real>(n: usize, times: f64, bound: f64, root: impl Fn(&mut [T], f64) -> Health<T>) {
    for unit in UNITS.map(|power| 2_f64.powi(power)) {
        let of = |rest: f64| judge(n, &repeated(n, times, rest), unit, |a| root(a, unit));
        for rest in [-0.5 * bound, 0.0, 0.5 * bound] {
            let s = of(rest).unwrap_or_else(|pivot| panic!("{pivot} of {n}: {rest:e} in {unit}"));
            assert_eq!(s[n + 1], 0.0, "{n}: {rest:e} in {unit}");
        }
        assert_eq!(of(-2.0 * bound), Err(1), "{n} in {unit}");
        let (left, root) = (of(2.0 * bound).unwrap()[n + 1], (2.0 * bound).sqrt());
        assert!((left / root - 1.0).abs() < 1e-6, "{n} in {unit}: {left} {root}");
    }
}

fn rests<T: Real>() {
    for n in [2, 3, 5] {
        let rounding = n as f64 * T::EPSILON;
        for times in [1.0, 3.0] {
            // σ: its own standard deviation, and `times` that of row 0
            let sigma = times + times;
            is_known_to::<T>(n, times, 64.0 * rounding * sigma * sigma, |a, _| cholesky(a, n));
        }
        // of a difference: what was there before, variances of 9 and 16
        let sigma = 3.0 * 3.0 + 4.0;
        is_known_to::<T>(n, 3.0, 8.0 * rounding * sigma * sigma, |a, unit| {
            let mut scale = vec![T::of(unit); n];
            (scale[0], scale[1]) = (T::of(9.0 * unit), T::of(16.0 * unit));
            cholesky_scaled(a, n, &scale)
        });
    }
}

#[test]
fn a_pivot_is_zero_within_the_rounding_that_is_in_it() {
    rests::<f64>();
    rests::<f32>();
}

/// Pivot 1 is zero, and row `i` of four has `x` below it.
fn above<T: Real>(i: usize, x: f64, unit: f64, root: impl Fn(&mut [T]) -> Health<T>) -> Option<usize> {
    let mut p = repeated(4, 1.0, 0.0);
    (p[2 * 4 + 2], p[3 * 4 + 3]) = (4.0, 64.0);
    p[i * 4 + 1] = x;
    judge(4, &p, unit, root).map_or_else(Some, |s| {
        assert!((1..4).all(|i| s[i * 4 + 1] == 0.0), "{s:?}");
        assert_eq!((s[2 * 4 + 2], s[3 * 4 + 3]), (2.0, 8.0));
        None
    })
}

fn columns<T: Real>() {
    for unit in UNITS.map(|power| 2_f64.powi(power)) {
        for (i, variance) in [(2, 4.0), (3, 64.0)] {
            // σ = 1 + 1; a covariance is at most the geometric mean of the variances
            let of = |x: f64| above::<T>(i, x, unit, |a| cholesky(a, 4));
            let bound = (64.0 * 4.0 * T::EPSILON * 4.0 * (variance + variance)).sqrt();
            assert_eq!((of(0.5 * bound), of(-0.5 * bound)), (None, None), "{i} in {unit}");
            assert_eq!((of(2.0 * bound), of(-2.0 * bound)), (Some(1), Some(1)), "{i} in {unit}");

            let before = [1.0, 1.0, 400.0, 6400.0];
            let scale = before.map(|x| T::of(unit * x));
            let of = |x: f64| above::<T>(i, x, unit, |a| cholesky_scaled(a, 4, &scale));
            let bound = (8.0 * 4.0 * T::EPSILON * 4.0 * (variance + before[i])).sqrt();
            assert_eq!((of(0.5 * bound), of(-0.5 * bound)), (None, None), "{i} in {unit}");
            assert_eq!((of(2.0 * bound), of(-2.0 * bound)), (Some(1), Some(1)), "{i} in {unit}");
        }
    }
}

#[test]
fn a_column_below_a_zero_pivot_is_zero_within_the_rounding_of_that_and_its_own_size() {
    columns::<f64>();
    columns::<f32>();
}
