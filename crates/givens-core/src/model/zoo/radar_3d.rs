//! A radar that measures a position in space.

use crate::model::{At, Noise, Observation};
use crate::scalar::Real;

/// Range, azimuth and elevation of the position in components 0, 2 and 4 of a state of seven, from the origin
/// (2010 §VI; 2012 §4; 2021 §4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radar3d {
    /// Standard deviation of the range, m.
    pub range: f64,
    /// Standard deviation of both angles, rad.
    pub angle: f64,
}

impl Default for Radar3d {
    /// 50 m and 0.1°.
    fn default() -> Self {
        Self { range: 50.0, angle: 0.1_f64.to_radians() }
    }
}

impl Observation for Radar3d {
    fn states(&self) -> usize {
        7
    }

    fn measures(&self) -> usize {
        3
    }

    fn angle(&self, i: usize) -> Option<f64> {
        (i == 1).then_some(core::f64::consts::TAU)
    }

    #[inline(always)]
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        let ground = x[0].hypot(x[2]);
        z[0] = ground.hypot(x[4]);
        z[1] = x[2].atan2(x[0]);
        z[2] = x[4].atan2(ground);
    }

    fn noise(&self) -> Noise {
        Noise::Root(3)
    }

    #[inline(always)]
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.fill(T::zero());
        out[0] = T::of(self.range);
        out[4] = T::of(self.angle);
        out[8] = T::of(self.angle);
    }
}
