//! General square matrices: factors L and U with exchanged rows, and division by the matrix.

use super::less_dot;
use super::rest::norm;
use super::solve::inverse_or_zero;
use super::{Health, outlined};
use crate::scalar::{Mask, Real};

/// Scalars of `order` in [`lu`]: which rows were exchanged, and how long they were.
#[must_use]
pub const fn lu_order(n: usize) -> usize {
    n.saturating_mul(2)
}

outlined! {
    /// P A = L U in place, for any A, n × n: U on and above the diagonal, L, whose diagonal is one, below. `order` has
    /// [`lu_order`] scalars and keeps the exchanges of rows for [`lu_solve`].
    ///
    /// The pivot is the largest left of its column, against the length of its row, so that a change of the units of the
    /// rows changes nothing; with several lanes it is chosen by the first. Health names a pivot that is zero within the
    /// rounding of the numbers whose difference it is (docs/algorithms.md K6); those lanes end in NaN.
    ///
    /// ```
    /// use givens_core::kernels::{lu, lu_solve};
    /// let (mut a, mut order, mut b) = ([0.0, 2.0, 4.0, 1.0], [0.0; 4], [2.0, 9.0]);
    /// assert!(lu(&mut a, 2, &mut order).failed().is_none());
    /// lu_solve(&a, 2, &order, &mut b);
    /// assert_eq!(b, [2.0, 1.0]);
    /// assert_eq!(lu(&mut [1.0, 3.0, 2.0, 6.0], 2, &mut order).failed(), Some(1));
    /// ```
    pub fn lu(a: &mut [T], n: usize, order: &mut [T]) -> Health<T> = eliminated
}

#[inline(always)]
fn eliminated<T: Real>(a: &mut [T], n: usize, order: &mut [T]) -> Health<T> {
    let mut health = Health::<T>::good();
    let (order, scale) = order.split_at_mut(n);
    for i in 0..n {
        scale[i] = inverse_or_zero(norm(&a[i * n..][..n]));
    }
    let tolerance = T::of(n as f64 * T::EPSILON);
    for k in 0..n {
        let mut best = k;
        for i in k + 1..n {
            let (this, that) = (a[i * n + k].abs() * scale[i], a[best * n + k].abs() * scale[best]);
            if this.first() > that.first() {
                best = i;
            }
        }
        order[k] = T::of(best as f64);
        if best != k {
            let (head, tail) = a.split_at_mut(best * n);
            head[k * n..][..n].swap_with_slice(&mut tail[..n]);
            scale.swap(k, best);
        }
        let pivot = a[k * n + k];
        // the pivot is what is left after subtracting these
        let mut size = T::zero();
        for j in 0..k {
            size = (a[k * n + j] * a[j * n + k]).abs() + size;
        }
        health.note(!(tolerance * size).lt(pivot.abs()), k);
        let inverse = inverse_or_zero(pivot);
        let (head, tail) = a.split_at_mut((k + 1) * n);
        let row = &head[k * n..];
        for below in tail.chunks_exact_mut(n) {
            let multiple = below[k] * inverse;
            below[k] = multiple;
            for (x, &u) in below[k + 1..].iter_mut().zip(&row[k + 1..]) {
                *x = (-multiple).mul_add(u, *x);
            }
        }
    }
    if health.sick.any() {
        a[0] = T::select(health.sick, T::of(f64::NAN), a[0]);
    }
    health
}

/// A⁻¹ b in place, from the factors and the order that [`lu`] leaves.
#[inline(always)]
pub fn lu_solve<T: Real>(a: &[T], n: usize, order: &[T], b: &mut [T]) {
    for k in 0..n {
        b.swap(k, order[k].first() as usize);
    }
    for i in 1..n {
        b[i] = less_dot(b[i], &a[i * n..][..i], b);
    }
    for i in (0..n).rev() {
        let row = &a[i * n..][..n];
        let rest = less_dot(b[i], &row[i + 1..], &b[i + 1..]);
        b[i] = rest / row[i];
    }
}

