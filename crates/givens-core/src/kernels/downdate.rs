//! Downdate of a triangular factor by one column.

use super::rest::{errors_above, norm};
use super::{Health, outlined};
use crate::scalar::{Mask, Real};

outlined! {
    /// L with L Lᵀ − v vᵀ in place of L Lᵀ, L lower triangular n × n in rows of length `stride` (docs/algorithms.md §2).
    ///
    /// `v` (length n) is used up, and the triangle above the diagonal, which must be zero, stays so. The square of pivot k
    /// is r² = L_kk² − v_k², known to τ = e max(L_kk, |v_k|), where e is 64 ε ‖row k‖ and what the errors of the rows
    /// above have made of it: below −τ it is the failure that health names; within τ of zero the column is zero and the
    /// downdate ends. A pivot that v_k is less than half of loses nothing by it, however small it is, and goes on. Where L_kk
    /// and v_k are themselves zero to rounding, or their squares are and what stands below them differs, what stands below L_kk
    /// is rotated into the columns after it, and the downdate goes on with the next row.
    ///
    /// ```
    /// use givens_core::kernels::downdate;
    /// let mut l = [5.0];
    /// assert!(downdate(&mut l, 1, 1, &mut [3.0]).failed().is_none());
    /// assert_eq!(l[0], 4.0);
    /// assert_eq!(downdate(&mut l, 1, 1, &mut [4.1]).failed(), Some(0));
    /// ```
    pub fn downdate(l: &mut [T], n: usize, stride: usize, v: &mut [T]) -> Health<T> = downdated
}

#[inline(always)]
fn downdated<T: Real>(l: &mut [T], n: usize, stride: usize, v: &mut [T]) -> Health<T> {
    let mut health = Health::good();
    let (zero, one) = (T::zero(), T::one());
    for k in 0..n {
        let (pivot, vk) = (l[k * stride + k], v[k]);
        let untouched = vk.same(zero);
        let mut own = norm(&l[k * stride..=k * stride + k]);
        let r2 = (pivot - vk) * (pivot + vk);
        let cancels_much = !untouched & !(T::of(1e-6) * own * own).lt(r2);
        if cancels_much.any() {
            let above = errors_above(l, stride, k, |_, row| norm(row));
            own = T::select(cancels_much, own + above, own);
        }
        let size = pivot.max(vk.abs());
        let rounding = T::of(64.0 * T::EPSILON) * own;
        // of a pivot that hardly changes, nothing cancels: rounding beside its row is no reason to take it for zero
        let cancels = !(vk.abs() + vk.abs()).lt(pivot);
        let mut absent = size.le(rounding) & cancels;
        let mut spent = r2.abs().le(rounding * size) & cancels & !untouched & !absent;
        if spent.any() {
            let torn = spent & torn(l, n, stride, k, v) & (size * size).le(rounding * own);
            (absent, spent) = (absent | torn, spent & !torn);
        }
        if absent.any() {
            fold(l, n, stride, k, absent);
        }
        let negative = !(-(rounding * size)).le(r2) | !r2.finite();
        health.note(!untouched & !absent & negative, k);
        let cleared = spent | absent;
        let still = cleared | untouched;
        let r = T::select(cleared, zero, T::select(untouched, pivot, r2.sqrt()));
        let c = T::select(still, one, r / pivot);
        let s = T::select(still, zero, vk / pivot);
        let side = one.copysign(vk);
        l[k * stride + k] = r;
        for i in k + 1..n {
            let below = l[i * stride + k];
            // a zero square of the pivot forces a zero column: |A_ik|² ≤ A_kk A_ii, A_kk = r² and A_ik = L_kk · left
            let left = (below - side * v[i]).abs();
            let mut row_norm = v[i].abs();
            for &x in &l[i * stride..=i * stride + i] {
                row_norm = row_norm.max(x.abs());
            }
            let allowed = (rounding / size).sqrt() * (row_norm + row_norm);
            health.note(spent & !left.le(allowed), k);
            let x = (below - s * v[i]) / c;
            v[i] = T::select(spent, zero, c * v[i] - s * x);
            l[i * stride + k] = T::select(cleared, zero, x);
        }
        v[k] = zero;
    }
    health
}

