//! Continuous models: traced, or with functions that are called.

use givens::model::{At, Linear, Sde, Varies, expansion_by_duals, expansion_scratch};
use givens::scalar::Real;
use givens_expr::ModelSde;

use super::part::Part;
use super::shared::{Shared, Way};

/// dx = f dt + G dβ, however it was given.
pub type Continuous = Shared<ModelSde, Called>;

/// A drift or a diffusion that is called.
#[derive(Debug)]
pub struct Called {
    pub states: usize,
    pub noises: usize,
    pub controls: usize,
    pub parameters: usize,
    pub drift: Part,
    /// n × q row by row.
    pub diffusion: Part,
    pub varies: Varies,
}

impl Sde for Continuous {
    fn states(&self) -> usize {
        match &*self.way {
            Way::Traced(model) => model.states(),
            Way::Called(model) => model.states,
        }
    }

    fn noises(&self) -> usize {
        match &*self.way {
            Way::Traced(model) => model.noises(),
            Way::Called(model) => model.noises,
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

    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        if !self.goes_on() {
            return dx.fill(T::of(f64::NAN));
        }
        match &*self.way {
            Way::Traced(model) => model.drift(at, x, dx),
            Way::Called(model) => model.drift.one(at, x, dx),
        }
    }

    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        match &*self.way {
            Way::Traced(model) => model.diffusion(at, x, g),
            Way::Called(model) => model.diffusion.noise(at, x, g),
        }
    }

    fn diffusion_varies(&self) -> Varies {
        match &*self.way {
            Way::Traced(model) => model.diffusion_varies(),
            Way::Called(model) => model.varies,
        }
    }

    fn drift_scratch(&self, points: usize) -> usize {
        match &*self.way {
            Way::Traced(model) => model.drift_scratch(points),
            Way::Called(model) => model.drift.scratch(model.states, points, model.beside()),
        }
    }

    fn drift_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        if !self.goes_on() {
            return out.fill(T::of(f64::NAN));
        }
        match &*self.way {
            Way::Traced(model) => model.drift_points(at, points, x, out, scratch),
            Way::Called(model) => model.drift.points(at, points, x, out, scratch),
        }
    }

    fn drift_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        if !self.goes_on() {
            return out.value.fill(T::of(f64::NAN));
        }
        match &*self.way {
            Way::Traced(model) => model.drift_linear(at, x, s, out, scratch),
            Way::Called(model) => model.drift.linear(at, x, s, out, scratch),
        }
    }

    fn expansion_scratch(&self, points: usize) -> usize {
        match &*self.way {
            Way::Traced(model) => model.expansion_scratch(points),
            Way::Called(model) => expansion_scratch(model.states, model.noises, model.beside()),
        }
    }

    fn expansion_points<T: Real>(
        &self,
        at: &At<T>,
        points: usize,
        x: &[T],
        f: &mut [T],
        l0: &mut [T],
        lf: &mut [T],
        scratch: &mut [T],
    ) {
        if !self.goes_on() {
            return f.fill(T::of(f64::NAN));
        }
        match &*self.way {
            Way::Traced(model) => model.expansion_points(at, points, x, f, l0, lf, scratch),
            Way::Called(_) => expansion_by_duals(self, at, points, x, f, l0, lf, scratch),
        }
    }
}

impl Called {
    fn beside(&self) -> usize {
        self.controls + self.parameters
    }
}