/// A⁻ᵀ b in place, from the factors and the order that [`lu`] leaves.
#[inline(always)]
pub fn lu_solve_transposed<T: Real>(a: &[T], n: usize, order: &[T], b: &mut [T]) {
    for i in 0..n {
        let x = b[i] / a[i * n + i];
        b[i] = x;
        for (rest, &u) in b[i + 1..].iter_mut().zip(&a[i * n + i + 1..]) {
            *rest = (-x).mul_add(u, *rest);
        }
    }
    for i in (1..n).rev() {
        let x = b[i];
        for (rest, &l) in b[..i].iter_mut().zip(&a[i * n..]) {
            *rest = (-x).mul_add(l, *rest);
        }
    }
    for k in (0..n).rev() {
        b.swap(k, order[k].first() as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::{lu, lu_order, lu_solve, lu_solve_transposed};

    /// A matrix without structure, rows in units from 1e-9 to 1e9.
    fn matrix<const N: usize>(seed: u64) -> [[f64; N]; N] {
        let mut state = seed;
        core::array::from_fn(|i| {
            let unit = 10.0_f64.powf(9.0 - ((i * 7) % 19) as f64);
            core::array::from_fn(|_| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                unit * ((state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0)
            })
        })
    }

    #[test]
    fn both_divisions_undo_a_product_whatever_the_units_of_the_rows() {
        const N: usize = 7;
        for seed in 0..50 {
            let full = matrix::<N>(seed);
            let x: [f64; N] = core::array::from_fn(|i| i as f64 - 2.5);
            let mut a = full.concat();
            let mut order = [0.0; lu_order(N)];
            assert!(lu(&mut a, N, &mut order).failed().is_none());
            let mut b: [f64; N] = full.map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum());
            lu_solve(&a, N, &order, &mut b);
            // the same division of the transpose, each in the units of x
            let scaled: [f64; N] = core::array::from_fn(|i| x[i] / full[i][0].abs());
            let mut c: [f64; N] = core::array::from_fn(|j| (0..N).map(|i| full[i][j] * scaled[i]).sum());
            lu_solve_transposed(&a, N, &order, &mut c);
            for i in 0..N {
                assert!((b[i] - x[i]).abs() < 1e-11, "seed {seed}: {b:?}");
                assert!((c[i] / scaled[i] - 1.0).abs() < 1e-9, "seed {seed}: {i} {c:?}");
            }
        }
    }

    #[test]
    fn a_pivot_is_the_largest_of_its_column_against_the_length_of_its_row() {
        const N: usize = 7;
        for seed in 0..50 {
            let full = matrix::<N>(seed);
            let (mut a, mut order) = (full.concat(), [0.0; lu_order(N)]);
            assert!(lu(&mut a, N, &mut order).failed().is_none());
            let mut lengths = full.map(|row| row.iter().map(|x| x * x).sum::<f64>().sqrt());
            for (k, &other) in order[..N].iter().enumerate() {
                lengths.swap(k, other as usize);
            }
            // L below the diagonal: what was left of its column, against the pivot
            for (i, k) in (0..N).flat_map(|i| (0..i).map(move |k| (i, k))) {
                let against = a[i * N + k].abs() * lengths[k] / lengths[i];
                assert!(against < 1.0 + 1e-12, "seed {seed}: {i} {k} {against}");
            }
        }
    }

    #[test]
    fn a_row_that_depends_on_the_others_is_a_zero_pivot_and_large_units_are_not() {
        let mut order = [0.0; 6];
        let thirds = [1.0 / 3.0, 0.7, 1e8, 0.1, -0.3, 2e8, 1.0 / 3.0 + 0.1, 0.4, 3e8];
        assert_eq!(lu(&mut thirds.clone(), 3, &mut order).failed(), Some(2));
        assert_eq!(lu(&mut [1.0, 1e17, 0.0, 1.0], 2, &mut order[..4]).failed(), None);
        assert_eq!(lu(&mut [0.0, 1.0, 0.0, 1.0], 2, &mut order[..4]).failed(), Some(0));
        assert_eq!(lu(&mut [f64::NAN, 1.0, 0.0, 1.0], 2, &mut order[..4]).failed(), Some(0));
    }
}
