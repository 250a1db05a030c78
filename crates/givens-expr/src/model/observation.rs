//! Sensors made of expressions.

use givens_core::kernels::{Health, cholesky};
use givens_core::model::{At, Linear, Noise, Observation};
use givens_core::scalar::Real;

use super::error::{ModelError, Nameable, length, period};
use super::frame::with_frame;
use super::jacobian::Jacobian;
use crate::graph::{Graph, Input, Node};
use crate::program::{Inputs, Program};

/// The noise of one sensor, of k measures.
#[derive(Clone, Debug)]
pub enum NoiseBlock {
    /// Standard deviations of independent measures, length k.
    Std(Vec<Node>),
    /// The covariance, k × k row by row, of which the lower triangle counts.
    Cov(Vec<Node>),
}

/// What [`ModelObservation::new`] needs; d is the number of measures of all sensors together.
#[derive(Clone, Debug, Default)]
pub struct ObservationParts {
    /// Number of states.
    pub states: usize,
    /// Number of controls.
    pub controls: usize,
    /// Number of parameters.
    pub parameters: usize,
    /// The measures of all sensors, stacked in order: length d.
    pub measures: Vec<Node>,
    /// The period of each measure that is an angle: length d.
    pub angles: Vec<Option<f64>>,
    /// The noise of each sensor in order; it may depend on time, controls and parameters.
    pub noise: Vec<NoiseBlock>,
}

/// z = h(x, t, u; p) + v, v ~ N(0, R), from expressions; R has a block for each sensor.
///
/// Measures and noise may not name the step: an observation has none.
#[derive(Clone, Debug)]
pub struct ModelObservation {
    states: usize,
    controls: usize,
    parameters: usize,
    angles: Vec<Option<f64>>,
    measures: Program,
    jacobian: Jacobian,
    blocks: Vec<Block>,
    noise: Program,
}

#[derive(Clone, Copy, Debug)]
enum Block {
    Std(usize),
    Cov(usize),
}

impl Block {
    /// Measures of the sensor, and numbers that state their noise.
    fn sizes(self) -> (usize, usize) {
        match self {
            Block::Std(k) => (k, k),
            Block::Cov(k) => (k, k * k),
        }
    }
}

const NOISE: &str = "the noise of the measures";

impl ModelObservation {
    /// Differentiates and compiles the expressions.
    ///
    /// # Errors
    /// A list of the wrong length, an expression that names what it may not, the period of an angle that is not
    /// positive, or a graph that is full.
    pub fn new(graph: &mut Graph, parts: ObservationParts) -> Result<Self, ModelError> {
        let ObservationParts { states, controls, parameters, measures, angles, noise } = parts;
        length("the periods of the angles", angles.len(), measures.len())?;
        angles
            .iter()
            .enumerate()
            .try_for_each(|(i, &angle)| period("the periods of the angles", i, angle))?;
        let nameable = Nameable { states, controls, parameters, measures: 0, step: false };
        nameable.check(graph, "the measures", &measures)?;

        let (mut blocks, mut entries) = (Vec::new(), Vec::new());
        for block in noise {
            let (shape, nodes) = match block {
                NoiseBlock::Std(nodes) => (Block::Std(nodes.len()), nodes),
                NoiseBlock::Cov(nodes) => (Block::Cov(nodes.len().isqrt()), nodes),
            };
            length("the covariance of a sensor", nodes.len(), shape.sizes().1)?;
            Nameable { states: 0, ..nameable }.check(graph, NOISE, &nodes)?;
            blocks.push(shape);
            entries.extend(nodes);
        }
        length(NOISE, blocks.iter().map(|block| block.sizes().0).sum(), measures.len())?;

        let columns: Vec<Input> = (0..states).map(|i| Input::State(i as u32)).collect();
        Ok(Self {
            states,
            controls,
            parameters,
            angles,
            jacobian: Jacobian::new(graph, &measures, &columns)?,
            measures: Program::compile(graph, &measures)?,
            blocks,
            noise: Program::compile(graph, &entries)?,
        })
    }
}

impl Observation for ModelObservation {
    fn states(&self) -> usize {
        self.states
    }

    fn measures(&self) -> usize {
        self.angles.len()
    }

    fn angle(&self, i: usize) -> Option<f64> {
        self.angles.get(i).copied().flatten()
    }

    fn controls(&self) -> usize {
        self.controls
    }

    fn parameters(&self) -> usize {
        self.parameters
    }

    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let inputs = Inputs { at: *at, x, z: &[] };
        with_frame(self.measures.scratch_len(1), |scratch| self.measures.eval(&inputs, 1, out, scratch));
    }

    /// A root, block by block on the diagonal.
    fn noise(&self) -> Noise {
        Noise::Root(self.angles.len())
    }

    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        let health = self.noise_root(at, out);
        if let Some(first) = out.first_mut() {
            *first = T::select(health.sick, T::of(f64::NAN), *first);
        }
    }

    /// Health names the measure, counted from the top of all, whose standard deviation is negative or not a number,
    /// or whose pivot shows that a covariance is not positive semidefinite.
    fn noise_root<T: Real>(&self, at: &At<T>, root: &mut [T]) -> Health<T> {
        let d = self.angles.len();
        let root = &mut root[..d * d];
        root.fill(T::zero());
        let inputs = Inputs { at: *at, x: &[], z: &[] };
        with_frame(self.noise.scratch_len(1), |scratch| self.noise.eval(&inputs, 1, root, scratch));
        let mut health = Health::good();
        let (mut top, mut from) = (0, 0);
        for block in &self.blocks {
            let (k, len) = block.sizes();
            let stated = &mut root[from..from + len];
            health = health.and(match block {
                Block::Std(_) => deviations(stated).shifted(top),
                Block::Cov(_) => cholesky(stated, k).shifted(top),
            });
            (top, from) = (top + k, from + len);
        }
        self.spread(root, d);
        health
    }

    fn observe_scratch(&self, points: usize) -> usize {
        self.measures.scratch_len(points).max(self.jacobian.scratch_len())
    }

    fn observe_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        self.measures.eval(&Inputs { at: *at, x, z: &[] }, points, out, scratch);
    }

    fn observe_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let inputs = Inputs { at: *at, x, z: &[] };
        self.jacobian.times(&inputs, self.states, s, out, scratch);
    }
}

impl ModelObservation {
    /// Moves the blocks, which stand one after the other, to their places on the diagonal. From the last number to
    /// the first, since none moves towards the front.
    fn spread<T: Real>(&self, root: &mut [T], d: usize) {
        let (mut top, mut from) = self.blocks.iter().fold((0, 0), |(top, from), block| {
            let (k, len) = block.sizes();
            (top + k, from + len)
        });
        for block in self.blocks.iter().rev() {
            let (k, len) = block.sizes();
            (top, from) = (top - k, from - len);
            for i in (0..len).rev() {
                let (row, column) = match block {
                    Block::Std(_) => (i, i),
                    Block::Cov(_) => (i / k, i % k),
                };
                let value = root[from + i];
                root[from + i] = T::zero();
                root[(top + row) * d + top + column] = value;
            }
        }
    }
}

/// Names the first standard deviation that is negative or not a number.
fn deviations<T: Real>(stds: &[T]) -> Health<T> {
    let mut health = Health::good();
    for (i, &std) in stds.iter().enumerate() {
        health.note(!T::zero().le(std), i);
    }
    health
}
