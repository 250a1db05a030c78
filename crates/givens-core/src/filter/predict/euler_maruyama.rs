//! The Euler–Maruyama step: m⁺ = E[x + δ f], P⁺ = Cov[x + δ f] + δ E[G Gᵀ].

use super::continuous::{Continuous, check_steps};
use super::noise::{Stacked, check_spread, diffusion, finish, rate_scratch, stacked_scratch};
use super::{Given, Plan, Stopped, TimeUpdate};
use crate::filter::backward::Backward;
use crate::filter::error::Fault;
use crate::filter::form::{Belief, Form};
use crate::filter::memory::{larger, take};
use crate::filter::sizes::{ENDLESS, Sizes, fits};
use crate::model::{At, Flow, Map, Sde, Varies};
use crate::ode::{Steps, Work};
use crate::rule::{Rule, Shape, Spread};
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
        let step = stacked_scratch(n, q, q, n * (1 + q), shape, sizes.model, smoothing);
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
        given: &Given<T, M, R>,
        belief: &mut Belief<T>,
        back: Option<&mut Backward<T>>,
        _: &mut Work,
        mut scratch: &mut [T],
    ) -> Result<T::Mask, Stopped> {
        let Given { rule, table, model, ref at } = *given;
        let (n, q, shape) = (belief.mean.len(), model.noises(), rule.shape(belief.mean.len()));
        let varies = model.diffusion_varies() == Varies::WithState;
        let map = Flow { model, step: true, diffusion: varies };
        let (outputs, stride) = (map.outputs(), n + shape.plus);
        let mean = take(&mut scratch, outputs);
        let dev = take(&mut scratch, outputs * stride);
        let minus = take(&mut scratch, outputs * shape.minus);
        let noise = take(&mut scratch, n * q);
        let mut spread = Spread { mean, dev, stride, minus };
        rule.spread(table, &map, at, belief.mean, belief.factor, &mut spread, scratch);
        check_spread(&spread, n, q, shape.points)?;
        if varies {
            noise.copy_from_slice(&spread.mean[n..]);
        } else {
            diffusion(model, at, belief.mean, noise)?;
        }
        let root = at.dt.sqrt();
        for g in &mut *noise {
            *g *= root;
        }
        let entries = varies.then_some(root);
        let lost = shape.minus;
        let stacked = Stacked { spread, entries, q, noise, known: q, lost };
        Ok(finish::<T, F>(stacked, belief, back, scratch)?)
    }
}
