//! Fifth-degree spherical-radial cubature.

use super::points::TABLE_STATES;
use super::{Pairs, PointRule, RuleError, Shape};
use crate::scalar::Real;

/// 2n² + 1 points: the mean, √(n+2) (±e_j ± e_k)/√2 and ±√(n+2) e_i; exact for all monomials of degree 5
/// (2009 §V; Jia, Xin & Cheng 2013). The points along the axes have negative weights from n = 5 on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cubature5;

impl Cubature5 {
    /// The sizes for a state of length `n`, as a constant.
    #[must_use]
    pub const fn shape_for(self, n: usize) -> Shape {
        Self::table(n).shape(n, Some(1.0))
    }

    /// First the n (n − 1) pairs between two axes, then those along an axis; at n = 4 these weigh nothing.
    const fn table(n: usize) -> Pairs {
        let between = n.saturating_mul(n.saturating_sub(1));
        match n {
            0..4 => Pairs::Table { count: between + n, negative: 0 },
            4 => Pairs::Table { count: between, negative: 0 },
            _ => Pairs::Table { count: between.saturating_add(n), negative: n },
        }
    }
}

impl PointRule for Cubature5 {
    fn check(&self, n: usize) -> Result<(), RuleError> {
        if n > TABLE_STATES {
            let must = "cubature5 (ckf5) holds a table of 2 n^2 + 1 points, for at most 64 states; cubature3 (ckf) serves any \
                        number";
            return Err(RuleError { option: "rule", value: n as f64, must });
        }
        Ok(())
    }
    fn centre(&self, n: usize) -> Option<f64> {
        Some(2.0 / (n as f64 + 2.0))
    }
    fn pairs(&self, n: usize) -> Pairs {
        Self::table(n)
    }
    fn pair(&self, l: usize, xi: &mut [f64]) -> f64 {
        let n = xi.len();
        let r2 = n as f64 + 2.0;
        xi.fill(0.0);
        let between = n * (n - 1);
        if l >= between {
            xi[l - between] = Real::sqrt(r2);
            return (4.0 - n as f64) / (2.0 * r2 * r2);
        }
        // the pairs (j, k), j < k, come twice in a row: e_j + e_k and e_j − e_k
        let (mut j, mut left) = (0, l / 2);
        while left >= n - 1 - j {
            left -= n - 1 - j;
            j += 1;
        }
        xi[j] = Real::sqrt(0.5 * r2);
        xi[j + 1 + left] = if l.is_multiple_of(2) { xi[j] } else { -xi[j] };
        1.0 / (r2 * r2)
    }
}
