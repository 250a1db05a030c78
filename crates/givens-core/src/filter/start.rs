//! How a filter begins: from a belief, in memory that is laid out once.

use super::error::{Fault, StepError};
use super::fits::{fits, variances_fit};
use super::form::Form;
use super::methods::Over;
use super::predict::TimeUpdate;
use super::quantity::Quantity;
use super::sizes::Sizes;
use super::stepper::{Filter, Parts, layout, parts};
use crate::model::At;
use crate::ode::Work;
use crate::rule::Rule;
use crate::scalar::Real;
use core::marker::PhantomData;

/// The initial belief of a filter, in plain slices: the mean of length n, the lower-triangular root of the covariance,
/// n × n, and the covariance itself (read in covariance form only).
#[derive(Clone, Copy, Debug)]
pub struct Prior<'a> {
    /// When it holds.
    pub time: f64,
    /// Length n.
    pub mean: &'a [f64],
    /// Lower triangular, n × n.
    pub factor: &'a [f64],
    /// n × n; in square-root form it may be empty.
    pub cov: &'a [f64],
}

impl<'m, X: Over<M>, M, T: Real, B: AsMut<[T]>> Filter<'m, X, M, T, B> {
    /// Starts a filter in the caller's memory of at least [`memory_len`](Self::memory_len) scalars. With `smoothing`,
    /// every prediction also leaves what a smoother needs to come [`back`](Self::backward) over it. An array moves with the
    /// filter, also while it starts, and the stack then holds several; where it is short, lend a slice.
    ///
    /// # Errors
    /// An option out of its range, a slice of the wrong length, a number that is not finite, or beyond the range of `T`.
    pub fn start_in(
        method: X,
        model: &'m M,
        sizes: Sizes,
        smoothing: bool,
        prior: Prior,
        memory: B,
    ) -> Result<Self, StepError> {
        let Prior { time, mean, factor, cov } = prior;
        let lengths = [mean.len(), factor.len(), cov.len()];
        let mut filter = Self::laid_out(method, model, sizes, smoothing, time, lengths, memory)?;
        for values in [mean, factor, cov] {
            if let Some(component) = values.iter().position(|x| !x.is_finite()) {
                let fault = Fault::NotFinite { quantity: Quantity::Estimate, component };
                return Err(StepError { fault, time, step: 0 });
            }
        }
        let fit = fits::<T>(mean, Quantity::Estimate).and_then(|()| variances_fit::<T>(factor, cov));
        fit.map_err(|fault| StepError { fault, time, step: 0 })?;
        let belief = filter.parts().belief;
        for (to, from) in [(belief.mean, mean), (belief.factor, factor), (belief.cov, cov)] {
            to.iter_mut().zip(from).for_each(|(to, &x)| *to = T::of(x));
        }
        filter.probed()
    }

    /// Memory carved and all of it set but the belief, whose mean, factor and covariance have these lengths.
    pub(super) fn laid_out(
        method: X,
        model: &'m M,
        sizes: Sizes,
        smoothing: bool,
        time: f64,
        [mean, factor, cov]: [usize; 3],
        mut memory: B,
    ) -> Result<Self, StepError> {
        let n = sizes.states;
        let fail = |fault| StepError { fault, time, step: 0 };
        if !time.is_finite() {
            return Err(fail(Fault::NotFinite { quantity: Quantity::Time, component: 0 }));
        }
        method.rule().check(n).map_err(|error| fail(Fault::Option(error)))?;
        let shape = method.rule().shape(n);
        let time_update = method.time_update();
        time_update.check(model).map_err(fail)?;
        time_update.resolves(T::EPSILON).map_err(fail)?;
        fits::<T>(time_update.parameters(model), Quantity::Parameter).map_err(fail)?;
        let layout = layout::<X, M>(&method, sizes, smoothing);
        let (square, needs) = (n.saturating_mul(n), time_update.sizes(model, shape));
        let own_cov = if X::Form::SQUARE_ROOT && cov == 0 { 0 } else { square };
        let at_least = |of, needed: usize, given: usize| (of, needed, needed.min(given));
        for (of, expected, found) in [
            ("the model's state", n, time_update.states(model)),
            at_least("the state", 1, n),
            ("mean", n, mean),
            ("factor", square, factor),
            ("covariance", own_cov, cov),
            at_least("the sizes' process noise", needs.process_noise, sizes.process_noise),
            at_least("the sizes' controls", needs.controls, sizes.controls),
            at_least("the sizes' parameters", needs.parameters, sizes.parameters),
            at_least("the sizes' scratch for the model", needs.model, sizes.model),
            at_least("the filter's memory", layout.len, memory.as_mut().len()),
        ] {
            if expected != found {
                return Err(fail(Fault::Length { of, expected, found }));
            }
        }
        let Parts { kept, table, u, p, floor, mut learnt, scores, .. } =
            parts::<T, X::Form>(&layout, memory.as_mut());
        method.rule().tabulate(n, table);
        kept.fill(T::zero());
        u.fill(T::zero());
        p.iter_mut().zip(time_update.parameters(model)).for_each(|(to, &x)| *to = T::of(x));
        floor.fill(T::zero());
        learnt.reset(n);
        scores.fill(T::zero());
        Ok(Self {
            method,
            model,
            layout,
            time,
            step: 0,
            present: 0,
            controlled: sizes.controls == 0,
            work: Work::default(),
            moved: false,
            moves: 0,
            memory,
            scalar: PhantomData,
        })
    }

    /// The filter, if the model does at its belief only what it says it does.
    pub(super) fn probed(mut self) -> Result<Self, StepError> {
        let (time, step, model, time_update) = (self.time, self.step, self.model, self.method.time_update());
        let Parts { u, p, belief, scratch, .. } = self.parts();
        let at = At { t: T::of(time), dt: T::zero(), u, p };
        let done = time_update.probe(model, &at, belief.mean, scratch);
        done.map_err(|fault| StepError { fault, time, step })?;
        Ok(self)
    }
}
