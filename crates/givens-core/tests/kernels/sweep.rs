//! The sweep is Tria of the block that it is given, without its zeros.

use super::matrix::{Matrix, apart, factor, is_factor};
use givens_core::kernels::{sweep, tria};
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
    let size = a.rows;
    let (mut memory, mut scratch) = (a.memory::<T>(size, 0.0), vec![T::of(f64::NAN); size - d]);
    assert!(sweep(&mut memory, d, size - d, &mut scratch).failed().is_none());
    Matrix::of(size, size, &memory, size)
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

/// L and S of a measurement of d components and n states, and what is between them.
fn parts() -> impl Strategy<Value = (Matrix, Matrix, Matrix)> {
    (1usize..=6, 1usize..=6).prop_flat_map(|(d, n)| {
        let between = prop::collection::vec(-2.0..2.0, d * n);
        let between = between.prop_map(move |of| Matrix::new(d, n, |i, j| of[i * n + j]));
        (factor(d), between, factor(n))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn it_is_tria_of_the_assembled_block((l, between, s) in parts(), noiseless: bool) {
        let d = l.rows;
        // without noise L is zero, and D alone has to fill the pivots
        let l = if noiseless { Matrix::new(d, d, |_, _| 0.0) } else { l };
        let a = block(&l, &between, &s);
        agree::<f64>(&a, d)?;
        agree::<f32>(&a, d)?;
    }
}
