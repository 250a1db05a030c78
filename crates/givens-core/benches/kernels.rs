//! Kernels alone, one matrix at a time: `cargo bench -p givens-core --bench kernels`.
#![allow(missing_docs, reason = "criterion's macros")]

use core::hint::black_box;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use givens_core::kernels::{cholesky, sweep, sweep_scratch, tria};

/// Numbers that repeat after eleven, with a larger diagonal.
fn matrix(rows: usize, columns: usize) -> Vec<f64> {
    let number =
        |k: usize| ((k * 37) % 11) as f64 / 11.0 + if k.is_multiple_of(columns + 1) { 4.0 } else { 0.0 };
    (0..rows * columns).map(number).collect()
}

/// n × 3n, as a prediction has it.
fn triangularise(c: &mut Criterion) {
    let mut group = c.benchmark_group("tria n x 3n");
    for n in [5, 7, 20, 50, 100] {
        let start = matrix(n, 3 * n);
        let mut a = start.clone();
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            b.iter(|| {
                a.copy_from_slice(&start);
                let _ = black_box(tria(black_box(&mut a), n, 3 * n, 3 * n));
            });
        });
    }
}

/// d measures into a factor of n states.
fn rotate(c: &mut Criterion) {
    let mut group = c.benchmark_group("sweep d x n");
    for (d, n) in [(2, 5), (3, 7), (10, 20), (25, 50)] {
        let size = d + n;
        let mut start = matrix(size, size);
        for (k, number) in start.iter_mut().enumerate() {
            let (i, j) = (k / size, k % size);
            if (i >= d && j < d) || (j > i && (j < d || i >= d)) {
                *number = 0.0;
            }
        }
        let (mut a, mut scratch) = (start.clone(), vec![0.0; sweep_scratch(d, n)]);
        group.bench_function(BenchmarkId::from_parameter(format!("{d} x {n}")), |b| {
            b.iter(|| {
                a.copy_from_slice(&start);
                let _ = black_box(sweep(black_box(&mut a), d, n, &mut scratch));
            });
        });
    }
}

/// n × n, of a matrix with a large diagonal.
fn factorise(c: &mut Criterion) {
    let mut group = c.benchmark_group("cholesky n x n");
    for n in [5, 7, 20, 50, 100] {
        let mut start = vec![0.5; n * n];
        start.iter_mut().step_by(n + 1).for_each(|diagonal| *diagonal = n as f64);
        let mut a = start.clone();
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            b.iter(|| {
                a.copy_from_slice(&start);
                let _ = black_box(cholesky(black_box(&mut a), n));
            });
        });
    }
}

criterion_group!(kernels, triangularise, rotate, factorise);
criterion_main!(kernels);
