//! What all sensors measure: traced, or with functions that are called.

use std::sync::Arc;

use givens::kernels::{Health, cholesky};
use givens::model::{At, Linear, Noise, Observation};
use givens::scalar::Real;
use givens_expr::ModelObservation;

use super::part::Part;
use crate::watch::go_on;

/// z = h + v of all sensors, however they were given. A clone shares everything.
#[derive(Clone, Debug)]
pub struct Sensing(Arc<Way>);

#[derive(Debug)]
enum Way {
    Traced(Box<ModelObservation>),
    Called(Called),
}

/// Sensors of which at least one is called.
#[derive(Debug)]
pub struct Called {
    pub states: usize,
    pub controls: usize,
    pub parameters: usize,
    pub sensors: Vec<Sensor>,
    /// The period of each measure that is an angle.
    pub angles: Vec<Option<f64>>,
}

/// A sensor of a stack.
#[derive(Debug)]
pub struct Sensor {
    pub measures: Part,
    /// Standard deviations, or the covariance row by row.
    pub noise: Part,
    pub is_cov: bool,
}

impl Sensing {
    /// Of expressions.
    pub fn traced(model: ModelObservation) -> Self {
        Self(Arc::new(Way::Traced(Box::new(model))))
    }

    /// Of functions.
    pub fn called(model: Called) -> Self {
        Self(Arc::new(Way::Called(model)))
    }

    /// Tells sensors of the same graphs or functions.
    pub fn origin(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }

    /// The functions, if some are called.
    pub fn functions(&self) -> Option<&Called> {
        match &*self.0 {
            Way::Traced(_) => None,
            Way::Called(called) => Some(called),
        }
    }
}

impl Observation for Sensing {
    fn states(&self) -> usize {
        match &*self.0 {
            Way::Traced(model) => model.states(),
            Way::Called(model) => model.states,
        }
    }

    fn measures(&self) -> usize {
        match &*self.0 {
            Way::Traced(model) => model.measures(),
            Way::Called(model) => model.angles.len(),
        }
    }

    fn angle(&self, i: usize) -> Option<f64> {
        match &*self.0 {
            Way::Traced(model) => model.angle(i),
            Way::Called(model) => model.angles.get(i).copied().flatten(),
        }
    }

    fn controls(&self) -> usize {
        match &*self.0 {
            Way::Traced(model) => model.controls(),
            Way::Called(model) => model.controls,
        }
    }

    fn parameters(&self) -> usize {
        match &*self.0 {
            Way::Traced(model) => model.parameters(),
            Way::Called(model) => model.parameters,
        }
    }

    /// A function that is called takes `f64`.
    fn serves_packs(&self) -> bool {
        matches!(&*self.0, Way::Traced(_))
    }

    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        match &*self.0 {
            Way::Traced(model) => model.observe(at, x, out),
            Way::Called(model) => {
                let mut rest = out;
                for Sensor { measures, .. } in &model.sensors {
                    let own = rest.split_off_mut(..measures.outputs).unwrap_or_default();
                    measures.one(at, x, own);
                }
            }
        }
    }

    fn noise(&self) -> Noise {
        Noise::Root(self.measures())
    }

    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        let health = self.noise_root(at, out);
        if let Some(first) = out.first_mut() {
            *first = T::select(health.sick, T::of(f64::NAN), *first);
        }
    }

    fn noise_root<T: Real>(&self, at: &At<T>, root: &mut [T]) -> Health<T> {
        match &*self.0 {
            Way::Traced(model) => model.noise_root(at, root),
            Way::Called(model) => model.noise_root(at, root),
        }
    }

    fn observe_scratch(&self, points: usize) -> usize {
        match &*self.0 {
            Way::Traced(model) => model.observe_scratch(points),
            Way::Called(model) => {
                let beside = model.controls + model.parameters;
                let each = model.sensors.iter();
                each.map(|sensor| sensor.measures.scratch(model.states, points, beside)).max().unwrap_or(0)
            }
        }
    }

    fn observe_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        if !go_on() {
            return out.fill(T::of(f64::NAN));
        }
        match &*self.0 {
            Way::Traced(model) => model.observe_points(at, points, x, out, scratch),
            Way::Called(model) => {
                let mut rest = out;
                for Sensor { measures, .. } in &model.sensors {
                    let own = rest.split_off_mut(..measures.outputs * points).unwrap_or_default();
                    measures.points(at, points, x, own, scratch);
                }
            }
        }
    }

    fn observe_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        if !go_on() {
            return out.value.fill(T::of(f64::NAN));
        }
        match &*self.0 {
            Way::Traced(model) => model.observe_linear(at, x, s, out, scratch),
            Way::Called(model) => {
                let mut rest = out;
                for Sensor { measures, .. } in &model.sensors {
                    let (own, others) = rest.split_at(measures.outputs);
                    measures.linear(at, x, s, own, scratch);
                    rest = others;
                }
            }
        }
    }
}

impl Called {
    /// The root of R, d × d, block by block on its diagonal; health names the measure, as that of traced sensors does.
    fn noise_root<T: Real>(&self, at: &At<T>, root: &mut [T]) -> Health<T> {
        let d = self.angles.len();
        root.fill(T::zero());
        let (mut health, mut top) = (Health::good(), 0);
        for Sensor { measures, noise, is_cov } in &self.sensors {
            let k = measures.outputs;
            let mut block = vec![T::zero(); noise.outputs];
            noise.noise(at, &[], &mut block);
            let mut own = Health::good();
            if *is_cov {
                own = cholesky(&mut block, k);
            } else {
                for (i, &std) in block.iter().enumerate() {
                    own.note(!T::zero().le(std), i);
                }
            }
            health = health.and(own.shifted(top));
            for (at, &value) in block.iter().enumerate() {
                let (row, column) = if *is_cov { (at / k, at % k) } else { (at, at) };
                root[(top + row) * d + top + column] = value;
            }
            top += k;
        }
        health
    }
}
