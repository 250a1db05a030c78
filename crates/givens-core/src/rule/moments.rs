//! Sums over the pairs of a rule of many points, in four sums side by side: their additions need not wait for each other.

use crate::scalar::Real;

/// Σ w ((y₊ − near) + (y₋ − near)).
#[inline(always)]
pub(super) fn even_moment<T: Real>(weights: &[T], plus: &[T], minus: &[T], near: T) -> T {
    sums(weights, plus, minus, plus, |w, p, m, _, sum| w.mul_add((p - near) + (m - near), sum))
}

/// Σ w (y₊ − y₋) ξ.
#[inline(always)]
pub(super) fn odd_moment<T: Real>(weights: &[T], plus: &[T], minus: &[T], xi: &[T]) -> T {
    sums(weights, plus, minus, xi, |w, p, m, xi, sum| (w * (p - m)).mul_add(xi, sum))
}

/// All four are of one length.
#[inline(always)]
fn sums<T: Real>(w: &[T], p: &[T], m: &[T], x: &[T], add: impl Fn(T, T, T, T, T) -> T) -> T {
    let mut sums = [T::zero(); 4];
    let ((w, rest_w), (p, rest_p)) = (w.as_chunks::<4>(), p.as_chunks::<4>());
    let ((m, rest_m), (x, rest_x)) = (m.as_chunks::<4>(), x.as_chunks::<4>());
    for (((w, p), m), x) in w.iter().zip(p).zip(m).zip(x) {
        for k in 0..4 {
            sums[k] = add(w[k], p[k], m[k], x[k], sums[k]);
        }
    }
    for (k, (((&w, &p), &m), &x)) in rest_w.iter().zip(rest_p).zip(rest_m).zip(rest_x).enumerate() {
        sums[k] = add(w, p, m, x, sums[k]);
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}
