//! Rules: how the moments of g(x), x ~ N(m, S Sᵀ), are computed (docs/algorithms.md §3).
//!
//! Every rule answers with a [`Spread`]: the mean of g, the part D of its spread that moves with S, and the rest E,
//! so that cov(g) = D Dᵀ + E J Eᵀ and cov(x, g) = S Dᵀ, J the signs of the rest's columns. For a rule of points, D is
//! its weighted-centred image times the unit points and E what that leaves; the image's X is then [S 0] for every
//! rule, and no deviation of the state is ever formed.

mod axes;
mod central_difference;
mod cubature3;
mod cubature5;
mod gauss_hermite;
mod moments;
mod pairs;
mod points;
mod table;
mod taylor;
mod unscented;

pub use central_difference::CentralDifference;
pub use cubature3::Cubature3;
pub use cubature5::Cubature5;
pub use gauss_hermite::GaussHermite;
pub use points::{Pairs, PointRule};
pub use taylor::Taylor;
pub use unscented::Unscented;

use crate::kernels::{outlined, plus_magnitudes};
use crate::model::{At, Map, SLACK};
use crate::scalar::{Mask, Real, Shown};

/// The sizes that a rule needs for a state of length n.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Scalars of its table of nodes and weights.
    pub table: usize,
    /// Points at which g is evaluated, the one that angles are referred to included.
    pub points: usize,
    /// Columns of E of positive weight.
    pub plus: usize,
    /// Columns of E of negative weight.
    pub minus: usize,
}

/// What a rule learns of y = g(x), written into the caller's memory.
#[derive(Debug)]
pub struct Spread<'a, T> {
    /// E\[g\], length d.
    pub mean: &'a mut [T],
    /// d rows of length `stride`: D in columns 0…n, the positive columns of E behind it; the caller's own beyond. With a
    /// stride of n, D alone: E is then not computed.
    pub dev: &'a mut [T],
    /// Length of a row of `dev`.
    pub stride: usize,
    /// The negative columns of E, d rows of length [`Shape::minus`].
    pub minus: &'a mut [T],
}

impl<T: Real> Spread<'_, T> {
    /// The first component, if any, that is not finite in every lane; `columns` = n + plus.
    #[inline(always)]
    pub fn not_finite(&self, columns: usize) -> Option<usize> {
        first_wild(self.mean, self.dev, self.stride, columns)
    }
}

outlined! {
    fn first_wild(mean: &[T], dev: &[T], stride: usize, columns: usize) -> Option<usize> = first_wild_row
}

#[inline(always)]
fn first_wild_row<T: Real>(mean: &[T], dev: &[T], stride: usize, columns: usize) -> Option<usize> {
    for (i, (&mean, row)) in mean.iter().zip(dev.chunks_exact(stride)).enumerate() {
        let (quads, rest) = row[..columns].as_chunks::<4>();
        let mut sums = [mean.abs(), T::zero(), T::zero(), T::zero()];
        for quad in quads {
            for k in 0..4 {
                sums[k] += quad[k].abs();
            }
        }
        let sum = plus_magnitudes((sums[0] + sums[1]) + (sums[2] + sums[3]), rest);
        if (!sum.finite()).all() {
            return Some(i);
        }
    }
    None
}

/// A rule: plain data, its options and nothing else.
pub trait Rule: Copy {
    /// What is wrong with the options for a state of length `n`, if anything.
    ///
    /// # Errors
    /// An option out of its range, named.
    fn check(&self, n: usize) -> Result<(), RuleError>;

    /// The sizes for a state of length `n`.
    fn shape(&self, n: usize) -> Shape;

    /// D is J S with J = ∂g/∂x at the mean, whatever the root.
    const FIRST_ORDER: bool = false;

    /// How far along an axis the points stand from the mean, in standard deviations; infinite if the rule has no points.
    fn reach(&self, n: usize) -> f64;

    /// Writes the table of nodes and weights, once per filter.
    fn tabulate<T: Real>(&self, n: usize, table: &mut [T]);

    /// Pushes N(`mean`, S Sᵀ) through `g`; S = `factor` is lower triangular n × n.
    /// `scratch` holds [`spread_scratch`] scalars.
    fn spread<T: Real, G: Map>(
        &self,
        table: &[T],
        g: &G,
        at: &At<T>,
        mean: &[T],
        factor: &[T],
        out: &mut Spread<T>,
        scratch: &mut [T],
    );
}

/// Scalars of scratch that a spread needs: n inputs, d outputs, `map` of the map's own.
#[must_use]
pub const fn spread_scratch(shape: Shape, n: usize, d: usize, map: usize) -> usize {
    (n + d) * (shape.points + SLACK) + SLACK + map
}

/// An option of a rule that is out of its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RuleError {
    /// The option's registry name; `rule` if it is the rule itself that cannot serve.
    pub option: &'static str,
    /// Its value; the number of states for `rule`.
    pub value: f64,
    /// What it must be.
    pub must: &'static str,
}

impl core::fmt::Display for RuleError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        if self.option == "rule" {
            return write!(f, "{} states: {}", self.value, self.must);
        }
        write!(f, "{} = {}: {}", self.option, Shown(self.value), self.must)
    }
}

impl core::error::Error for RuleError {}
