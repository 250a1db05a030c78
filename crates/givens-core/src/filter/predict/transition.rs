//! One step of a discrete model: m⁻ = E[f(x)], P⁻ = Cov[f(x)] + Q (2009 eq 38–42; 2011 Tables 1, 3).

use super::gain::{Backward, gain_of_covariance, gain_of_factor, gain_scratch};
use super::lanes;
use crate::filter::error::{Fault, Matrix, Quantity};
use crate::filter::form::{Belief, Form};
use crate::filter::memory::{put_columns, take};
use crate::kernels::{add_outer, cholesky_scaled, copy_lower, downdate, square, tria};
use crate::model::{At, Moving, Transition};
use crate::rule::{Rule, Shape, Spread, spread_scratch};
use crate::scalar::{Mask, Real};

/// Scalars of scratch of [`predict`]: n states, q noise columns, `map` of the model's own.
pub(crate) const fn predict_scratch(n: usize, q: usize, shape: Shape, map: usize, smoothing: bool) -> usize {
    let columns = n + shape.plus + q;
    let step = n * columns + n * shape.minus + n * q + 2 * n + 2 * n * n;
    let gain = if smoothing { gain_scratch(n, shape.plus + q) } else { 0 };
    step + spread_scratch(shape, n, n, map) + gain
}

/// Moves `belief` over one transition; with `back`, also what a smoother needs to come back over it.
/// After a fault the belief is as before.
#[inline(always)]
pub(crate) fn predict<T: Real, M: Transition, R: Rule, F: Form>(
    rule: &R,
    table: &[T],
    model: &M,
    at: &At<T>,
    belief: &mut Belief<T>,
    back: Option<&mut Backward<T>>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let n = belief.mean.len();
    let shape = rule.shape(n);
    let q = model.noise().columns(n);
    let stride = n + shape.plus + q;
    let dev = take(&mut scratch, n * stride);
    let minus = take(&mut scratch, n * shape.minus);
    let mean = take(&mut scratch, n);
    let root = take(&mut scratch, n * q);
    let scale = take(&mut scratch, n);

    let mut spread = Spread { mean, dev, stride, minus };
    rule.spread(table, &Moving(model), at, belief.mean, belief.factor, &mut spread, scratch);
    if let Some(component) = spread.not_finite(n + shape.plus) {
        let derived = shape.points == 0 && spread.mean[component].finite().any();
        let quantity = if derived { Quantity::TransitionDerivative } else { Quantity::Transition };
        return Err(Fault::NotFinite { quantity, component });
    }
    let Spread { mean, dev, minus, .. } = spread;
    let mut sick = lanes(model.noise_root(at, root), Matrix::ProcessNoise)?;
    if q > 0 {
        let wrong = |row: &[T]| row.iter().any(|x| (!x.finite()).all());
        if let Some(component) = root.chunks_exact(q).position(wrong) {
            return Err(Fault::NotFinite { quantity: Quantity::ProcessNoise, component });
        }
    }
    put_columns(dev, stride, n + shape.plus, root, q);

    if F::SQUARE_ROOT {
        if let Some(back) = back {
            let rounding = T::of(rule.rounding(n));
            let size = |i: usize| rounding * mean[i].abs().max(belief.mean[i].abs());
            sick = sick | gain_of_factor(dev, stride, minus, belief.factor, size, back, scratch)?;
        }
        sick = sick | lanes(tria(dev, n, stride, stride), Matrix::Predicted)?;
        for column in 0..shape.minus {
            for (v, row) in scale.iter_mut().zip(minus.chunks_exact(shape.minus)) {
                *v = row[column];
            }
            sick = sick | lanes(downdate(dev, n, stride, scale), Matrix::Predicted)?;
        }
        copy_lower(belief.factor, n, dev, stride);
    } else {
        let cov = take(&mut scratch, n * n);
        let next = take(&mut scratch, n * n);
        square(cov, n, dev, stride, stride);
        for i in 0..n {
            scale[i] = cov[i * n + i];
        }
        add_outer(cov, n, n, minus, shape.minus, minus, shape.minus, shape.minus, -1.0);
        next.copy_from_slice(cov);
        sick = sick | lanes(cholesky_scaled(next, n, scale), Matrix::Predicted)?;
        if let Some(back) = back {
            gain_of_covariance(dev, stride, belief.factor, next, back);
        }
        belief.cov.copy_from_slice(cov);
        belief.factor.copy_from_slice(next);
    }
    belief.mean.copy_from_slice(mean);
    Ok(sick)
}
