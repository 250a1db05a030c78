//! The Itô–Taylor step of order 1.5: the drift expanded, the rule over the expansion (2010 eq 25–27; 2012 eq 12).

use super::continuous::{Continuous, check_steps};
use super::noise::{Stacked, diffusion_rate, rate_scratch, stacked_scratch};
use super::{Given, Plan, Stopped, TimeUpdate};
use crate::filter::backward::Backward;
use crate::filter::error::Fault;
use crate::filter::form::{Belief, Form};
use crate::filter::layout::Layout;
use crate::filter::memory::{larger, take};
use crate::filter::sizes::{ENDLESS, Sizes, countable, fits};
use crate::model::{
    At, Expanded, Map, Sde, Varies, expanded_scratch, expansion_scratch, side_by_side_scratch,
};
use crate::ode::{Steps, Work};
use crate::rule::{Rule, Shape};
use crate::scalar::{LANES, Real};

/// How Lf enters the noise of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Variant {
    /// Its expectations, by the rule (2012 eq 12).
    Full,
    /// Its value at the mean (2010 eq 25, 27).
    #[default]
    Simplified,
    /// The same, once for the whole gap, the points carried through all steps without noise: what the 2010 paper's own
    /// program did. It does not converge to the true covariance.
    NoiseOnce,
}

/// `ito-taylor`: x + δ f + (δ²/2) L₀f + G w + (Lf) y by the rule (docs/algorithms.md C4–C7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ItoTaylor {
    /// How Lf enters the noise.
    pub variant: Variant,
    /// How a gap is divided.
    pub steps: Steps,
}

impl ItoTaylor {
    fn map<'m, M>(&self, model: &'m M, times: usize) -> Expanded<'m, M> {
        Expanded { model, times, noise: self.variant == Variant::Full }
    }

    /// The sizes with scratch for a model that overrides no provided method.
    pub(crate) const fn sizes_for(&self, sizes: Sizes, shape: Shape) -> Sizes {
        let (n, q, beside) = (sizes.states, sizes.process_noise, sizes.beside());
        let expansion = [expansion_scratch(n, q, beside); 2];
        let full = matches!(self.variant, Variant::Full);
        let narrow = expanded_scratch([n, q, beside], full, shape.points, expansion);
        let wide = expanded_scratch([n, q, beside], full, shape.points.div_ceil(LANES), expansion);
        let points = side_by_side_scratch(narrow, wide, beside);
        let at_the_mean = expanded_scratch([n, q, beside], true, 1, expansion);
        sizes.with_model_scratch(larger(points, at_the_mean))
    }

    /// The memory of a filter.
    pub(crate) const fn layout(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> Layout {
        let predict = if countable(sizes, shape) { self.scratch_for(sizes, shape, smoothing) } else { 0 };
        Layout::new(sizes, shape, smoothing, predict)
    }

    const fn scratch_for(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        let Sizes { states: n, process_noise: q, controls, parameters, .. } = sizes;
        if !fits(n, 1 + q, n + q + shape.plus + shape.minus + shape.points) {
            return ENDLESS;
        }
        let outputs = if matches!(self.variant, Variant::Full) { n * (1 + q) } else { n };
        let beside = larger(rate_scratch(n, q, controls + parameters), n + sizes.model);
        4 * n * q + larger(stacked_scratch(n, q, 2 * q, outputs, shape, sizes.model, smoothing), beside)
    }
}

impl<M: Sde> TimeUpdate<M> for ItoTaylor {
    fn check(&self, model: &M) -> Result<(), Fault> {
        check_steps(self.steps)?;
        Continuous(model).additive()
    }

    fn states(&self, model: &M) -> usize {
        model.states()
    }

    fn sizes(&self, model: &M, shape: Shape) -> Sizes {
        let at_the_mean = Expanded { model, times: 1, noise: true }.scratch(1);
        Continuous(model).sizes_for(|points| self.map(model, 1).scratch(points), shape.points, at_the_mean)
    }

    fn probe<T: Real>(&self, model: &M, at: &At<T>, mean: &[T], scratch: &mut [T]) -> Result<(), Fault> {
        Continuous(model).probe(at, mean, scratch)
    }

    /// Steps of a longest length are planned lane by lane, but those of one noise are within the step.
    fn lockstep(&self, _: bool) -> bool {
        self.variant != Variant::NoiseOnce || matches!(self.steps, Steps::Count(_))
    }

    fn parameters<'m>(&self, model: &'m M) -> &'m [f64] {
        model.parameters()
    }

    fn scratch(&self, sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        self.scratch_for(sizes, shape, smoothing)
    }

    fn plan(&self, _: &M, from: f64, to: f64) -> Result<Plan, Fault> {
        let gap = to - from;
        match self.variant {
            Variant::NoiseOnce => Plan::of(self.steps, gap).map(|_| Plan::whole(gap)),
            _ => Plan::of(self.steps, gap),
        }
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
        let Given { rule, table, model, ref at, again, .. } = *given;
        let (n, q) = (belief.mean.len(), model.noises());
        let full = self.variant == Variant::Full;
        let g = take(&mut scratch, n * q);
        let rate = take(&mut scratch, n * q);
        let (one, two) = (take(&mut scratch, n * q), take(&mut scratch, n * q));
        let lf = &mut *two;
        if !again || model.diffusion_varies() != Varies::Never {
            diffusion_rate(model, at, belief.mean, g, rate, scratch)?;
        }
        if !full {
            // Lf at the mean from which the step starts: 2021 eq 8 prints the one it ends in
            let (f, rest) = scratch.split_at_mut(n);
            let (l0, rest) = rest.split_at_mut(n);
            model.expansion_points(at, 1, belief.mean, f, l0, lf, rest);
        }
        let count = match self.variant {
            Variant::NoiseOnce => Plan::of(self.steps, at.dt.first())?.count,
            _ => 1,
        };
        let map = self.map(model, count);
        let each = At { dt: at.dt / T::of(count as f64), ..*at };
        let mut stacked = Stacked::spread((rule, table), &map, &each, belief, [q, 2 * q], &mut scratch)?;
        if full {
            lf.copy_from_slice(&stacked.mean[n..]);
        }
        let delta = at.dt;
        let root = delta.sqrt();
        let (half, twelfth) = (T::of(0.5) * delta, root * delta * T::of(12.0f64.sqrt().recip()));
        for (((one, two), &g), &rate) in one.iter_mut().zip(&mut *two).zip(&*g).zip(&*rate) {
            let lf = *two;
            (*one, *two) = (root * half.mul_add(lf + rate, g), twelfth * (lf - rate));
        }
        stacked.known(one, q);
        stacked.known(two, q);
        if full {
            stacked.entries(q, root * delta * T::of(3.0f64.sqrt().recip()));
        }
        Ok(stacked.settle::<F>(belief, back, scratch)?)
    }
}
