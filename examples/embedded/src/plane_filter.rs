//! The square-root cubature Kalman filter.

use crate::diagonal;
use crate::plane::{Radar, Turn};
use givens_core::filter::{Filter, Prior, Sizes, SrCkf, StepError};

pub(crate) const METHOD: SrCkf = SrCkf::DEFAULT;
/// Five states, two measures.
pub(crate) const SIZES: Sizes = Sizes::new(5, 2);

/// What is known at time 0: the mean, and standard deviations of 10 m, 3.2 m/s and 0.2°/s.
pub(crate) const PRIOR: Prior<'_> = Prior {
    time: 0.0,
    mean: &[20_000.0, 300.0, 20_000.0, 0.0, -0.052_359_877_559_829_88],
    factor: &const {
        diagonal::<5, 25>([
            10.0,
            3.162_277_660_168_379_5,
            10.0,
            3.162_277_660_168_379_5,
            3.162_277_660_168_379_5e-3,
        ])
    },
    cov: &[],
};

/// The memory of a [`PlaneFilter`].
#[derive(Debug)]
pub struct PlaneMemory([f32; METHOD.memory(SIZES)]);

impl PlaneMemory {
    /// Nothing yet: a constant, for a static place too.
    pub const NEW: Self = Self([0.0; _]);
}

/// Follows one target in the plane.
#[derive(Debug)]
pub struct PlaneFilter<'m> {
    filter: Filter<'static, SrCkf, Turn, f32, &'m mut [f32]>,
}

impl<'m> PlaneFilter<'m> {
    /// Starts at time 0, in memory that is lent: it stays where it is, and no stack has to hold a copy.
    ///
    /// # Errors
    /// None, with this prior and these sizes.
    pub fn start(memory: &'m mut PlaneMemory) -> Result<Self, StepError> {
        let filter = Filter::start_in(METHOD, &Turn, SIZES, false, PRIOR, &mut memory.0[..])?;
        Ok(Self { filter })
    }

    /// Goes to the time (s) of a measurement, and learns it: range (m) and bearing (rad).
    ///
    /// # Errors
    /// A time in the past; a measurement that is not finite; a covariance that is not positive definite. The belief is
    /// then that of the last step which succeeded.
    pub fn step(&mut self, time: f64, z: [f32; 2]) -> Result<(), StepError> {
        self.filter.predict(time)?;
        self.filter.update(&Radar, &z.map(f64::from))
    }

    /// The estimate: x, vx, y, vy, ω (m, m/s, m, m/s, rad/s).
    #[must_use]
    pub fn mean(&self) -> &[f32] {
        self.filter.mean()
    }

    /// S with P = S Sᵀ, 5 × 5, lower triangular.
    #[must_use]
    pub fn factor(&self) -> &[f32] {
        self.filter.factor()
    }
}
