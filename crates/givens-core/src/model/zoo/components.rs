//! A sensor that measures states themselves.

use crate::model::{At, Noise, Observation};
use crate::scalar::Real;

/// Measures D components of the state as they are, with independent errors.
///
/// ```
/// use givens_core::model::zoo::Components;
/// use givens_core::model::{At, Observation};
///
/// let sensor = Components { states: 3, which: [2, 0], std: [0.1, 0.2] };
/// let mut z = [0.0; 2];
/// sensor.observe(&At { t: 0.0, dt: 0.0, u: &[], p: &[] }, &[5.0, 6.0, 7.0], &mut z);
/// assert_eq!(z, [7.0, 5.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Components<const D: usize> {
    /// Length of the state.
    pub states: usize,
    /// Which components, counted from zero. One that the state does not have is measured as NaN, which a filter refuses.
    pub which: [usize; D],
    /// Standard deviations of their errors, in the units of the components.
    pub std: [f64; D],
}

impl<const D: usize> Observation for Components<D> {
    fn states(&self) -> usize {
        self.states
    }

    fn measures(&self) -> usize {
        D
    }

    #[inline(always)]
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        for (z, &i) in z.iter_mut().zip(&self.which) {
            *z = x.get(i).copied().unwrap_or(T::of(f64::NAN));
        }
    }

    fn noise(&self) -> Noise {
        Noise::Root(D)
    }

    #[inline(always)]
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.fill(T::zero());
        for (out, &std) in out.iter_mut().step_by(D + 1).zip(&self.std) {
            *out = T::of(std);
        }
    }
}
