//! Small matrices and how random ones are drawn.

use givens_core::scalar::Real;
use proptest::prelude::*;

/// A matrix of doubles, row by row.
#[derive(Clone, Debug)]
pub struct Matrix {
    pub rows: usize,
    pub columns: usize,
    pub data: Vec<f64>,
}

impl Matrix {
    pub fn new(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let data = (0..rows * columns).map(|k| entry(k / columns, k % columns)).collect();
        Self { rows, columns, data }
    }

    /// From a kernel's memory: the leading part of rows of length `stride`.
    pub fn of<T: Real>(rows: usize, columns: usize, memory: &[T], stride: usize) -> Self {
        Self::new(rows, columns, |i, j| memory[i * stride + j].first())
    }

    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.data[i * self.columns + j]
    }

    pub fn row(&self, i: usize) -> &[f64] {
        &self.data[i * self.columns..(i + 1) * self.columns]
    }

    pub fn norm(&self, i: usize) -> f64 {
        self.row(i).iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    /// A B.
    pub fn times(&self, b: &Self) -> Self {
        assert_eq!(self.columns, b.rows);
        Self::new(self.rows, b.columns, |i, j| (0..b.rows).map(|k| self.at(i, k) * b.at(k, j)).sum())
    }

    /// A Aᵀ.
    pub fn outer(&self) -> Self {
        Self::new(self.rows, self.rows, |i, j| self.row(i).iter().zip(self.row(j)).map(|(x, y)| x * y).sum())
    }

    /// In a kernel's memory, in rows of length `stride`; what the kernel must not read is `beyond`.
    pub fn memory<T: Real>(&self, stride: usize, beyond: f64) -> Vec<T> {
        let entry =
            |k: usize| if k % stride < self.columns { self.at(k / stride, k % stride) } else { beyond };
        (0..self.rows * stride).map(|k| T::of(entry(k))).collect()
    }
}

/// The largest |X − Y|_ij in units of `size`(i) `size`(j), zero differences apart.
pub fn apart(x: &Matrix, y: &Matrix, size: impl Fn(usize) -> f64) -> f64 {
    assert_eq!((x.rows, x.columns), (y.rows, y.columns));
    let entries = (0..x.rows).flat_map(|i| (0..x.columns).map(move |j| (i, j)));
    entries.fold(0.0, |worst, (i, j)| {
        let error = (x.at(i, j) - y.at(i, j)).abs();
        // not `max`, which would pass over a NaN
        let error = if error == 0.0 { 0.0 } else { error / (size(i) * size(j)) };
        if error > worst || error.is_nan() { error } else { worst }
    })
}

/// Lower triangular, with a diagonal of zero or more.
pub fn is_factor(s: &Matrix) -> bool {
    (0..s.rows).all(|i| s.at(i, i) >= 0.0 && s.row(i)[i + 1..].iter().all(|&x| x == 0.0))
}

/// Entries in [−1, 1], in units of 10^−6 to 10^6 for each row.
pub fn any_matrix(
    rows: impl Strategy<Value = usize>,
    columns: impl Strategy<Value = usize>,
) -> impl Strategy<Value = Matrix> {
    (rows, columns).prop_flat_map(|(rows, columns)| {
        let entries = prop::collection::vec(-1.0..1.0, rows * columns);
        let units = prop::collection::vec(-6..=6, rows);
        (entries, units).prop_map(move |(entries, units)| {
            Matrix::new(rows, columns, |i, j| entries[i * columns + j] * 10f64.powi(units[i]))
        })
    })
}

/// Lower triangular with a diagonal in [0.5, 2] and entries of at most 1 below it.
pub fn factor(n: usize) -> impl Strategy<Value = Matrix> {
    (prop::collection::vec(0.5..2.0, n), prop::collection::vec(-1.0..1.0, n * n)).prop_map(
        move |(diagonal, below)| {
            Matrix::new(n, n, |i, j| match i.cmp(&j) {
                core::cmp::Ordering::Equal => diagonal[i],
                core::cmp::Ordering::Greater => below[i * n + j],
                core::cmp::Ordering::Less => 0.0,
            })
        },
    )
}

/// The same seen along other axes: A U V of whole numbers, of which U and V undo without a fraction.
pub fn turned(n: usize) -> impl Strategy<Value = (Matrix, Vec<bool>)> {
    (deficient(n), prop::collection::vec(-1i32..=1, n * n)).prop_map(move |((a, dependent), entries)| {
        let unit = |keep: fn(usize, usize) -> bool| {
            let entry =
                |i, j| if keep(i, j) { f64::from(entries[i * n + j]) } else { f64::from(u8::from(i == j)) };
            Matrix::new(n, n, entry)
        };
        (a.times(&unit(|i, j| i > j)).times(&unit(|i, j| i < j)), dependent)
    })
}

/// A matrix of small whole numbers some of whose rows are combinations of the rows above them, and which those are.
/// The others have a direction of their own: row i has its last entry other than zero in a column that no row above has.
pub fn deficient(n: usize) -> impl Strategy<Value = (Matrix, Vec<bool>)> {
    (
        prop::collection::vec(any::<bool>(), n),
        prop::collection::vec(-3i32..=3, n * n),
        prop::collection::vec(1i32..=3, n),
    )
        .prop_map(move |(dependent, entries, pivots)| {
            let mut rows: Vec<Vec<i32>> = Vec::new();
            for i in 0..n {
                let used = dependent[..i].iter().filter(|&&d| !d).count();
                let mut row = vec![0; n];
                if dependent[i] {
                    for (above, &times) in rows.iter().zip(&entries[i * n..]) {
                        row.iter_mut().zip(above).for_each(|(x, y)| *x += times.signum() * y);
                    }
                } else {
                    row[..used].copy_from_slice(&entries[i * n..i * n + used]);
                    row[used] = pivots[i];
                }
                rows.push(row);
            }
            (Matrix::new(n, n, |i, j| f64::from(rows[i][j])), dependent)
        })
}
