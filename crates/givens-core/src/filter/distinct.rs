//! Whether the points of a rule can be told from the mean, in numbers of a given length.

use super::error::Fault;
use crate::kernels::Health;
use crate::scalar::Real;

/// The share of a component's steps that may be lost when they are added to its mean: its standard deviation is then
/// wrong by as much, at most.
const LOST: f64 = 0.125;

/// Fails if the points at m ± `reach` S e_l lose more than an eighth of their steps in a component of the state
/// (docs/algorithms.md R7); a standard deviation of zero, or of no more than `floor`, has nothing to lose.
#[inline(always)]
pub(super) fn distinct<T: Real>(reach: f64, mean: &[T], factor: &[T], floor: &[T]) -> Result<T::Mask, Fault> {
    let n = mean.len();
    let mut health = Health::<T>::good();
    for (i, (&m, &floor)) in mean.iter().zip(floor).enumerate() {
        let (steps, lost, deviation) = steps(T::of(reach), m, &factor[i * n..=i * n + i]);
        health.note((T::of(LOST) * steps).lt(lost) & floor.lt(deviation), i);
    }
    match health.failed() {
        Some(component) => Err(Fault::Indistinct { component }),
        None => Ok(health.sick),
    }
}

/// After an update by a measure without noise, in the lanes of `exact`: any standard deviation may be mere rounding.
#[inline(always)]
pub(super) fn raise<T: Real>(floor: &mut [T], exact: T::Mask) {
    for floor in floor {
        *floor = T::select(exact, T::of(f64::INFINITY), *floor);
    }
}

/// After a prediction: only what still cannot be told from the mean may be rounding of an update.
#[inline(always)]
pub(super) fn lower<T: Real>(reach: f64, mean: &[T], factor: &[T], floor: &mut [T]) {
    let n = mean.len();
    for (i, (&m, floor)) in mean.iter().zip(floor).enumerate() {
        let (steps, lost, _) = steps(T::of(reach), m, &factor[i * n..=i * n + i]);
        *floor = T::select((T::of(LOST) * steps).lt(lost), *floor, T::zero());
    }
}

/// Of the points of one component: Σ |step|, what of that its mean loses, and its standard deviation, at most.
#[inline(always)]
fn steps<T: Real>(reach: T, m: T, row: &[T]) -> (T, T, T) {
    row.iter().fold((T::zero(), T::zero(), T::zero()), |(steps, lost, deviation), &s| {
        let step = reach * s;
        let (up, down) = ((m + step) - m, m - (m - step));
        let error = (up - step).abs() + (down - step).abs();
        (steps + step.abs() + step.abs(), lost + error, deviation + s.abs())
    })
}
