//! Values of expressions while a model is read.

use givens_core::model::At;
use givens_expr::{Graph, Inputs, Node, Program};

/// When expressions without states and measures are evaluated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment<'a> {
    pub t: f64,
    pub dt: f64,
    pub u: &'a [f64],
}

/// The values of nodes that depend on no state and no measure; not-a-number where the graph is full, which is told
/// when the model is made.
pub(super) fn evaluate(graph: &Graph, nodes: &[Node], moment: &Moment, p: &[f64]) -> Vec<f64> {
    let constants: Option<Vec<f64>> = nodes.iter().map(|&node| graph.constant_value(node)).collect();
    if let Some(constants) = constants {
        return constants;
    }
    let Ok(program) = Program::compile(graph, nodes) else { return vec![f64::NAN; nodes.len()] };
    let at = At { t: moment.t, dt: moment.dt, u: moment.u, p };
    program.values(&Inputs { at, x: &[], z: &[] })
}
