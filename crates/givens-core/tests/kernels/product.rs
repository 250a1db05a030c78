//! Products are those of the textbook, read from rows of any length and written where they belong.

use super::matrix::Matrix;
use givens_core::kernels::{
    add_outer, copy_lower, dot, less_dot, plus_dot, plus_magnitudes, product_lower, square, square_lower,
    wild_row,
};

/// Whole numbers, whose products and sums are exact in any order.
fn whole(rows: usize, columns: usize) -> Matrix {
    Matrix::new(rows, columns, |i, j| ((7 * i + 3 * j + i * j) % 11) as f64 - 4.0)
}

fn lower(n: usize) -> Matrix {
    let full = whole(n, n);
    Matrix::new(n, n, |i, j| if j <= i { full.at(i, j) } else { 0.0 })
}

#[test]
fn sums_of_products_go_over_the_shorter_of_both() {
    let (a, b) = ([2.0, -3.0, 5.0, 7.0], [11.0, 13.0, -17.0]);
    let sum = 2.0 * 11.0 - 3.0 * 13.0 - 5.0 * 17.0;
    assert_eq!((dot(&a, &b), dot(&b, &a)), (sum, sum));
    assert_eq!((plus_dot(100.0, &a, &b), less_dot(100.0, &a, &b)), (100.0 + sum, 100.0 - sum));
}

#[test]
fn magnitudes_are_summed_whatever_the_length() {
    for length in [0, 1, 3, 15, 16, 17, 18, 19, 35] {
        let row: Vec<f64> =
            (0..length).map(|i| if i % 3 == 1 { 1.0 } else { -1.0 } * f64::from(1 << (i % 20))).collect();
        let sum: f64 = row.iter().map(|x| x.abs()).sum();
        assert_eq!(plus_magnitudes(0.5, &row), 0.5 + sum, "{length}");
    }
}

#[test]
fn a_wild_row_is_the_first_with_a_number_that_is_none_wherever_it_stands() {
    assert_eq!(wild_row(&[1.0; 12], 4), None);
    for at in 0..12 {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut rows = [1.0; 12];
            rows[at] = bad;
            assert_eq!(wild_row(&rows, 4), Some(at / 4), "{at}");
            rows[11] = bad;
            assert_eq!(wild_row(&rows, 4), Some(at / 4), "{at}");
        }
    }
}

#[test]
fn an_outer_product_is_added_or_taken_away() {
    let (rows, columns, k, stride_a, stride_b) = (3, 4, 5, 6, 7);
    let (a, b, c) = (whole(rows, k), whole(columns + 1, k), whole(rows, columns));
    let b = Matrix::new(columns, k, |i, j| b.at(i + 1, j));
    for sign in [1.0, -1.0] {
        let mut sum = c.data.clone();
        let (a_rows, b_rows) = (a.memory::<f64>(stride_a, f64::NAN), b.memory::<f64>(stride_b, f64::NAN));
        add_outer(&mut sum, rows, columns, &a_rows, stride_a, &b_rows, stride_b, k, sign);
        let of = |i: usize, j: usize| -> f64 { a.row(i).iter().zip(b.row(j)).map(|(x, y)| x * y).sum() };
        assert_eq!(sum, Matrix::new(rows, columns, |i, j| c.at(i, j) + sign * of(i, j)).data);
    }
}

#[test]
fn a_square_is_the_outer_product_of_rows_short_or_long() {
    for (n, k) in [(1, 1), (4, 3), (3, 63), (3, 64), (5, 65), (4, 66), (4, 67)] {
        let a = whole(n, k);
        let mut p = vec![f64::NAN; n * n];
        square(&mut p, n, &a.memory::<f64>(k + 2, f64::NAN), k + 2, k);
        assert_eq!(p, a.outer().data, "{n} × {k}");
    }
}

#[test]
fn the_square_of_a_factor_reads_its_triangle_only() {
    for n in [1, 2, 5, 63, 64, 65, 70] {
        let s = lower(n);
        let mut p = vec![f64::NAN; n * n];
        let triangle = Matrix::new(n, n, |i, j| if j <= i { s.at(i, j) } else { f64::NAN });
        square_lower(&mut p, n, &triangle.data);
        assert_eq!(p, s.outer().data, "{n}");
    }
}

#[test]
fn a_product_with_a_factor_takes_the_rows_that_it_is_told() {
    for n in [1, 2, 5] {
        let (a, s) = (whole(4, n), lower(n));
        let mut product = a.data.clone();
        product_lower(&mut product, 3, n, &s.memory::<f64>(n + 2, f64::NAN), n + 2);
        assert_eq!(product[..3 * n], a.times(&s).data[..3 * n]);
        assert_eq!(product[3 * n..], a.data[3 * n..]);
    }
}

#[test]
fn a_copy_leaves_out_what_stands_behind_the_rows() {
    let s = whole(3, 3);
    let mut copy = [f64::NAN; 9];
    copy_lower(&mut copy, 3, &s.memory::<f64>(5, f64::NAN), 5);
    assert_eq!(copy.to_vec(), s.data);
}
