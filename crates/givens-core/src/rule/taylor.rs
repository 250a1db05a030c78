//! First-order Taylor expansion by exact derivatives: the extended Kalman filter's rule.

use super::{Rule, RuleError, Shape, Spread};
use crate::model::{At, Linear, Map};
use crate::scalar::Real;

/// E\[g\] ≈ g(m), D = J S with J = ∂g/∂x at m: exact for linear maps. An angle is wrapped in the innovation only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Taylor;

impl Taylor {
    /// The sizes for a state of length `n`, as a constant.
    #[must_use]
    pub const fn shape_for(self, _: usize) -> Shape {
        Shape { table: 0, points: 0, plus: 0, minus: 0 }
    }
}

impl Rule for Taylor {
    const FIRST_ORDER: bool = true;

    fn check(&self, _: usize) -> Result<(), RuleError> {
        Ok(())
    }

    fn shape(&self, n: usize) -> Shape {
        self.shape_for(n)
    }

    fn reach(&self, _: usize) -> f64 {
        f64::INFINITY
    }

    fn tabulate<T: Real>(&self, _: usize, _: &mut [T]) {}

    #[inline(always)]
    fn spread<T: Real, G: Map>(
        &self,
        _: &[T],
        g: &G,
        at: &At<T>,
        mean: &[T],
        factor: &[T],
        out: &mut Spread<T>,
        scratch: &mut [T],
    ) {
        let linear = Linear { value: &mut *out.mean, image: &mut *out.dev, stride: out.stride };
        g.linear(at, mean, factor, linear, scratch);
    }
}
