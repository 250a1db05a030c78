//! The root of a covariance that is mostly the one of the time before.

use super::{Health, cholesky, outlined, sized};
use crate::scalar::{Mask, Real};

/// Scalars that [`cholesky_again`] keeps of an n × n covariance.
#[must_use]
pub const fn kept_root(n: usize) -> usize {
    n.saturating_mul(n).saturating_mul(2)
}

/// [`cholesky`], and again what it gave if the lower triangle of `a` (n × n) is that of the last call.
///
/// Most noises never change, and their root would be the larger part of some steps: its square roots and quotients wait for
/// one another. `kept` holds [`kept_root`] scalars, zero before the first call.
///
/// ```
/// use givens_core::kernels::{cholesky_again, kept_root};
/// let mut kept = [0.0; kept_root(2)];
/// for _ in 0..2 {
///     let mut p = [4.0, 2.0, 2.0, 3.0];
///     assert!(cholesky_again(&mut p, 2, &mut kept).failed().is_none());
///     assert_eq!((p[0], p[1], p[2]), (2.0, 0.0, 1.0));
/// }
/// ```
#[inline(always)]
pub fn cholesky_again<T: Real>(a: &mut [T], n: usize, kept: &mut [T]) -> Health<T> {
    let (cov, root) = kept.split_at_mut(n * n);
    if same_triangle(a, cov, n) {
        a.copy_from_slice(root);
        return Health::good();
    }
    cov.copy_from_slice(a);
    let health = cholesky(a, n);
    if health.sick.any() {
        // it is asked again
        cov[0] = T::of(f64::NAN);
    }
    root.copy_from_slice(a);
    health
}

outlined! {
    /// Whether the lower triangles are the same in every lane.
    fn same_triangle(a: &[T], b: &[T], n: usize) -> bool = triangle_is_same
}

#[inline(always)]
fn triangle_is_same<T: Real>(a: &[T], b: &[T], n: usize) -> bool {
    sized!(n => {
        for i in 0..n {
            let (a, b) = (&a[i * n..][..=i], &b[i * n..][..=i]);
            let mut same = T::Mask::splat(true);
            for j in 0..=i {
                same = same & a[j].same(b[j]);
            }
            if !same.all() {
                return false;
            }
        }
    });
    true
}

#[cfg(test)]
mod tests {
    use super::{cholesky_again, kept_root};

    #[test]
    fn a_root_is_worked_out_once() {
        let mut kept = [0.0; kept_root(2)];
        let root = |kept: &mut [f64], p: [f64; 4]| {
            let mut p = p;
            assert!(cholesky_again(&mut p, 2, kept).failed().is_none());
            p
        };
        assert_eq!(root(&mut kept, [4.0, 0.0, 2.0, 5.0]), [2.0, 0.0, 1.0, 2.0]);
        // what is kept is what comes back, until the triangle is another
        kept[4..].fill(7.0);
        assert_eq!(root(&mut kept, [4.0, 1.0, 2.0, 5.0]), [7.0; 4]);
        assert_eq!(root(&mut kept, [4.0, 1.0, 2.0, 10.0]), [2.0, 0.0, 1.0, 3.0]);
    }
}
