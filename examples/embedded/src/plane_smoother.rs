//! The same filter with a smoother of fixed lag behind it: what was the state ten steps ago, given all until now?

use crate::plane::{Radar, Turn};
use crate::plane_filter::{METHOD, PRIOR, SIZES};
use givens_core::filter::{Filter, SrCkf, StepError};
use givens_core::smoother::History;

/// Steps between the state that is told and the present.
const LAG: usize = 10;

/// A ring of the last ten predictions, with room for the way back over them.
const RING: usize = History::<f32, [f32; 0]>::memory_len(SIZES.states, LAG);

/// The memory of a [`PlaneSmoother`].
#[derive(Debug)]
pub struct LagMemory {
    filter: [f32; METHOD.smoothing_memory(SIZES)],
    ring: [f32; RING],
    mean: [f32; 5],
    factor: [f32; 25],
}

impl LagMemory {
    /// Nothing yet: a constant, for a static place too.
    pub const NEW: Self = Self { filter: [0.0; _], ring: [0.0; _], mean: [0.0; _], factor: [0.0; _] };
}

/// Follows one target in the plane, ten steps late and better known.
#[derive(Debug)]
pub struct PlaneSmoother<'m> {
    filter: Filter<'static, SrCkf, Turn, f32, &'m mut [f32]>,
    ring: History<f32, &'m mut [f32]>,
    mean: &'m mut [f32; 5],
    factor: &'m mut [f32; 25],
    /// Whether the past is as long as the lag.
    full: bool,
}

impl<'m> PlaneSmoother<'m> {
    /// Starts at time 0, in memory that is lent.
    ///
    /// # Errors
    /// None, with this prior and these sizes.
    pub fn start(memory: &'m mut LagMemory) -> Result<Self, StepError> {
        let LagMemory { filter, ring, mean, factor } = memory;
        Ok(Self {
            filter: Filter::start_in(METHOD, &Turn, SIZES, true, PRIOR, &mut filter[..])?,
            ring: History::new(SIZES.states, true, &mut ring[..]),
            mean,
            factor,
            full: false,
        })
    }

    /// Goes to the time (s) of a measurement, learns it (range in m, bearing in rad), and goes back over the lag.
    ///
    /// # Errors
    /// Those of [`PlaneFilter::step`](crate::PlaneFilter::step). After a failed prediction the smoother is to be started
    /// anew.
    pub fn step(&mut self, time: f64, z: [f32; 2]) -> Result<(), StepError> {
        self.ring.predict(&mut self.filter, time)?;
        self.filter.update(&Radar, &z.map(f64::from))?;
        self.ring.smooth(&self.filter, LAG, |age, smoothed| {
            if age == LAG {
                self.mean.copy_from_slice(smoothed.belief.mean);
                self.factor.copy_from_slice(smoothed.belief.factor);
                self.full = true;
            }
        })
    }

    /// The state ten steps ago, given all measurements until now, and a factor of its covariance, 5 × 5, lower
    /// triangular; none before the tenth step, at which it is the state at the start.
    #[must_use]
    pub fn lagged(&self) -> Option<(&[f32], &[f32])> {
        self.full.then_some((&*self.mean, &*self.factor))
    }
}
