//! The rules made of weighted points: their unit points are data, and all of them share this spread.

use super::axes::Axes;
use super::table::from_table;
use super::{Rule, RuleError, Shape, Spread};
use crate::model::{At, Map};
use crate::scalar::Real;

/// The pairs ±ξ of a rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pairs {
    /// ±radius e_i, one pair along each axis, all of one positive weight 1/(2 radius²).
    Axes {
        /// The square of the points' distance from the mean, in standard deviations.
        radius2: f64,
        /// The weight of b² in the covariance, b being what the curvature moves the mean by: w^c₀ − w₀ − 1 + radius²/n,
        /// with the centre's weights in covariance and mean.
        bend: f64,
    },
    /// `count` pairs from [`PointRule::pair`], the last `negative` of them of negative weight.
    Table {
        /// Number of pairs.
        count: usize,
        /// How many of them, standing last, have a negative weight.
        negative: usize,
    },
}

impl Pairs {
    /// The sizes of a rule of these pairs for a state of length `n`. Of the weight of the point at the mean only the
    /// sign counts.
    #[must_use]
    pub const fn shape(self, n: usize, centre: Option<f64>) -> Shape {
        match self {
            Pairs::Axes { bend, .. } => Shape {
                table: 0,
                points: n.saturating_mul(2).saturating_add(1),
                plus: n.saturating_add((bend > 0.0) as usize),
                minus: (bend < 0.0) as usize,
            },
            Pairs::Table { count, negative } => {
                let (plus, minus) = match centre {
                    Some(weight) if weight < 0.0 => (0, 1),
                    Some(_) => (1, 0),
                    None => (0, 0),
                };
                Shape {
                    table: count.saturating_mul(n.saturating_add(2)),
                    points: count.saturating_mul(2).saturating_add(1),
                    plus: count.saturating_sub(negative).saturating_mul(2).saturating_add(plus),
                    minus: negative.saturating_mul(2).saturating_add(minus),
                }
            }
        }
    }
}

/// A rule that is a set of weighted unit points, symmetric about zero: E\[g\] ≈ Σ w_i g(m + S ξ_i).
///
/// The points integrate quadratics: Σ w_i ξ_i ξ_iᵀ = I. A new rule implements this trait and nothing else.
pub trait PointRule: Copy {
    /// What is wrong with the options for a state of length `n`, if anything.
    ///
    /// # Errors
    /// An option out of its range, named.
    fn check(&self, n: usize) -> Result<(), RuleError> {
        let _ = n;
        Ok(())
    }
    /// The weight of the point at the mean, if there is one.
    fn centre(&self, n: usize) -> Option<f64>;
    /// The pairs.
    fn pairs(&self, n: usize) -> Pairs;
    /// Writes the unit point ξ of pair `l` and returns its weight (that of each of the two).
    fn pair(&self, l: usize, xi: &mut [f64]) -> f64 {
        let _ = (l, xi);
        f64::NAN
    }
    /// Gives `put` every pair in order: its number, node and weight. `xi` has length n. A rule whose nodes take long to find
    /// may find them once for all.
    fn every_pair(&self, n: usize, xi: &mut [f64], put: &mut dyn FnMut(usize, &[f64], f64)) {
        let Pairs::Table { count, .. } = self.pairs(n) else { return };
        for l in 0..count {
            let weight = self.pair(l, xi);
            put(l, xi, weight);
        }
    }
}

/// The longest state for which a table of nodes is made.
pub(super) const TABLE_STATES: usize = 64;

impl<R: PointRule> Rule for R {
    fn check(&self, n: usize) -> Result<(), RuleError> {
        PointRule::check(self, n)
    }

    fn shape(&self, n: usize) -> Shape {
        self.pairs(n).shape(n, self.centre(n))
    }

    /// One standard deviation for a table: its points are near and far.
    fn reach(&self, n: usize) -> f64 {
        match self.pairs(n) {
            Pairs::Axes { radius2, .. } => Real::sqrt(radius2),
            Pairs::Table { .. } => 1.0,
        }
    }

    /// The table: weights w, scales √(2|w|), then the nodes axis by axis.
    fn tabulate<T: Real>(&self, n: usize, table: &mut [T]) {
        let Pairs::Table { count, .. } = self.pairs(n) else { return };
        let mut node = [0.0; TABLE_STATES];
        self.every_pair(n, &mut node[..n], &mut |l, xi, weight| {
            table[l] = T::of(weight);
            table[count + l] = T::of(Real::sqrt(2.0 * Real::abs(weight)));
            for (i, &x) in xi.iter().enumerate() {
                table[(2 + i) * count + l] = T::of(x);
            }
        });
    }

    #[inline(always)]
    fn spread<T: Real, G: Map>(
        &self,
        table: &[T],
        g: &G,
        at: &At<T>,
        mean: &[T],
        factor: &[T],
        out: &mut Spread<T>,
        scratch: &mut [T],
    ) {
        let n = mean.len();
        let centre = self.centre(n);
        match self.pairs(n) {
            Pairs::Axes { radius2, bend } => {
                Axes { radius2, bend, centred: centre.is_some() }.spread(g, at, mean, factor, out, scratch);
            }
            Pairs::Table { count, negative } => {
                from_table(table, count, negative, centre, g, at, mean, factor, out, scratch);
            }
        }
    }
}
