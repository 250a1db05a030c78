//! From the graph to a program.

use std::collections::{HashMap, HashSet};

use crate::graph::{Graph, GraphError, Input, Node, Op};
use crate::operation::{Binary, Unary};

use super::lifetime::{Rows, Step};
use super::{Code, Extent, Given, Place, Program};

impl Program {
    /// Compiles expressions, which may share parts; equal parts are worked out once.
    ///
    /// # Errors
    /// The graph is full.
    pub fn compile(graph: &Graph, outputs: &[Node]) -> Result<Program, GraphError> {
        graph.check()?;
        let order = graph.reachable(outputs);
        let (extent, moving) = survey(graph, &order);
        let (row_steps, scalar_steps) = steps(graph, &order, &moving);

        let read: HashSet<Node> =
            row_steps.iter().chain(&scalar_steps).flat_map(|step| step.args.iter().copied()).collect();
        let read_by_rows = row_steps.iter().flat_map(|step| step.args.iter().copied());
        let kept = read_by_rows.chain(outputs.iter().copied());
        let mut scalars = Rows::new(&scalar_steps, kept, HashMap::new());
        let (mut constants, mut loads) = (Vec::new(), Vec::new());
        for &node in order.iter().filter(|node| read.contains(node) && !moving.contains(node)) {
            match graph.op(node) {
                Op::Constant(bits) => constants.push((f64::from_bits(bits), scalars.begin(node))),
                Op::Input(input) => loads.push((input, scalars.begin(node))),
                _ => {}
            }
        }
        let scalar_code = scalars.instructions(&scalar_steps);
        let mut places: HashMap<Node, Place> =
            scalars.places.iter().map(|(&node, &at)| (node, at.lent())).collect();

        let computed: HashSet<Node> =
            row_steps.iter().flat_map(|step| step.results.iter().copied()).collect();
        let mut given = Vec::new();
        for (i, &node) in outputs.iter().enumerate() {
            let row = i as u32;
            match (graph.op(node), places.get(&node)) {
                (Op::Constant(bits), _) => given.push((row, Given::Constant(f64::from_bits(bits)))),
                (Op::Input(input), _) => given.push((row, Given::Input(input))),
                (_, Some(&Place::Scalar(scalar))) => given.push((row, Given::Scalar(scalar))),
                (_, Some(&Place::Output(first))) => given.push((row, Given::Output(first))),
                _ if computed.contains(&node) => {
                    places.insert(node, Place::Output(row));
                }
                _ => given.push((row, Given::Constant(f64::NAN))),
            }
        }

        let mut rows = Rows::new(&row_steps, core::iter::empty(), places);
        let mut states = Vec::new();
        for &node in order.iter().filter(|node| read.contains(node)) {
            if let Op::Input(Input::State(i)) = graph.op(node) {
                states.push((i, rows.begin(node)));
            }
        }
        let code = rows.instructions(&row_steps);
        let (scalars, registers) = (scalars.count as usize, rows.count as usize);
        let outputs = outputs.len();
        Ok(Program {
            outputs,
            extent,
            constants,
            loads,
            scalar_code,
            scalars,
            states,
            code,
            registers,
            given,
        })
    }
}

impl Place {
    /// The place as the section of rows sees it.
    fn lent(self) -> Place {
        match self {
            Place::Register(row) => Place::Scalar(row),
            other => other,
        }
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
