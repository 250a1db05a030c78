//! From the graph to a program.

use std::collections::{HashMap, HashSet};

use crate::graph::{Graph, GraphError, Input, Node, Op};
use crate::operation::{Binary, Unary};

use super::fuse::fuse;
use super::lifetime::{Rows, Step};
use super::{Code, Extent, Program};

impl Program {
    /// Compiles expressions, which may share parts; equal parts are worked out once.
    ///
    /// # Errors
    /// The graph is full.
    pub fn compile(graph: &Graph, outputs: &[Node]) -> Result<Program, GraphError> {
        graph.check()?;
        let outputs: Vec<Node> = outputs.iter().map(|&node| graph.own(node)).collect();
        let order = graph.reachable(&outputs);
        let (extent, moving) = survey(graph, &order);
        let (row_steps, scalar_steps) = steps(graph, &order, &moving);
        let row_steps = fuse(row_steps, &outputs.iter().copied().collect(), &moving);

        let mut rows = Rows::new(&row_steps, outputs.iter().copied());
        let lent: Vec<Node> =
            order.iter().copied().filter(|node| !moving.contains(node) && rows.wants(*node)).collect();
        let mut scalars = Rows::new(&scalar_steps, lent.iter().copied());
        let (mut constants, mut loads, mut states) = (Vec::new(), Vec::new(), Vec::new());
        for &node in &order {
            match graph.op(node) {
                Op::Constant(bits) if scalars.wants(node) => {
                    constants.push((f64::from_bits(bits), scalars.begin(node)));
                }
                Op::Input(Input::State(i)) if rows.wants(node) => states.push((i, rows.begin(node))),
                Op::Input(input) if scalars.wants(node) => loads.push((input, scalars.begin(node))),
                _ => {}
            }
        }
        let scalar_code = scalars.instructions(&scalar_steps);
        // a block is laid out once and then used for all points: what is lent to it keeps its row
        rows.keep(&lent);
        let lent = lent.iter().map(|&node| (scalars.place(node), rows.begin(node))).collect();
        let code = rows.instructions(&row_steps);
        Ok(Program {
            extent,
            constants,
            loads,
            scalar_code,
            scalars: scalars.count as usize,
            lent,
            states,
            code,
            rows: rows.count as usize,
            outputs: outputs.iter().map(|&node| rows.place(node)).collect(),
        })
    }
}

/// What the inputs must bring, and the nodes that depend on the state.
fn survey(graph: &Graph, order: &[Node]) -> (Extent, HashSet<Node>) {
    let (mut extent, mut moving) = (Extent::default(), HashSet::new());
    for &node in order {
        let op = graph.op(node);
        if let Op::Input(input) = op {
            let (most, i) = match input {
                Input::State(i) => (&mut extent.states, i),
                Input::Control(i) => (&mut extent.controls, i),
                Input::Parameter(i) => (&mut extent.parameters, i),
                Input::Measure(i) => (&mut extent.measures, i),
                Input::Time | Input::Step => continue,
            };
            *most = (*most).max((i as usize).saturating_add(1));
        }
        let state = matches!(op, Op::Input(Input::State(_)));
        if state || op.operands().any(|operand| moving.contains(&operand)) {
            moving.insert(node);
        }
    }
    (extent, moving)
}

/// The operations that depend on the state, and those that do not.
fn steps(graph: &Graph, order: &[Node], moving: &HashSet<Node>) -> (Vec<Step>, Vec<Step>) {
    let (mut row_steps, mut scalar_steps) = (Vec::new(), Vec::new());
    let turns = angles(graph, order);
    for &node in order {
        let op = graph.op(node);
        let (code, results) = match op {
            Op::Constant(_) | Op::Input(_) => continue,
            Op::Unary(turn @ (Unary::Sin | Unary::Cos), a) => match turns.get(&a) {
                Some(&[Some(sine), Some(cosine)]) if node == sine.min(cosine) => {
                    (Code::SinCos, vec![sine, cosine])
                }
                Some([Some(_), Some(_)]) => continue,
                _ => (Code::Unary(turn), vec![node]),
            },
            Op::Unary(op, _) => (Code::Unary(op), vec![node]),
            Op::Binary(op, _, _) => (Code::Binary(op), vec![node]),
            Op::Power(_, e) => (power(e), vec![node]),
            Op::Select(_, _, _) => (Code::Select, vec![node]),
        };
        let mut args: Vec<Node> = op.operands().collect();
        if matches!(op, Op::Power(_, 2)) {
            args.extend_from_within(..);
        }
        let steps = if moving.contains(&node) { &mut row_steps } else { &mut scalar_steps };
        steps.push(Step { code, args, results });
    }
    (row_steps, scalar_steps)
}

/// A square is a product; both are the same to the bit.
fn power(e: i32) -> Code {
    if e == 2 { Code::Binary(Binary::Mul) } else { Code::Power(e) }
}

/// The angles whose sine or cosine is wanted, and the nodes of these.
fn angles(graph: &Graph, order: &[Node]) -> HashMap<Node, [Option<Node>; 2]> {
    let mut turns: HashMap<Node, [Option<Node>; 2]> = HashMap::new();
    for &node in order {
        match graph.op(node) {
            Op::Unary(Unary::Sin, a) => turns.entry(a).or_default()[0] = Some(node),
            Op::Unary(Unary::Cos, a) => turns.entry(a).or_default()[1] = Some(node),
            _ => {}
        }
    }
    turns
}
