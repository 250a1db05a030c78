//! The moment differential equations (2012 §2.2; Särkkä 2007), in covariance and in square-root form.

use super::continuous::{Continuous, check_integrator};
use super::image::{ByRule, by_rule_noises, by_rule_scratch, by_rule_sizes};
use super::integrate::{Lengths, integrate, integrate_scratch};
use super::moments::{Moments, moments_len, moments_scratch};
use super::noise::rate_scratch;
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

/// `moment-ode`: dm/dt = E\[f\], dP/dt = Cov\[x, f\] + Cov\[f, x\] + E\[G Gᵀ\], expectations by the rule at every stage of
/// the solver (docs/algorithms.md C9, C10). G may depend on the state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MomentOde {
    /// The solver.
    pub integrator: Integrator,
}

impl MomentOde {
    /// The sizes with scratch for a model that overrides no provided method, with a diffusion that does not depend on the state.
    #[allow(clippy::unused_self, reason = "as of the other time updates")]
    pub(crate) const fn sizes_for(&self, sizes: Sizes, shape: Shape) -> Sizes {
        by_rule_sizes(sizes, shape, false)
    }

    /// The same where the diffusion depends on the state.
    #[allow(clippy::unused_self, reason = "as above")]
    pub(crate) const fn sizes_with_state(&self, sizes: Sizes, shape: Shape) -> Sizes {
        by_rule_sizes(sizes, shape, true)
    }

    /// The memory of a filter.
    pub(crate) const fn layout(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> Layout {
        let predict = if countable(sizes, shape) { self.scratch_for(sizes, shape, smoothing) } else { 0 };
        Layout::new(sizes, shape, smoothing, predict)
    }

    const fn scratch_for(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        let n = sizes.states;
        let lengths = Lengths {
            state: moments_len(n, smoothing),
            system: moments_scratch(n, sizes.process_noise, sizes.model),
            image: sizes.model,
        };
        let step = integrate_scratch(&self.integrator, lengths, sizes, shape.table);
        larger(step, rate_scratch(n, sizes.process_noise, sizes.controls + sizes.parameters))
    }
}

impl<M: Sde> TimeUpdate<M> for MomentOde {
    fn check(&self, _: &M) -> Result<(), Fault> {
        check_integrator(&self.integrator)
    }

    fn resolves(&self, epsilon: f64) -> Result<(), Fault> {
        self.integrator.resolves(epsilon).map_err(Fault::Option)
    }

    fn states(&self, model: &M) -> usize {
        model.states()
    }

    fn sizes(&self, model: &M, shape: Shape) -> Sizes {
        let image = by_rule_scratch(model, shape);
        let (plus, minus) = by_rule_noises(model, shape);
        Sizes { process_noise: plus + minus, ..Continuous(model).sizes(image) }
    }

    fn probe<T: Real>(&self, model: &M, at: &At<T>, mean: &[T], scratch: &mut [T]) -> Result<(), Fault> {
        Continuous(model).probe(at, mean, scratch)
    }

    fn lockstep(&self, smoothing: bool) -> bool {
        self.integrator.lockstep() && !smoothing
    }

    fn parameters<'m>(&self, model: &'m M) -> &'m [f64] {
        model.parameters()
    }

    fn scratch(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        self.scratch_for(sizes, shape, smoothing)
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
        let image = ByRule { model: given.model, rule: given.rule };
        let moments = Moments { image, square_root: F::SQUARE_ROOT, carried: back.is_some() };
        integrate::<T, _, F, _, _>(&self.integrator, &moments, given, belief, back, work, scratch)
    }
}
