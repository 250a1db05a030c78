//! Symmetric points: every point m + S ξ comes with m − S ξ, and a centre if the rule or an angle needs one.

use crate::kernels::outlined;
use crate::model::{At, Map, evaluate_side_by_side, filled, misaligned};
use crate::scalar::Real;

/// The images of h pairs and of the centre, d rows of 2h + 1 (or 2h) and more: first the points m + S ξ, then m − S ξ.
pub(super) struct Images<'a, T> {
    pub y: &'a mut [T],
    pub pairs: usize,
    pub points: usize,
    pub centred: bool,
}

impl<T: Real> Images<'_, T> {
    /// The images of component `i`: plus, minus, and the centre if there is one.
    #[inline(always)]
    pub fn row(&self, i: usize) -> (&[T], &[T], Option<T>) {
        let row = &self.y[i * self.points..(i + 1) * self.points];
        let (plus, rest) = row.split_at(self.pairs);
        let (minus, centre) = rest.split_at(self.pairs);
        (plus, minus, centre.first().copied().filter(|_| self.centred))
    }
}

outlined! {
    /// Moves every angle of a row by whole periods to the reference.
    fn wrap_around(row: &mut [T], reference: T, period: f64) -> () = wrapped_around
}

#[inline(always)]
fn wrapped_around<T: Real>(row: &mut [T], reference: T, period: f64) {
    let period = T::of(period);
    for angle in row {
        *angle = reference + (*angle - reference).wrap(period);
    }
}

/// Evaluates `g` at the points that `lay` writes: m + step and m − step of each pair in rows of the length that it is told,
/// m behind them; at m only if `centred` or if `g` has an angle. Then moves every image of an angle once to the reference
/// g(m) (docs/algorithms.md §5).
#[inline(always)]
pub(super) fn evaluate<'a, T: Real, G: Map>(
    g: &G,
    at: &At<T>,
    n: usize,
    pairs: usize,
    centred: bool,
    lay: impl FnOnce(&mut [T], usize),
    scratch: &'a mut [T],
) -> Images<'a, T> {
    let d = g.outputs();
    let has_angle = (0..d).any(|i| g.angle(i).is_some());
    let centred = centred || has_angle;
    let points = filled::<T, G>(g, 2 * pairs + usize::from(centred));
    let skip = misaligned(scratch);
    let (x, rest) = scratch[skip..].split_at_mut(n * points);
    let (y, rest) = rest.split_at_mut(d * points);
    lay(x, points);
    evaluate_side_by_side(g, at, points, x, y, rest);
    for i in 0..d {
        if let Some(period) = g.angle(i) {
            let row = &mut y[i * points..][..points];
            wrap_around(row, row[2 * pairs], period);
        }
    }
    Images { y, pairs, points, centred }
}
