//! The predicted measurement: the rule's spread of h and the noise, of the components that are there.

use super::{InnovationMut, Measurement, Present};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::lanes::lanes;
use crate::filter::memory::{put_columns, take};
use crate::filter::quantity::Quantity;
use crate::kernels::{plus_magnitudes, tria};
use crate::model::{At, Observation, Sensed as SensedMap};
use crate::rule::{Rule, Shape, Spread};
use crate::scalar::{Mask, Real};

/// Z = [D E S_R] and the negative columns, rows of the present components only.
pub(super) struct Sensed<'a, T: Real> {
    /// Number of components, of which none is absent in all lanes but for [`Present::Lanes`].
    pub d: usize,
    /// Their number in each lane.
    pub dof: T,
    /// d rows of length `stride`: D (n columns), E, S_R.
    pub dev: &'a [T],
    pub stride: usize,
    /// Columns of E.
    pub bends: usize,
    /// d rows of length `lost`.
    pub minus: &'a [T],
    pub lost: usize,
    /// The lanes in which a component has no more noise than the rounding of its images: the update may then leave mere
    /// rounding of a state.
    pub exact: T::Mask,
}

impl<T: Real> Measurement<'_, T> {
    /// A fault of the present components, numbered as in the whole measurement.
    pub fn in_whole(&self, fault: Fault) -> Fault {
        let whole = |i: usize| (0..self.z.len()).filter(|&k| self.present.counts(k)).nth(i).unwrap_or(i);
        match fault {
            Fault::SingularInnovation { measure } => Fault::SingularInnovation { measure: whole(measure) },
            Fault::NotFinite { quantity: Quantity::Innovation, component } => {
                Fault::NotFinite { quantity: Quantity::Innovation, component: whole(component) }
            }
            Fault::NotPositive { matrix: Matrix::Innovation, pivot } => {
                Fault::NotPositive { matrix: Matrix::Innovation, pivot: whole(pivot) }
            }
            other => other,
        }
    }
}

/// Scalars of scratch that [`sense`] keeps.
pub(super) const fn sense_scratch(n: usize, d: usize, r: usize, shape: Shape) -> usize {
    d * (n + shape.plus + r) + d * shape.minus + d * r
}

/// Predicts the measurement and compares; the rest of `scratch` is left for the update.
///
/// Of lanes with components of their own, an absent one is a measure of pure unit noise that says what was expected: it teaches
/// nothing, and its pivot is one. That noise needs a column of its own, for which the caller counts in `r`; it has one also
/// where no lane needs it, so that what is computed in a lane does not depend on the others.
#[inline(always)]
pub(super) fn sense<'a, T: Real, H: Observation, R: Rule>(
    rule: &R,
    table: &[T],
    h: &H,
    at: &At<T>,
    measurement: &Measurement<T>,
    belief: &Belief<T>,
    innovation: &mut InnovationMut<T>,
    scratch: &mut &'a mut [T],
) -> Result<(Sensed<'a, T>, T::Mask), Fault> {
    let (n, all) = (belief.mean.len(), h.measures());
    let shape = rule.shape(n);
    let r = h.noise().columns(all);
    let filled = n + shape.plus + r;
    let partly = matches!(measurement.present, Present::Lanes(_));
    // all rows stay where they are, and their number is known beforehand
    let whole = partly || matches!(measurement.present, Present::All);
    let stride = if partly { filled + all } else { filled };
    let dev = take(scratch, all * stride);
    let minus = take(scratch, all * shape.minus);
    let root = take(scratch, all * r);
    let mean = &mut innovation.predicted[..all];

    let mut spread = Spread { mean: &mut *mean, dev: &mut *dev, stride, minus: &mut *minus };
    let moved = !belief.moved.is_empty();
    let drawn = if moved { &*belief.moved } else { &*belief.factor };
    rule.spread(table, &SensedMap(h), at, belief.mean, drawn, &mut spread, scratch);
    let sick = lanes(h.noise_root(at, root), Matrix::MeasurementNoise)?;

    let (mut d, mut dof, mut exact) = (0, T::zero(), T::Mask::splat(false));
    for i in 0..all {
        let row = if whole { i } else { d };
        if !measurement.present.counts(i) {
            continue;
        }
        let there = measurement.present.lanes(i);
        if partly {
            dev[i * stride + filled..(i + 1) * stride].fill(T::zero());
            for part in [
                &mut dev[i * stride..i * stride + n + shape.plus],
                &mut minus[i * shape.minus..(i + 1) * shape.minus],
                &mut root[i * r..(i + 1) * r],
                &mut mean[i..=i],
            ] {
                for x in part {
                    *x = T::select(there, *x, T::zero());
                }
            }
            dev[i * stride + filled + i] = T::select(there, T::zero(), T::one());
        }
        let bad = |quantity| Err(Fault::NotFinite { quantity, component: i });
        let spread = &dev[i * stride..i * stride + n + shape.plus];
        let size = plus_magnitudes(mean[i].abs(), spread);
        if (!size.finite()).all() {
            // a rule without points takes derivatives
            let derived = shape.points == 0 && mean[i].finite().any();
            return bad(if derived { Quantity::ObservationDerivative } else { Quantity::Observation });
        }
        let noise = &root[i * r..(i + 1) * r];
        let deviation = plus_magnitudes(T::zero(), noise);
        if (!deviation.finite()).all() {
            return bad(Quantity::MeasurementNoise);
        }
        exact = exact | (deviation.same(T::zero()) & there);
        if (!measurement.z[i].finite()).all() {
            return bad(Quantity::Measurement);
        }
        // move the row up over the absent ones: the root of the kept R is its kept rows, all columns
        if !whole {
            dev.copy_within(i * stride..(i + 1) * stride, row * stride);
            minus.copy_within(i * shape.minus..(i + 1) * shape.minus, row * shape.minus);
        }
        dev[row * stride + n + shape.plus..row * stride + filled].copy_from_slice(noise);
        let nu = measurement.z[i] - mean[i];
        let nu = if partly { T::select(there, nu, T::zero()) } else { nu };
        (innovation.nu[row], mean[row]) = match h.angle(i) {
            Some(period) => (nu.wrap(T::of(period)), mean[i].wrap(T::of(period))),
            None => (nu, mean[i]),
        };
        dof += if partly { T::select(there, T::one(), T::zero()) } else { T::one() };
        d += 1;
    }
    let d = if whole { all } else { d };
    if moved {
        turn(belief.moved, dev, d, stride, scratch);
    }
    Ok((Sensed { d, dof, dev, stride, bends: shape.plus, minus, lost: shape.minus, exact }, sick))
}

/// [M; D] Q = [S; D Q] with S lower triangular: D from the coordinates of M to those of S.
#[inline(always)]
fn turn<T: Real>(moved: &[T], dev: &mut [T], d: usize, stride: usize, scratch: &mut [T]) {
    let n = moved.len().isqrt();
    let size = n + d;
    let block = &mut scratch[..size * size];
    put_columns(block, size, 0, moved, n);
    for (to, row) in block[n * size..].chunks_exact_mut(size).zip(dev.chunks_exact(stride)) {
        to[..n].copy_from_slice(&row[..n]);
    }
    // the rows of D find no column left to be reflected in
    let _ = tria(block, size, n, size);
    for (row, from) in dev.chunks_exact_mut(stride).zip(block[n * size..].chunks_exact(size)) {
        row[..n].copy_from_slice(&from[..n]);
    }
}
