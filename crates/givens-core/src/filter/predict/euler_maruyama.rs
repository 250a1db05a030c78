//! The Euler–Maruyama step: m⁺ = E[x + δ f], P⁺ = Cov[x + δ f] + δ E[G Gᵀ].

use super::continuous::{Continuous, check_steps};
use super::noise::{Stacked, diffusion, rate_scratch, stacked_scratch};
use super::{Given, Plan, Stopped, TimeUpdate};
use crate::filter::backward::Backward;
use crate::filter::error::Fault;
use crate::filter::form::{Belief, Form};
use crate::filter::memory::{larger, take};
use crate::filter::sizes::{ENDLESS, Sizes, fits};
use crate::model::{At, Flow, Map, Sde, Varies};
use crate::ode::{Steps, Work};
use crate::rule::{Rule, Shape};
use crate::scalar::Real;

/// `euler-maruyama`: x + δ f(x) + G w, w ~ N(0, δ I), by the rule (2010 eq 11; docs/algorithms.md C8). G may depend on the
/// state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerMaruyama {
    /// How a gap is divided.
    pub steps: Steps,
}

impl EulerMaruyama {
    const fn scratch(sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        let Sizes { states: n, process_noise: q, controls, parameters, .. } = sizes;
        if !fits(n, 1 + q, n + q + shape.plus + shape.minus + shape.points) {
            return ENDLESS;
        }
        let step = n * q + stacked_scratch(n, q, q, n * (1 + q), shape, sizes.model, smoothing);
        larger(step, rate_scratch(n, q, controls + parameters))
    }
}

impl<M: Sde> TimeUpdate<M> for EulerMaruyama {
    fn check(&self, _: &M) -> Result<(), Fault> {
        check_steps(self.steps)
    }

    fn states(&self, model: &M) -> usize {
        model.states()
    }

    fn sizes(&self, model: &M, shape: Shape) -> Sizes {
        let map = Flow { model, step: true, diffusion: model.diffusion_varies() == Varies::WithState };
        Continuous(model).sizes_for(|points| map.scratch(points), shape.points, 0)
    }

    fn probe<T: Real>(&self, model: &M, at: &At<T>, mean: &[T], scratch: &mut [T]) -> Result<(), Fault> {
        Continuous(model).probe(at, mean, scratch)
    }

    fn lockstep(&self, _: bool) -> bool {
        true
    }

    fn parameters<'m>(&self, model: &'m M) -> &'m [f64] {
        model.parameters()
    }

    fn scratch(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        Self::scratch(sizes, shape, smoothing)
    }

    fn plan(&self, _: &M, from: f64, to: f64) -> Result<Plan, Fault> {
        Plan::of(self.steps, to - from)
    }

    #[inline(always)]
    fn step<T: Real, R: Rule, F: Form>(
        &self,
        given: &mut Given<T, M, R>,
        belief: &mut Belief<T>,
        back: Option<&mut Backward<T>>,
        _: &mut Work,
        mut scratch: &mut [T],
    ) -> Result<T::Mask, Stopped> {
        let Given { rule, table, model, ref at, .. } = *given;
        let (n, q) = (belief.mean.len(), model.noises());
        let varies = model.diffusion_varies() == Varies::WithState;
        let map = Flow { model, step: true, diffusion: varies };
        let noise = take(&mut scratch, n * q);
        let mut stacked = Stacked::spread((rule, table), &map, at, belief, [q, q], &mut scratch)?;
        if varies {
            noise.copy_from_slice(&stacked.mean[n..]);
        } else {
            diffusion(model, at, belief.mean, noise)?;
        }
        let root = at.dt.sqrt();
        for g in &mut *noise {
            *g *= root;
        }
        stacked.known(noise, q);
        if varies {
            stacked.entries(q, root);
        }
        Ok(stacked.settle::<F>(belief, back, scratch)?)
    }
}
