//! The square-root continuous-discrete cubature Kalman filter.

use crate::diagonal;
use crate::space::{Radar, Turn};
use givens_core::filter::{Filter, Prior, Sizes, SrCdCkf, StepError};

/// Eight steps between two measurements.
const METHOD: SrCdCkf = SrCdCkf { substeps: 8, ..SrCdCkf::DEFAULT };
/// Seven states, four noises, three measures.
const SIZES: Sizes = METHOD.sizes_for(Sizes { process_noise: 4, ..Sizes::new(7, 3) });

/// What is known at time 0: the mean, and standard deviations of 10 m, 3.2 m/s and 0.6°/s.
const PRIOR: Prior<'_> = Prior {
    time: 0.0,
    mean: &[1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.104_719_755_119_659_77],
    factor: &const {
        diagonal::<7, 49>([
            10.0,
            3.162_277_660_168_379_5,
            10.0,
            3.162_277_660_168_379_5,
            10.0,
            3.162_277_660_168_379_5,
            0.01,
        ])
    },
    cov: &[],
};

/// The memory of a [`SpaceFilter`].
#[derive(Debug)]
pub struct SpaceMemory([f32; METHOD.memory(SIZES)]);

impl SpaceMemory {
    /// Nothing yet: a constant, for a static place too.
    pub const NEW: Self = Self([0.0; _]);
}

/// Follows one target in space.
#[derive(Debug)]
pub struct SpaceFilter<'m> {
    filter: Filter<'static, SrCdCkf, Turn, f32, &'m mut [f32]>,
}

impl<'m> SpaceFilter<'m> {
    /// Starts at time 0, in memory that is lent.
    ///
    /// # Errors
    /// None, with this prior and these sizes.
    pub fn start(memory: &'m mut SpaceMemory) -> Result<Self, StepError> {
        let filter = Filter::start_in(METHOD, &Turn, SIZES, false, PRIOR, &mut memory.0[..])?;
        Ok(Self { filter })
    }

    /// Goes to the time (s) of a measurement, and learns it: range (m), azimuth and elevation (rad).
    ///
    /// # Errors
    /// A time in the past; a measurement that is not finite; a covariance that is not positive definite. The belief is
    /// then that of the last step which succeeded.
    pub fn step(&mut self, time: f64, z: [f32; 3]) -> Result<(), StepError> {
        self.filter.predict(time)?;
        self.filter.update(&Radar, &z.map(f64::from))
    }

    /// The estimate: e, ve, n, vn, z, vz, ω (m and m/s by axis, rad/s).
    #[must_use]
    pub fn mean(&self) -> &[f32] {
        self.filter.mean()
    }

    /// S with P = S Sᵀ, 7 × 7, lower triangular.
    #[must_use]
    pub fn factor(&self) -> &[f32] {
        self.filter.factor()
    }
}
