//! Gauss–Hermite quadrature on a tensor grid.

use super::points::TABLE_STATES;
use super::{Pairs, PointRule, RuleError, Shape};
use crate::scalar::Real;

/// pⁿ points, the roots of the probabilists' Hermite polynomial of degree p along every axis: exact for
/// monomials of degree 2p − 1 in each variable (Ito & Xiong 2000; Arasaratnam, Haykin & Elliott 2007).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GaussHermite {
    /// Points per axis, from 2 to 64.
    pub points: usize,
}

impl Default for GaussHermite {
    fn default() -> Self {
        Self { points: 3 }
    }
}

/// The most points along an axis.
const POINTS: usize = 64;

/// The largest grid for which a table is made.
const GRID: usize = 1 << 21;

impl GaussHermite {
    /// The sizes for a state of length `n`, as a constant.
    #[must_use]
    pub const fn shape_for(self, n: usize) -> Shape {
        self.half_grid(n).shape(n, if self.points % 2 == 1 { Some(1.0) } else { None })
    }

    /// pⁿ, or `usize::MAX` if it does not fit.
    const fn grid(self, n: usize) -> usize {
        self.points.saturating_pow(if n > TABLE_STATES { u32::MAX } else { n as u32 })
    }

    /// Node i of the grid and node pⁿ − 1 − i are opposite.
    const fn half_grid(self, n: usize) -> Pairs {
        Pairs::Table { count: self.grid(n) / 2, negative: 0 }
    }
}

impl PointRule for GaussHermite {
    fn check(&self, n: usize) -> Result<(), RuleError> {
        let value = self.points as f64;
        if !(2..=POINTS).contains(&self.points) {
            return Err(RuleError { option: "points", value, must: "must be from 2 to 64" });
        }
        if n > TABLE_STATES || self.grid(n) > GRID {
            let must = "the grid of points^n nodes (n: number of states) must not exceed 2^21; use fewer points, or \
                        a cubature rule";
            return Err(RuleError { option: "points", value, must });
        }
        Ok(())
    }
    fn centre(&self, n: usize) -> Option<f64> {
        // of a grid that is too large, sizes are asked for all the same: they want its sign
        let (points, axes) = (self.points.min(POINTS), n.min(TABLE_STATES));
        let own = weight(points, 0.0);
        (self.points % 2 == 1).then(|| (0..axes).fold(1.0, |product, _| product * own))
    }
    fn pairs(&self, n: usize) -> Pairs {
        self.half_grid(n)
    }
    fn pair(&self, l: usize, xi: &mut [f64]) -> f64 {
        let mut digits = l;
        let mut product = 1.0;
        for x in xi {
            *x = root(self.points, digits % self.points);
            product *= weight(self.points, *x);
            digits /= self.points;
        }
        product
    }
    /// The p roots and their weights are found once: a grid has pⁿ nodes.
    fn every_pair(&self, n: usize, xi: &mut [f64], put: &mut dyn FnMut(usize, &[f64], f64)) {
        let p = self.points;
        let (mut roots, mut weights) = ([0.0; POINTS], [0.0; POINTS]);
        let (Some(roots), Some(weights)) = (roots.get_mut(..p), weights.get_mut(..p)) else { return };
        for (i, (x, w)) in roots.iter_mut().zip(&mut *weights).enumerate() {
            *x = root(p, i);
            *w = weight(p, *x);
        }
        for l in 0..self.grid(n) / 2 {
            let (mut digits, mut product) = (l, 1.0);
            for x in &mut *xi {
                *x = roots[digits % p];
                product *= weights[digits % p];
                digits /= p;
            }
            put(l, xi, product);
        }
    }
}

/// Values at `x` of the Hermite polynomials of degree p − 1 and p, orthonormal for N(0, 1), the number of sign changes
/// along the degrees 0…p, which is the number of roots above x, and Σ h_k² over k < p.
fn hermite(p: usize, x: f64) -> (f64, f64, usize, f64) {
    let (mut before, mut here, mut changes, mut squares) = (0.0, 1.0, 0, 0.0);
    for k in 0..p {
        squares += here * here;
        let (k, next_k) = (k as f64, k as f64 + 1.0);
        let next = (x * here - Real::sqrt(k) * before) / Real::sqrt(next_k);
        changes += usize::from(next * here < 0.0 || (here == 0.0 && next * before < 0.0));
        before = here;
        here = next;
    }
    (before, here, changes, squares)
}

/// Root `index` of degree p, from the smallest; opposite roots are opposite to the bit.
fn root(p: usize, index: usize) -> f64 {
    if 2 * index + 1 == p {
        return 0.0;
    }
    if 2 * index + 1 < p {
        return -root(p, p - 1 - index);
    }
    // the roots lie within ±√(4p + 2); `index` of them lie below this one
    let above = p - 1 - index;
    let (mut low, mut high) = (0.0, Real::sqrt(4.0 * p as f64 + 2.0));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if hermite(p, middle).2 > above { low = middle } else { high = middle }
    }
    let mut x = 0.5 * (low + high);
    for _ in 0..3 {
        let (before, here, ..) = hermite(p, x);
        x -= here / (Real::sqrt(p as f64) * before);
    }
    x
}

/// The weight of root `x`: 1 / Σ_{k<p} h_k(x)².
fn weight(p: usize, x: f64) -> f64 {
    1.0 / hermite(p, x).3
}

#[cfg(test)]
mod tests {
    use super::{GaussHermite, root, weight};
    use crate::rule::PointRule;

    #[test]
    fn all_pairs_are_each_of_them() {
        for (points, n) in [(2, 1), (3, 4), (5, 3), (64, 2)] {
            let rule = GaussHermite { points };
            let (mut all, mut one) = ([0.0; 4], [0.0; 4]);
            let mut count = 0;
            rule.every_pair(n, &mut all[..n], &mut |l, xi, weight| {
                assert_eq!((l, weight), (count, rule.pair(l, &mut one[..n])));
                assert_eq!(xi, &one[..n]);
                count += 1;
            });
            assert_eq!(count, points.pow(n as u32) / 2);
        }
    }

    #[test]
    fn a_grid_beyond_all_memory_has_its_sizes_at_once() {
        for points in [3, usize::MAX] {
            let rule = GaussHermite { points };
            assert!(rule.centre(usize::MAX).is_some_and(|weight| weight >= 0.0));
            assert_eq!(crate::rule::Rule::shape(&rule, usize::MAX).points, usize::MAX);
        }
        let weight: f64 = GaussHermite::default().centre(2).unwrap_or(0.0);
        assert!((weight - 4.0 / 9.0).abs() < 1e-15);
    }

    #[test]
    fn three_points_are_zero_and_root_three() {
        assert!((root(3, 2) - 3.0f64.sqrt()).abs() < 1e-15 && root(3, 1) == 0.0);
        assert!(
            (weight(3, 0.0) - 2.0 / 3.0).abs() < 1e-15 && (weight(3, root(3, 0)) - 1.0 / 6.0).abs() < 1e-15
        );
    }

    #[test]
    fn sixty_four_points_integrate_the_hundredth_moment() {
        // E[x^100] = 99!!, relative
        let log_double_factorial: f64 = (1..=50).map(|k| f64::from(2 * k - 1).ln()).sum();
        let sum: f64 = (0..64)
            .map(|i| root(64, i))
            .map(|x| (weight(64, x).ln() + 100.0 * x.abs().ln() - log_double_factorial).exp())
            .sum();
        assert!((sum - 1.0).abs() < 1e-11, "{sum}");
    }
}
