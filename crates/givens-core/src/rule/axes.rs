//! The spread of a rule with one pair of points along each axis.

use super::Spread;
use super::pairs::{Images, evaluate};
use crate::kernels::{outlined, sized};
use crate::model::{At, Map};
use crate::scalar::Real;

/// What tells such rules apart: see [`Pairs::Axes`](super::Pairs).
#[derive(Clone, Copy)]
pub(super) struct Axes {
    pub radius2: f64,
    pub bend: f64,
    pub centred: bool,
}

impl Axes {
    #[inline(always)]
    pub fn spread<T: Real, G: Map>(
        self,
        g: &G,
        at: &At<T>,
        mean: &[T],
        factor: &[T],
        out: &mut Spread<T>,
        scratch: &mut [T],
    ) {
        let n = mean.len();
        let lay = |x: &mut [T], points: usize| lay_points(x, points, mean, factor, self.radius());
        let images = evaluate(g, at, n, n, self.centred, lay, scratch);
        gather(&images, self, out);
    }

    fn radius(self) -> f64 {
        Real::sqrt(self.radius2)
    }
}

outlined! {
    /// The points m + radius S e_l, then m − radius S e_l, then m, in rows of length `points`.
    pub(super) fn lay_points(x: &mut [T], points: usize, mean: &[T], factor: &[T], radius: f64) -> () = points_laid
}

#[inline(always)]
fn points_laid<T: Real>(x: &mut [T], points: usize, mean: &[T], factor: &[T], radius: f64) {
    let (n, rho) = (mean.len(), T::of(radius));
    sized!(n => for i in 0..n {
        let row = &mut x[i * points..][..points];
        let (plus, rest) = row.split_at_mut(n);
        let (minus, centre) = rest.split_at_mut(n);
        let (m, s) = (mean[i], &factor[i * n..][..n]);
        for l in 0..n {
            let step = rho * s[l];
            (plus[l], minus[l]) = (m + step, m - step);
        }
        for centre in centre {
            *centre = m;
        }
    });
}

outlined! {
    /// D_i = (y₊ − y₋)/(2 radius), E_i = (δ_i − δ̄)/radius with δ_i = (y₊ + y₋)/2 − y₀ and δ̄ the mean of all δ_i, and one
    /// column √|bend| b with b = ȳ − y₀ = n δ̄/radius².
    ///
    /// That is the centre's column and the deviations (y − ȳ) rearranged, so that weights of opposite sign do not meet:
    /// Σ (δ_i − b)²/radius² + w^c₀ b² = Σ (δ_i − δ̄)²/radius² + bend b². Only a negative `bend` needs a downdate, and small
    /// α do not cancel.
    fn gather(images: &Images<'_, T>, axes: Axes, out: &mut Spread<'_, T>) -> () = gathered
}

#[inline(always)]
fn gathered<T: Real>(images: &Images<T>, axes: Axes, out: &mut Spread<T>) {
    let Axes { radius2, bend, centred } = axes;
    let (n, radius) = (images.pairs, axes.radius());
    // without a centre, n/radius² = 1
    let shift = if centred { n as f64 / radius2 } else { 1.0 };
    let (share, shift) = (T::of(1.0 / n as f64), T::of(shift));
    let (odd, even) = (T::of(0.5 / radius), T::of(1.0 / radius));
    let curvature = T::of(Real::sqrt(Real::abs(bend)));
    sized!(n => for (i, mean) in out.mean.iter_mut().enumerate() {
        let (plus, minus, at_mean) = images.row(i);
        let (plus, minus) = (&plus[..n], &minus[..n]);
        // a component without spread must have no deviation, not one of rounding, which would pass for a direction
        let near = if centred { at_mean.unwrap_or(plus[0]) } else { plus[0] };
        let row = &mut out.dev[i * out.stride..][..out.stride];
        let mut sum = T::zero();
        for block in (0..n).step_by(BLOCK) {
            let len = BLOCK.min(n - block);
            let (plus, minus) = (&plus[block..][..len], &minus[block..][..len]);
            // all are read before one is written: they may then be worked out side by side
            let (mut away, mut middles) = ([T::zero(); BLOCK], [T::zero(); BLOCK]);
            for l in 0..len {
                away[l] = odd * (plus[l] - minus[l]);
                middles[l] = middle(plus[l], minus[l], near);
            }
            for l in 0..len {
                sum += middles[l];
            }
            row[block..][..len].copy_from_slice(&away[..len]);
            if row.len() >= 2 * n {
                row[n + block..][..len].copy_from_slice(&middles[..len]);
            }
        }
        let average = share * sum;
        let b = shift * average;
        *mean = near + b;
        if out.stride == n {
            continue;
        }
        for even_part in &mut row[n..2 * n] {
            *even_part = even * (*even_part - average);
        }
        if bend > 0.0 {
            row[2 * n] = curvature * b;
        } else if bend < 0.0 {
            out.minus[i] = curvature * b;
        }
    });
}

/// Pairs that are worked out together.
const BLOCK: usize = 8;

/// Halfway between two images, seen from a third: no rounding where all are equal.
#[inline(always)]
fn middle<T: Real>(plus: T, minus: T, near: T) -> T {
    T::of(0.5) * ((plus - near) + (minus - near))
}
