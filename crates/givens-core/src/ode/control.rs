//! The length of the next step (docs/algorithms.md O3).

use crate::scalar::Real;

/// Proportional-integral control of the step (Hairer, Nørsett & Wanner 1993, §II.4; Gustafsson 1991).
pub(super) struct Control {
    /// The power at which the error falls with the step.
    order: f64,
    /// The error of the last accepted step, in tolerances.
    previous: f64,
    /// The last step tried was not accepted.
    rejected: bool,
}

const SAFETY: f64 = 0.9;
/// A step shrinks at most by this.
const SHRINK: f64 = 0.2;
/// A step grows at most by this.
const GROW: f64 = 10.0;
/// What is left of a step that had no result.
const RETREAT: f64 = 0.25;
/// Of the exponent, what the previous error is given.
const INTEGRAL: f64 = 0.2;

impl Control {
    pub fn new(order: i32) -> Self {
        Self { order: f64::from(order), previous: 1e-4, rejected: false }
    }

    /// The step after one of `h` that was accepted with an error of `size` tolerances.
    pub fn accepted(&mut self, h: f64, size: f64) -> f64 {
        let integral = INTEGRAL / self.order;
        let power = 1.0 / self.order - 0.75 * integral;
        let size = size.max(1e-10);
        let factor = SAFETY * Real::pow(size, -power) * Real::pow(self.previous, integral);
        // no growth straight after a rejection
        let most = if self.rejected { 1.0 } else { GROW };
        self.previous = size.max(1e-4);
        self.rejected = false;
        h * factor.clamp(SHRINK, most)
    }

    /// The step after one of `h` whose error of `size` tolerances is too large, or no number.
    pub fn too_large(&mut self, h: f64, size: f64) -> f64 {
        self.rejected = true;
        let factor = SAFETY * Real::pow(size, -1.0 / self.order);
        h * if factor.is_nan() { RETREAT } else { factor.clamp(SHRINK, SAFETY) }
    }

    /// The step after one of `h` that had no result.
    pub fn failed(&mut self, h: f64) -> f64 {
        self.rejected = true;
        h * RETREAT
    }
}