/// Whether what stands below pivot k does not go with it: such a pivot, where its square is rounding, is noise, and what stands
/// below it is none.
#[inline(never)]
fn torn<T: Real>(l: &[T], n: usize, stride: usize, k: usize, v: &[T]) -> T::Mask {
    let (side, mut torn) = (T::one().copysign(v[k]), T::Mask::splat(false));
    for i in k + 1..n {
        let below = l[i * stride + k];
        torn = torn | (T::of(0.5) * below.abs()).lt((below - side * v[i]).abs());
    }
    torn
}

/// Rotates what stands below pivot k into the columns after it, in the lanes of `absent`: that of a pivot of rounding may
/// be as large as any other column.
#[inline(never)]
fn fold<T: Real>(l: &mut [T], n: usize, stride: usize, k: usize, absent: T::Mask) {
    for i in k + 1..n {
        let below = T::select(absent, l[i * stride + k], T::zero());
        let still = below.same(T::zero());
        if still.all() {
            continue;
        }
        let diagonal = l[i * stride + i];
        let norm = diagonal.hypot(below);
        let (c, s) = (T::select(still, T::one(), diagonal / norm), T::select(still, T::zero(), below / norm));
        for row in l.chunks_mut(stride).take(n).skip(i) {
            let (x, y) = (row[i], row[k]);
            row[i] = s.mul_add(y, c * x);
            row[k] = c * y - s * x;
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_pivot_of_rounding_does_not_take_its_column_with_it() {
        let mut l = [1.0_f64, 0.0, 0.0, 2.0, 1e-17, 0.0, 3.0, 4.0, 5.0];
        let mut v = [0.0, 1e-17, 1.0];
        assert!(super::downdate(&mut l, 3, 3, &mut v).failed().is_none());
        assert_eq!((l[4], l[7]), (0.0, 0.0));
        // the variance of the last row, 9 + 16 + 25, less 1
        assert!((l[6] * l[6] + l[8] * l[8] - 49.0).abs() < 1e-13);
    }

    // what a measurement leaves of a prior that is a hundred thousand times as wide, and a column of rounding
    #[test]
    fn a_small_pivot_that_loses_nothing_stays() {
        for v in [[0.0, 0.0], [0.0, 1e-7], [1e-4_f32, 1e-4]] {
            let (mut l, mut column) = ([1.0_f32, 0.0, 1.0, 1e-5], v);
            assert!(super::downdate(&mut l, 2, 2, &mut column).failed().is_none());
            assert!((l[3] / 1e-5 - 1.0).abs() < 1e-3, "{v:?}: {l:?}");
        }
    }

    // a position known but for its way within a short gap, whose points' rounding is larger than that, and its speed
    #[test]
    fn a_pivot_of_noise_does_not_take_its_column_with_it() {
        for noise in [0.9e-4_f32, 1e-4, -1.1e-4] {
            let mut l = [3.0_f32, 0.0, 0.0, 2.0, 1e-4, 0.0, 0.5, 0.02, 0.01];
            let mut v = [0.0, noise, 1e-6];
            assert!(super::downdate(&mut l, 3, 3, &mut v).failed().is_none());
            let left = l[7] * l[7] + l[8] * l[8];
            assert!((left - 5e-4).abs() < 1e-6, "{noise}: {l:?}");
        }
    }

    #[test]
    fn a_zero_pivot_of_both_ends_its_column_only() {
        let mut l = [0.0_f64, 0.0, 0.0, 2.0];
        let mut v = [0.0, 1.0];
        assert!(super::downdate(&mut l, 2, 2, &mut v).failed().is_none());
        assert!((l[3] - 3.0f64.sqrt()).abs() < 1e-15);
    }
    #[test]
    fn a_column_that_does_not_cancel_is_a_failure_whatever_its_sign() {
        // [1 1; 1 2] − [1 −1; −1 1] = [0 2; 2 1]
        assert_eq!(super::downdate(&mut [1.0, 0.0, 1.0, 1.0], 2, 2, &mut [1.0, -1.0]).failed(), Some(0));
        let mut l = [1.0, 0.0, -1.0, 1.0];
        assert!(super::downdate(&mut l, 2, 2, &mut [-1.0, 1.0]).failed().is_none());
        assert_eq!(l, [0.0, 0.0, 0.0, 1.0]);
    }

    #[test]
    fn units_do_not_decide_what_is_zero() {
        for unit in [1e-9, 1.0, 1e9] {
            let fails = |left: f64| {
                let mut v = [unit, unit * (1.0 - left)];
                super::downdate(&mut [unit, 0.0, unit, unit], 2, 2, &mut v).failed().is_some()
            };
            assert!(!fails(1e-8) && fails(1e-5), "{unit}");
        }
    }
}
