//! Stirling's interpolation: central differences of second order.

use super::axes::lay_points;
use super::pairs::evaluate;
use super::{Rule, RuleError, Shape, Spread};
use crate::model::{At, Map};
use crate::scalar::Real;

/// Points 0 and ±η along the axes, combined as divided differences (Nørgaard, Poulsen & Ravn 2000; Ito & Xiong 2000).
/// It is no weighted set of points: its covariance never subtracts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentralDifference {
    /// The step η, in standard deviations, from 1 to 10⁹; √3 suits a Gaussian.
    pub eta: f64,
}

impl Default for CentralDifference {
    fn default() -> Self {
        Self { eta: 1.732_050_807_568_877_2 }
    }
}

impl CentralDifference {
    /// The sizes for a state of length `n`, as a constant.
    #[must_use]
    pub const fn shape_for(self, n: usize) -> Shape {
        Shape { table: 0, points: n.saturating_mul(2).saturating_add(1), plus: n, minus: 0 }
    }
}

impl Rule for CentralDifference {
    fn check(&self, _: usize) -> Result<(), RuleError> {
        // further points overflow
        if (1.0..=1e9).contains(&self.eta) {
            return Ok(());
        }
        Err(RuleError { option: "eta", value: self.eta, must: "must be at least 1, and at most 1e9" })
    }

    fn shape(&self, n: usize) -> Shape {
        self.shape_for(n)
    }

    fn reach(&self, _: usize) -> f64 {
        self.eta
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
        let n = mean.len();
        let eta2 = self.eta * self.eta;
        let lay = |x: &mut [T], points: usize| lay_points(x, points, mean, factor, self.eta);
        let images = evaluate(g, at, n, n, true, lay, scratch);
        let (odd, half_bend) = (T::of(0.5 / self.eta), T::of(0.5 / eta2));
        let even = T::of(Real::sqrt(eta2 - 1.0) / (2.0 * eta2));
        for i in 0..g.outputs() {
            let (plus, minus, centre) = images.row(i);
            let y0 = centre.unwrap_or(plus[0]);
            let row = &mut out.dev[i * out.stride..(i + 1) * out.stride];
            let mut ybar = y0;
            for l in 0..n {
                let bend = (plus[l] - y0) + (minus[l] - y0);
                ybar = half_bend.mul_add(bend, ybar);
                row[l] = odd * (plus[l] - minus[l]);
                if let Some(second) = row.get_mut(n + l) {
                    *second = even * bend;
                }
            }
            out.mean[i] = ybar;
        }
    }
}
