//! Third-degree spherical-radial cubature.

use super::{Pairs, PointRule};

/// 2n points ±√n e_i of weight 1/(2n): exact for all monomials of degree 3 (2009 §IV-D).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cubature3;

impl PointRule for Cubature3 {
    fn centre(&self, _: usize) -> Option<f64> {
        None
    }
    fn pairs(&self, n: usize) -> Pairs {
        Pairs::Axes { radius: crate::scalar::Real::sqrt(n as f64), bend: 0.0 }
    }
}
