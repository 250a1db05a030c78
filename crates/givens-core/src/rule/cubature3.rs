//! Third-degree spherical-radial cubature.

use super::{Pairs, PointRule, Shape};

/// 2n points ±√n e_i of weight 1/(2n): exact for all monomials of degree 3 (2009 §IV-D).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cubature3;

impl Cubature3 {
    /// The sizes for a state of length `n`, as a constant.
    #[must_use]
    pub const fn shape_for(self, n: usize) -> Shape {
        Self::axes(n).shape(n, None)
    }

    const fn axes(n: usize) -> Pairs {
        Pairs::Axes { radius2: n as f64, bend: 0.0 }
    }
}

impl PointRule for Cubature3 {
    fn centre(&self, _: usize) -> Option<f64> {
        None
    }
    fn pairs(&self, n: usize) -> Pairs {
        Self::axes(n)
    }
}
