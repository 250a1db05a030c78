//! One step of a discrete model: m⁻ = E[f(x)], P⁻ = Cov[f(x)] + Q (2009 eq 38–42; 2011 Tables 1, 3).

use super::settle::{Moved, settle, settle_scratch};
use super::{Given, Plan, Stopped, TimeUpdate};
use crate::filter::backward::Backward;
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::{Belief, Form};
use crate::filter::lanes::lanes;
use crate::filter::layout::Layout;
use crate::filter::memory::{larger, put_columns, take, whole_packs};
use crate::filter::quantity::Quantity;
use crate::filter::sizes::{Sizes, countable};
use crate::kernels::{cholesky_again, kept_root, wild_row};
use crate::model::{Moving, Noise, Transition, scratch_for};
use crate::ode::Work;
use crate::rule::{Rule, Shape, Spread, spread_scratch};
use crate::scalar::{Mask, Real};

/// More steps in a gap than anyone means: they would take minutes.
const MANY: f64 = 1e7;

/// `transition`: the step of a discrete model, by the rule (docs/algorithms.md P1, P2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OneTransition;

impl OneTransition {
    /// Scalars of scratch of a step.
    pub(crate) const fn scratch(sizes: Sizes, shape: Shape, smoothing: bool) -> usize {
        let Sizes { states: n, process_noise: q, .. } = sizes;
        let stride = whole_packs(n + shape.plus + q);
        n * stride
            + n * shape.minus
            + n
            + n * q
            + larger(spread_scratch(shape, n, n, sizes.model), settle_scratch(n, stride, smoothing))
    }

    /// The memory of a filter of this time update.
    pub(crate) const fn layout(sizes: Sizes, shape: Shape, smoothing: bool) -> Layout {
        let predict = if countable(sizes, shape) { Self::scratch(sizes, shape, smoothing) } else { 0 };
        Layout::new(sizes, shape, smoothing, predict).keeping(kept_root(sizes.states))
    }
}

impl Sizes {
    /// The sizes of a discrete model alone, for a rule of that shape.
    pub fn of_model<M: Transition>(model: &M, shape: Shape) -> Self {
        OneTransition.sizes(model, shape)
    }
}

impl<M: Transition> TimeUpdate<M> for OneTransition {
    fn check(&self, _: &M) -> Result<(), Fault> {
        Ok(())
    }

    fn states(&self, model: &M) -> usize {
        model.states()
    }

    fn sizes(&self, model: &M, shape: Shape) -> Sizes {
        let (n, beside) = (model.states(), model.controls() + model.parameters().len());
        Sizes {
            states: n,
            process_noise: model.noise().columns(n),
            measures: 0,
            measurement_noise: 0,
            controls: model.controls(),
            parameters: model.parameters().len(),
            model: scratch_for(|points| model.transition_scratch(points), shape.points, beside),
        }
    }

    fn kept(&self, sizes: Sizes) -> usize {
        kept_root(sizes.states)
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

    /// A model with a fixed step takes as many as the gap holds; others take one of any length.
    fn plan(&self, model: &M, from: f64, to: f64) -> Result<Plan, Fault> {
        let gap = to - from;
        let Some(period) = model.period() else {
            return Ok(Plan { count: usize::from(gap > 0.0), dt: gap });
        };
        let whole = Real::floor(gap / period + 0.5);
        // late times are themselves rounded
        let rounding = 4.0 * f64::EPSILON * Real::abs(to) / period;
        // where they hide half a step, nothing tells how many there are
        if Real::abs(gap / period - whole) > 1e-6 + rounding || rounding > 0.5 {
            return Err(Fault::NotWholeSteps { gap, period });
        }
        if whole > MANY {
            let why = "a gap holds more than ten million of the model's steps: give both in the same unit";
            return Err(Fault::Mismatch { why });
        }
        Ok(Plan { count: whole as usize, dt: period })
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
        let Given { rule, table, model, ref at, ref mut kept, .. } = *given;
        let n = belief.mean.len();
        let shape = rule.shape(n);
        let q = model.noise().columns(n);
        let columns = n + shape.plus + q;
        let stride = whole_packs(columns);
        let dev = take(&mut scratch, n * stride);
        let minus = take(&mut scratch, n * shape.minus);
        let mean = take(&mut scratch, n);
        let root = take(&mut scratch, n * q);

        let mut spread = Spread { mean, dev, stride, minus };
        rule.spread(table, &Moving(model), at, belief.mean, belief.factor, &mut spread, scratch);
        if let Some(component) = spread.not_finite(n + shape.plus) {
            let derived = shape.points == 0 && spread.mean[component].finite().any();
            let quantity = if derived { Quantity::TransitionDerivative } else { Quantity::Transition };
            return Err(Fault::NotFinite { quantity, component }.into());
        }
        let Spread { mean, dev, minus, .. } = spread;
        let health = match model.noise() {
            Noise::Root(_) => model.noise_root(at, root),
            Noise::Covariance => {
                model.process_noise(at, root);
                cholesky_again(root, n, kept)
            }
        };
        let sick = lanes(health, Matrix::ProcessNoise)?;
        if let Some(component) = wild_row(root, q) {
            return Err(Fault::NotFinite { quantity: Quantity::ProcessNoise, component }.into());
        }
        put_columns(dev, stride, n + shape.plus, root, q);
        let moved = Moved { mean, dev, columns, stride, minus, lost: shape.minus };
        Ok(sick | settle::<T, F>(moved, belief, back, scratch)?)
    }
}
