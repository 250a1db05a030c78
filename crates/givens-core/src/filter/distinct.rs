//! Whether the points of a rule can be told from the mean, in numbers of a given length.

use super::error::Fault;
use super::quantity::Quantity;
use super::update::Posterior;
use crate::kernels::{Health, plus_magnitudes};
use crate::scalar::{Mask, Real};

/// The share of a component's steps that may be lost when they are added to its mean: its standard deviation is then
/// wrong by as much, at most.
const LOST: f64 = 0.125;

/// A standard deviation of so many ε of its mean has a mean that rounding, half an ε at each step, does not move by
/// much of it.
const SPACINGS: f64 = 8.0;

/// Fails if a component of the state is known to a few spacings of numbers at its mean, or if the points at m ± `reach` S e_l
/// lose more than an eighth of their steps in it (docs/algorithms.md R7); a standard deviation of zero, or of no more than
/// `floor`, has nothing to lose. `before` is what [`note`] has noted of the belief.
#[inline(always)]
pub(super) fn distinct<T: Real>(
    reach: f64,
    mean: &[T],
    factor: &[T],
    floor: &[T],
    before: &[T],
) -> Result<T::Mask, Fault> {
    let n = mean.len();
    let far = T::of(far(reach, n, T::EPSILON));
    let mut apart = T::Mask::splat(true);
    for i in 0..n {
        apart = apart & (far * mean[i].abs()).lt(before[n + i]);
    }
    if apart.all() {
        return Ok(T::Mask::splat(false));
    }
    let mut health = Health::<T>::good();
    for i in 0..n {
        let (m, floor) = (mean[i], floor[i]);
        if (far * m.abs()).lt(before[n + i]).all() {
            continue;
        }
        let (steps, lost, deviation) = steps(T::of(reach), m, &factor[i * n..=i * n + i]);
        // points nearer than a standard deviation are weighted by the inverse square of their distance, and so is the
        // rounding of their images
        let blown = T::of(T::EPSILON * n as f64 * (1.0 / (reach * reach) - 1.0).max(0.0)) * m.abs();
        let gone = near(m, steps, lost, deviation) | (T::of(LOST) * deviation).lt(blown);
        health.note(gone & floor.lt(deviation), i);
    }
    match health.failed() {
        Some(component) => Err(Fault::Indistinct { component }),
        None => Ok(health.sick),
    }
}

/// Points of a component whose standard deviation is more than this times its mean are distinct, and their steps need not
/// be looked at: each loses at most ε (|m| + 2 |step|).
fn far(reach: f64, n: usize, epsilon: f64) -> f64 {
    let steps = n as f64 * (16.0 / reach).max((1.0 / (reach * reach) - 1.0) / LOST);
    epsilon * steps.max(SPACINGS)
}

/// Whether numbers near m are too few to tell its points from it, or its mean from its neighbours.
#[inline(always)]
fn near<T: Real>(m: T, steps: T, lost: T, deviation: T) -> T::Mask {
    (T::of(LOST) * steps).lt(lost) | deviation.lt(T::of(SPACINGS * T::EPSILON) * m.abs())
}

/// What is known of each component before an update, to judge by it after: n means, then n standard deviations.
#[inline(always)]
pub(super) fn note<T: Real>(mean: &[T], factor: &[T], before: &mut [T]) {
    let n = mean.len();
    let (means, deviations) = before.split_at_mut(n);
    means.copy_from_slice(mean);
    for (i, to) in deviations.iter_mut().enumerate() {
        *to = deviation(&factor[i * n..=i * n + i]);
    }
}

/// After an update. A mean, or a row of the root, that is finite in no lane is a fault: sums of squares may overflow where
/// none of the numbers does. In the lanes of `exact`, where a measure had no noise, what is left of a standard deviation
/// that it has made small may be the rounding of what it was and of its mean: that much is its floor. Elsewhere, a
/// component that has become known to a few spacings of numbers at its mean, before or now, has a mean of rounding. On a
/// fault nothing is changed but `before`.
#[inline(always)]
pub(super) fn judge<T: Real>(
    before: &mut [T],
    posterior: &Posterior<T>,
    exact: T::Mask,
    floor: &mut [T],
) -> Result<T::Mask, Fault> {
    let (means, deviations) = before.split_at_mut(floor.len());
    let (rounding, half) = (T::of(64.0 * floor.len() as f64 * T::EPSILON), T::of(0.5));
    let (mut health, mut lost) = (Health::<T>::good(), T::Mask::splat(false));
    for (i, &mean) in posterior.mean.iter().enumerate() {
        let now = deviation(posterior.factor.row(i, i + 1));
        let endless = !(now + mean.abs()).finite();
        if endless.all() {
            return Err(Fault::NotFinite { quantity: Quantity::Estimate, component: i });
        }
        lost = lost | endless;
        let was = means[i].abs();
        let learnt = now.lt(half * deviations[i]);
        let left = rounding * (deviations[i] + was);
        // the floor that it will have takes the place of its mean before
        means[i] = T::select(exact & learnt, floor[i].max(left), floor[i]);
        let vague = now.lt(T::of(SPACINGS * T::EPSILON) * was.max(mean.abs())) & means[i].lt(now);
        health.note(learnt & vague, i);
    }
    if let Some(component) = health.failed() {
        return Err(Fault::Indistinct { component });
    }
    floor.copy_from_slice(means);
    Ok(lost | health.sick)
}

/// The sum of a row's magnitudes: a standard deviation, or somewhat more.
#[inline(always)]
fn deviation<T: Real>(row: &[T]) -> T {
    plus_magnitudes(T::zero(), row)
}

/// After a prediction: only what still cannot be told from the mean may be rounding of an update. What the model itself
/// has shrunk to a few spacings of numbers at a mean that stays where it is, is as good as known: it is its own floor.
#[inline(always)]
pub(super) fn lower<T: Real>(reach: f64, before: &[T], mean: &[T], factor: &[T], floor: &mut [T]) {
    let n = mean.len();
    let far = T::of(far(reach, n, T::EPSILON));
    // the diagonal is part of a standard deviation, and mostly says enough
    let mut apart = T::Mask::splat(true);
    for i in 0..n {
        apart = apart & (far * mean[i].abs()).lt(factor[i * n + i].abs());
    }
    if apart.all() {
        floor.fill(T::zero());
        return;
    }
    let (means, deviations) = before.split_at(n);
    for i in 0..n {
        let (m, floor) = (mean[i], &mut floor[i]);
        if (far * m.abs()).lt(deviation(&factor[i * n..=i * n + i])).all() {
            *floor = T::zero();
            continue;
        }
        let (steps, lost, deviation) = steps(T::of(reach), m, &factor[i * n..=i * n + i]);
        let shrunk = deviation.lt(deviations[i]) & m.abs().le(means[i].abs() + means[i].abs());
        let kept = T::select(shrunk, floor.max(deviation), *floor);
        *floor = T::select(near(m, steps, lost, deviation), kept, T::zero());
    }
}

/// Of the points of one component: Σ |step|, what of that its mean loses, and its standard deviation, at most.
#[inline(always)]
fn steps<T: Real>(reach: T, m: T, row: &[T]) -> (T, T, T) {
    let (mut steps, mut lost, mut deviation) = (T::zero(), T::zero(), T::zero());
    for &s in row {
        let step = reach * s;
        let (up, down) = ((m + step) - m, m - (m - step));
        steps += step.abs() + step.abs();
        lost += (up - step).abs() + (down - step).abs();
        deviation += s.abs();
    }
    (steps, lost, deviation)
}
