//! Discrete models: traced, or with functions that are called.

use givens::model::{At, Linear, Noise, Transition};
use givens::scalar::Real;
use givens_expr::ModelTransition;

use super::part::Part;
use super::shared::{Shared, Way};

/// x(t + dt) = f + w, however it was given.
pub type Discrete = Shared<ModelTransition, Called>;

/// A transition or its noise that is called.
#[derive(Debug)]
pub struct Called {
    pub states: usize,
    pub controls: usize,
    pub parameters: usize,
    pub period: Option<f64>,
    pub next: Part,
    /// n × n row by row.
    pub noise_cov: Part,
}

impl Transition for Discrete {
    fn states(&self) -> usize {
        match &*self.way {
            Way::Traced(model) => model.states(),
            Way::Called(model) => model.states,
        }
    }

    fn period(&self) -> Option<f64> {
        match &*self.way {
            Way::Traced(model) => model.period(),
            Way::Called(model) => model.period,
        }
    }

    fn controls(&self) -> usize {
        match &*self.way {
            Way::Traced(model) => model.controls(),
            Way::Called(model) => model.controls,
        }
    }

    fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// A function that is called takes `f64`.
    fn serves_packs(&self) -> bool {
        matches!(&*self.way, Way::Traced(_))
    }

    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        if !self.goes_on() {
            return out.fill(T::of(f64::NAN));
        }
        match &*self.way {
            Way::Traced(model) => model.transition(at, x, out),
            Way::Called(model) => model.next.one(at, x, out),
        }
    }

    fn noise(&self) -> Noise {
        match &*self.way {
            Way::Traced(model) => model.noise(),
            Way::Called(_) => Noise::Covariance,
        }
    }

    fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        match &*self.way {
            Way::Traced(model) => model.process_noise(at, out),
            Way::Called(model) => model.noise_cov.noise(at, &[], out),
        }
    }

    fn transition_scratch(&self, points: usize) -> usize {
        match &*self.way {
            Way::Traced(model) => model.transition_scratch(points),
            Way::Called(model) => model.next.scratch(model.states, points, model.controls + model.parameters),
        }
    }

    fn transition_points<T: Real>(
        &self,
        at: &At<T>,
        points: usize,
        x: &[T],
        out: &mut [T],
        scratch: &mut [T],
    ) {
        if !self.goes_on() {
            return out.fill(T::of(f64::NAN));
        }
        match &*self.way {
            Way::Traced(model) => model.transition_points(at, points, x, out, scratch),
            Way::Called(model) => model.next.points(at, points, x, out, scratch),
        }
    }

    fn transition_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        if !self.goes_on() {
            return out.value.fill(T::of(f64::NAN));
        }
        match &*self.way {
            Way::Traced(model) => model.transition_linear(at, x, s, out, scratch),
            Way::Called(model) => model.next.linear(at, x, s, out, scratch),
        }
    }
}
