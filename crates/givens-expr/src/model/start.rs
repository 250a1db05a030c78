//! States found from a measurement, or from two.

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
    /// Their values, length k, in measures, time, controls and parameters, and in the [`rate`] of such values.
    pub values: Vec<Node>,
}

/// How fast a value found from a measurement moves, from an earlier measurement and the present one:
/// (c(z₁) − c(z₀))/(t₁ − t₀) for the value c(z).
///
/// In a graph the earlier measurement is [`Input::Measure`] from d = `measures` on, its controls are
/// [`Input::Control`] from `controls` on, and [`Input::Step`] is t₁ − t₀.
pub fn rate(graph: &mut Graph, value: Node, measures: usize, controls: usize) -> Node {
    let step = graph.input(Input::Step);
    let earlier = graph.substitute(value, |graph, input| match input {
        Input::Measure(j) => Some(graph.input(Input::Measure(j.saturating_add(measures as u32)))),
        Input::Control(j) => Some(graph.input(Input::Control(j.saturating_add(controls as u32)))),
        Input::Time => {
            let time = graph.input(Input::Time);
            Some(graph.sub(time, step))
        }
        _ => None,
    });
    let change = graph.sub(value, earlier);
    graph.div(change, step)
}

/// States found from a measurement, or from it and an earlier one, with the slopes that carry their covariance over to
/// them.
///
/// ```
/// use givens_core::model::At;
/// use givens_expr::{Graph, Input, ModelStart, StartParts};
/// let mut graph = Graph::new();
/// let (a, b) = (graph.input(Input::Measure(0)), graph.input(Input::Measure(1)));
/// let product = graph.mul(a, b);
/// let parts = StartParts { measures: 2, states: vec![3], values: vec![product], ..Default::default() };
/// let start = ModelStart::new(&mut graph, parts)?;
/// let (mut values, mut jacobian) = ([0.0], [0.0; 2]);
/// let at = At { t: 0.0, dt: 0.0, u: &[], p: &[] };
/// start.evaluate(&at, &[4.0, 5.0], &mut values, &mut jacobian);
/// assert_eq!((values, jacobian), ([20.0], [5.0, 4.0]));
/// assert_eq!(start.states(), [3]);
/// # Ok::<(), givens_expr::ModelError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ModelStart {
    states: Vec<u32>,
    used: Vec<bool>,
    earlier: bool,
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
        // only a rate has a step
        let inputs = graph.inputs_of_all(&values);
        let earlier = inputs.contains(&Input::Step);
        let rows = if earlier { 2 } else { 1 };
        let nameable = Nameable {
            states: 0,
            controls: rows * controls,
            parameters,
            measures: rows * measures,
            step: earlier,
        };
        nameable.check(graph, "the start", &values)?;
        let mut used = vec![false; measures];
        for input in inputs {
            if let Input::Measure(j) = input {
                used[j as usize % measures.max(1)] = true;
            }
        }
        let columns: Vec<Input> = (0..rows * measures).map(|j| Input::Measure(j as u32)).collect();
        let jacobian = Jacobian::new(graph, &values, &columns)?;
        Ok(Self { states, used, earlier, jacobian })
    }

    /// The states that are found, by their place in the state.
    pub fn states(&self) -> &[u32] {
        &self.states
    }

    /// Whether an earlier measurement is read as well.
    pub fn reads_earlier(&self) -> bool {
        self.earlier
    }

    /// Whether measure `j` is named, of either measurement.
    pub fn uses(&self, j: usize) -> bool {
        self.used.get(j).copied().unwrap_or(false)
    }

    /// The values at measurement `z` to `values` (length k), and their slopes along it, k × the length of z, to
    /// `jacobian`. If an earlier measurement is read, [`At::dt`] is the time since then, and its measures and controls
    /// follow the present ones: `z` has length 2 d instead of d. Measures that are not named may be anything. Memory or
    /// inputs that are too short give not-a-number.
    pub fn evaluate(&self, at: &At<f64>, z: &[f64], values: &mut [f64], jacobian: &mut [f64]) {
        let k = self.states.len();
        let d = if self.earlier { 2 * self.used.len() } else { self.used.len() };
        if values.len() < k || jacobian.len() < k * d {
            values.fill(f64::NAN);
            jacobian.fill(f64::NAN);
            return;
        }
        jacobian.fill(0.0);
        let inputs = Inputs { at: *at, x: &[], z };
        let mut scratch = vec![0.0; self.jacobian.scratch_len()];
        self.jacobian
            .entries(&inputs, values, &mut scratch, |row, column, slope| jacobian[row * d + column] = slope);
    }
}
