//! States found from a measurement.

use givens_core::model::At;

use super::error::{ModelError, Nameable, length};
use super::jacobian::Jacobian;
use crate::graph::{Graph, Input, Node};
use crate::program::Inputs;

/// What [`ModelStart::new`] needs.
#[derive(Clone, Debug, Default)]
pub struct StartParts {
    /// Number d of measures.
    pub measures: usize,
    /// Number of controls.
    pub controls: usize,
    /// Number of parameters.
    pub parameters: usize,
    /// The states that are found, by their place in the state: length k.
    pub states: Vec<u32>,
    /// Their values, length k, in measures, time, controls and parameters.
    pub values: Vec<Node>,
}

/// States found from one measurement, with the slopes that carry its covariance over to them.
///
/// ```
/// use givens_expr::{Graph, Input, ModelStart, StartParts};
/// let mut graph = Graph::new();
/// let (a, b) = (graph.input(Input::Measure(0)), graph.input(Input::Measure(1)));
/// let product = graph.mul(a, b);
/// let parts = StartParts { measures: 2, states: vec![3], values: vec![product], ..Default::default() };
/// let start = ModelStart::new(&mut graph, parts)?;
/// let (mut values, mut jacobian) = ([0.0], [0.0; 2]);
/// start.evaluate(0.0, &[], &[], &[4.0, 5.0], &mut values, &mut jacobian);
/// assert_eq!((values, jacobian), ([20.0], [5.0, 4.0]));
/// assert_eq!(start.states(), [3]);
/// # Ok::<(), givens_expr::ModelError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ModelStart {
    states: Vec<u32>,
    used: Vec<bool>,
    jacobian: Jacobian,
}

impl ModelStart {
    /// Differentiates and compiles the expressions.
    ///
    /// # Errors
    /// Lists of different lengths, an expression that names what it may not (states and the step among them), or a
    /// graph that is full.
    pub fn new(graph: &mut Graph, parts: StartParts) -> Result<Self, ModelError> {
        let StartParts { measures, controls, parameters, states, values } = parts;
        length("the values of the start", values.len(), states.len())?;
        let nameable = Nameable { states: 0, controls, parameters, measures, step: false };
        nameable.check(graph, "the start", &values)?;
        let mut used = vec![false; measures];
        for input in values.iter().flat_map(|&value| graph.inputs_of(value)) {
            if let Input::Measure(j) = input {
                used[j as usize] = true;
            }
        }
        let columns: Vec<Input> = (0..measures).map(|j| Input::Measure(j as u32)).collect();
        let jacobian = Jacobian::new(graph, &values, &columns)?;
        Ok(Self { states, used, jacobian })
    }

    /// The states that are found, by their place in the state.
    pub fn states(&self) -> &[u32] {
        &self.states
    }

    /// Whether measure `j` is named.
    pub fn uses(&self, j: usize) -> bool {
        self.used.get(j).copied().unwrap_or(false)
    }

    /// The values at measurement `z` (length d) to `values` (length k), and their slopes, k × d, to `jacobian`.
    /// Measures that are not named may be anything. Memory or inputs that are too short give not-a-number.
    pub fn evaluate(
        &self,
        t: f64,
        u: &[f64],
        p: &[f64],
        z: &[f64],
        values: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let (k, d) = (self.states.len(), self.used.len());
        if values.len() < k || jacobian.len() < k * d {
            values.fill(f64::NAN);
            jacobian.fill(f64::NAN);
            return;
        }
        jacobian.fill(0.0);
        let inputs = Inputs { at: At { t, dt: 0.0, u, p }, x: &[], z };
        let mut scratch = vec![0.0; self.jacobian.scratch_len()];
        self.jacobian
            .entries(&inputs, values, &mut scratch, |row, column, slope| jacobian[row * d + column] = slope);
    }
}
