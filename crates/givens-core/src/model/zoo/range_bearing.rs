//! A radar in the plane.

use crate::model::{At, Noise, Observation};
use crate::scalar::Real;
use core::f64::consts::TAU;

/// Range and bearing from the origin of a position that stands at components `x` and `y` of the state
/// (2009 §VIII-B); the bearing is an angle in radians.
#[derive(Clone, Copy, Debug)]
pub struct RangeBearing {
    /// Length of the state.
    pub states: usize,
    /// Where the position along the first axis stands in the state.
    pub x: usize,
    /// Where the position along the second axis stands in the state.
    pub y: usize,
    /// Standard deviation of the range.
    pub range_std: f64,
    /// Standard deviation of the bearing, rad.
    pub bearing_std: f64,
}

impl RangeBearing {
    /// The radar of 2009 §VIII-B, for the state of [`CoordinatedTurn`](super::CoordinatedTurn): 10 m and √10 mrad.
    #[must_use]
    pub fn published() -> Self {
        Self { states: 5, x: 0, y: 2, range_std: 10.0, bearing_std: 0.003_162_277_660_168_379_5 }
    }
}

impl Observation for RangeBearing {
    fn states(&self) -> usize {
        self.states
    }
    fn measures(&self) -> usize {
        2
    }
    fn angle(&self, i: usize) -> Option<f64> {
        (i == 1).then_some(TAU)
    }
    #[inline(always)]
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = x[self.x].hypot(x[self.y]);
        out[1] = x[self.y].atan2(x[self.x]);
    }
    fn noise(&self) -> Noise {
        Noise::Root(2)
    }
    #[inline(always)]
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&[T::of(self.range_std), T::zero(), T::zero(), T::of(self.bearing_std)]);
    }
}
