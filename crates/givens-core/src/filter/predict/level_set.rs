//! The level-set time update (2021), with a root that is free to turn or held triangular.

use super::continuous::{Continuous, check_integrator};
use super::front::{Front, front_len, front_scratch};
use super::integrate::{Lengths, integrate, integrate_scratch};
use super::moments::{Moments, moments_len, moments_scratch};
use super::noise::rate_scratch;
use super::velocity::{ByVelocity, Velocity, by_velocity_scratch, by_velocity_sizes};
use super::{Given, Plan, Stopped, TimeUpdate};
use crate::filter::backward::Backward;
use crate::filter::error::Fault;
use crate::filter::form::{Belief, Form};
use crate::filter::layout::Layout;
use crate::filter::memory::larger;
use crate::filter::sizes::{Sizes, countable};
use crate::model::{At, Sde};
use crate::ode::{Integrator, Work};
use crate::rule::{Rule, Shape};
use crate::scalar::Real;

/// What becomes of the root of the covariance between two measurements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gauge {
    /// It fills up, and is triangularised at the end.
    #[default]
    Free,
    /// It stays triangular throughout.
    Triangular,
}

/// The root that the measurement update after a level-set step draws its points from. A cubature update depends on it,
/// at the level of a percent for the radar of the papers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Root {
    /// The lower triangular one, as in every other filter.
    #[default]
    Lower,
    /// The one that the step has moved, as it is.
    Moved,
}

/// `level-set`: the points x̄ ± M move with the drift (docs/algorithms.md C11, C12). The rule serves the measurement
/// update alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LevelSet {
    /// What moves mean and root.
    pub velocity: Velocity,
    /// What becomes of the root.
    pub gauge: Gauge,
    /// The root that the update draws its points from.
    pub root: Root,
    /// The solver.
    pub integrator: Integrator,
}

impl LevelSet {
    /// The sizes with scratch for a model that overrides no provided method.
    pub(crate) const fn sizes_for(&self, sizes: Sizes, _: Shape) -> Sizes {
        by_velocity_sizes(sizes, self.velocity)
    }

    /// The memory of a filter.
    pub(crate) const fn layout(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> Layout {
        let predict = if countable(sizes, shape) { self.scratch_for(sizes, shape, smoothing) } else { 0 };
        let layout = Layout::new(sizes, shape, smoothing, predict);
        if matches!(self.root, Root::Moved) { layout.with_moved_root() } else { layout }
    }

    const fn scratch_for(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        let Sizes { states: n, process_noise: q, model: image, .. } = sizes;
        let (state, system) = match self.gauge {
            Gauge::Free => (front_len(n, smoothing), front_scratch(n, q, image)),
            Gauge::Triangular => (moments_len(n, smoothing), moments_scratch(n, q, image)),
        };
        let step = integrate_scratch(&self.integrator, Lengths { state, system, image }, sizes, shape.table);
        larger(step, rate_scratch(n, q, sizes.controls + sizes.parameters))
    }
}

impl<M: Sde> TimeUpdate<M> for LevelSet {
    fn check(&self, model: &M) -> Result<(), Fault> {
        check_integrator(&self.integrator)?;
        if (self.gauge, self.root) == (Gauge::Triangular, Root::Moved) {
            let why = "gauge = triangular leaves no other root than the lower one; root = moved is for gauge = free";
            return Err(Fault::Mismatch { why });
        }
        Continuous(model).additive()
    }

    fn resolves(&self, epsilon: f64) -> Result<(), Fault> {
        self.integrator.resolves(epsilon).map_err(Fault::Option)
    }

    fn states(&self, model: &M) -> usize {
        model.states()
    }

    fn sizes(&self, model: &M, _: Shape) -> Sizes {
        Continuous(model).sizes(by_velocity_scratch(model, self.velocity))
    }

    fn probe<T: Real>(&self, model: &M, at: &At<T>, mean: &[T], scratch: &mut [T]) -> Result<(), Fault> {
        Continuous(model).probe(at, mean, scratch)
    }

    fn lockstep(&self, smoothing: bool) -> bool {
        self.integrator.lockstep() && !smoothing && !TimeUpdate::<M>::moves_root(self)
    }

    fn parameters<'m>(&self, model: &'m M) -> &'m [f64] {
        model.parameters()
    }

    fn scratch(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        self.scratch_for(sizes, shape, smoothing)
    }

    fn moves_root(&self) -> bool {
        self.root == Root::Moved
    }

    fn plan(&self, _: &M, from: f64, to: f64) -> Result<Plan, Fault> {
        Ok(Plan::whole(to - from))
    }

    #[inline(always)]
    fn step<T: Real, R: Rule, F: Form>(
        &self,
        given: &mut Given<T, M, R>,
        belief: &mut Belief<T>,
        back: Option<&mut Backward<T>>,
        work: &mut Work,
        scratch: &mut [T],
    ) -> Result<T::Mask, Stopped> {
        let image = ByVelocity { model: given.model, velocity: self.velocity };
        let carried = back.is_some();
        match self.gauge {
            Gauge::Free => {
                let front = Front { image, carried };
                integrate::<T, _, F, _, _>(&self.integrator, &front, given, belief, back, work, scratch)
            }
            Gauge::Triangular => {
                let moments = Moments { image, square_root: true, carried };
                integrate::<T, _, F, _, _>(&self.integrator, &moments, given, belief, back, work, scratch)
            }
        }
    }
}
