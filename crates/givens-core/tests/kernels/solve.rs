//! Substitution undoes multiplication, also by a factor in echelon form.

use super::matrix::{Matrix, factor};
use givens_core::kernels::{divide_lower, divide_lower_transposed, solve_lower, solve_lower_rows};
use proptest::prelude::*;

/// A factor, some of whose pivots are zero with their columns, and B of as many columns.
fn parts() -> impl Strategy<Value = (Matrix, Matrix)> {
    (1usize..=8, 0usize..=5).prop_flat_map(|(n, rows)| {
        let missing = prop::collection::vec(prop::bool::weighted(0.2), n);
        let b = prop::collection::vec(-1.0..1.0, rows * n);
        (factor(n), missing, b).prop_map(move |(l, missing, b)| {
            let l = Matrix::new(n, n, |i, j| if missing[j] { 0.0 } else { l.at(i, j) });
            // nothing along the pivots that are not there
            (l, Matrix::new(rows, n, |i, j| if missing[j] { 0.0 } else { b[i * n + j] }))
        })
    })
}

fn transposed(a: &Matrix) -> Matrix {
    Matrix::new(a.columns, a.rows, |i, j| a.at(j, i))
}

/// |X − Y| in units of ε Π of a triangular system's growth, which is at most 3ⁿ here.
fn close(x: &Matrix, y: &Matrix) -> bool {
    let allowed = 4.0 * f64::EPSILON * 3f64.powi(i32::try_from(x.columns).unwrap());
    x.data.iter().zip(&y.data).all(|(x, y)| (x - y).abs() <= allowed)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn division_by_a_factor_undoes_the_product((l, b) in parts()) {
        let (n, stride) = (l.rows, l.rows + 1);
        let memory = l.memory::<f64>(stride, f64::NAN);
        let mut product = b.times(&l);
        divide_lower(&mut product.data, b.rows, n, &memory, stride);
        prop_assert!(close(&product, &b), "{product:?} for {b:?}");
    }

    #[test]
    fn division_by_its_transpose_undoes_that_product((l, b) in parts()) {
        let (n, stride) = (l.rows, l.rows + 1);
        let memory = l.memory::<f64>(stride, f64::NAN);
        let mut product = b.times(&transposed(&l));
        divide_lower_transposed(&mut product.data, b.rows, n, &memory, stride);
        prop_assert!(close(&product, &b), "{product:?} for {b:?}");
        // row by row it is a solve
        for i in 0..b.rows {
            let mut rhs = l.times(&Matrix::new(n, 1, |j, _| b.at(i, j))).data;
            solve_lower(&memory, stride, &mut rhs);
            let found = Matrix { rows: 1, columns: n, data: rhs };
            prop_assert!(close(&found, &Matrix::new(1, n, |_, j| b.at(i, j))));
        }
    }

    #[test]
    fn several_columns_are_solved_as_each_alone((l, b) in parts()) {
        let (n, stride) = (l.rows, l.rows + 1);
        let memory = l.memory::<f64>(stride, f64::NAN);
        let mut product = l.times(&transposed(&b)).data;
        solve_lower_rows(&memory, stride, &mut product, b.rows);
        let found = transposed(&Matrix { rows: n, columns: b.rows, data: product });
        prop_assert!(close(&found, &b), "{found:?} for {b:?}");
    }
}
