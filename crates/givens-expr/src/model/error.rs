//! Why expressions do not make a model.

use core::fmt;

use crate::graph::{Graph, GraphError, Input, Node};

/// Why expressions do not make a model.
#[derive(Clone, Debug, PartialEq)]
pub enum ModelError {
    /// The graph is full.
    Graph(GraphError),
    /// A list has the wrong length.
    Length {
        /// Which list.
        what: &'static str,
        /// The length that it must have.
        expected: usize,
        /// The length that it has.
        found: usize,
    },
    /// An expression names something that it may not, or that does not exist.
    Input {
        /// Which list the expression stands in.
        what: &'static str,
        /// Its place in the list, counted from zero.
        index: usize,
        /// What it names.
        input: Input,
    },
    /// A parameter, the period or the period of an angle is not a number that can serve.
    Value {
        /// Which list or quantity.
        what: &'static str,
        /// Its place in the list, counted from zero.
        index: usize,
        /// The value.
        value: f64,
    },
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ModelError::Graph(error) => error.fmt(f),
            ModelError::Length { what, expected, found } => {
                write!(f, "{what}: {expected} expected, {found} found")
            }
            ModelError::Input { what, index, input } => {
                write!(f, "{what}: expression {index} (from zero) may not name {}", Named(*input))
            }
            ModelError::Value { what, index, value } => {
                write!(f, "{what}: {value} at place {index} (from zero) cannot serve")
            }
        }
    }
}

impl core::error::Error for ModelError {}

impl From<GraphError> for ModelError {
    fn from(error: GraphError) -> Self {
        ModelError::Graph(error)
    }
}

/// An input in words.
struct Named(Input);

impl fmt::Display for Named {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Input::State(i) => write!(f, "component {i} of the state"),
            Input::Time => f.write_str("the time"),
            Input::Step => f.write_str("the length of the step"),
            Input::Control(i) => write!(f, "control {i}"),
            Input::Parameter(i) => write!(f, "parameter {i}"),
            Input::Measure(i) => write!(f, "component {i} of the measurement"),
        }
    }
}

/// How many components of each kind there are to name, and whether time and step may be named.
#[derive(Clone, Copy)]
pub(super) struct Nameable {
    pub states: usize,
    pub controls: usize,
    pub parameters: usize,
    pub measures: usize,
    pub step: bool,
}

impl Nameable {
    /// An error for the first input of `nodes` that may not be named.
    pub fn check(self, graph: &Graph, what: &'static str, nodes: &[Node]) -> Result<(), ModelError> {
        let unnameable = |&input: &Input| match input {
            Input::State(i) => i as usize >= self.states,
            Input::Control(i) => i as usize >= self.controls,
            Input::Parameter(i) => i as usize >= self.parameters,
            Input::Measure(i) => i as usize >= self.measures,
            Input::Step => !self.step,
            Input::Time => false,
        };
        // one look at all of them is much quicker than one at each
        if !graph.inputs_of_all(nodes).iter().any(unnameable) {
            return Ok(());
        }
        for (index, &node) in nodes.iter().enumerate() {
            if let Some(input) = graph.inputs_of(node).into_iter().find(unnameable) {
                return Err(ModelError::Input { what, index, input });
            }
        }
        Ok(())
    }
}

/// An error unless a list has the length that it must have.
pub(super) fn length(what: &'static str, found: usize, expected: usize) -> Result<(), ModelError> {
    if found == expected { Ok(()) } else { Err(ModelError::Length { what, expected, found }) }
}

/// An error for the first value that is not finite.
pub(super) fn finite(what: &'static str, values: &[f64]) -> Result<(), ModelError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(ModelError::Value { what, index, value: values[index] }),
        None => Ok(()),
    }
}

/// An error unless a period is positive and finite.
pub(super) fn period(what: &'static str, index: usize, value: Option<f64>) -> Result<(), ModelError> {
    match value {
        Some(value) if !(value > 0.0 && value.is_finite()) => Err(ModelError::Value { what, index, value }),
        _ => Ok(()),
    }
}
