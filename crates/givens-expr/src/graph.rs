//! The graph in which expressions meet: every distinct subexpression stands in it once.

use core::fmt;
use std::collections::{BTreeSet, HashMap};

use givens_core::scalar::Real;

use crate::operation::{Binary, Unary};

/// The most nodes that a graph holds.
pub const MAX_NODES: usize = 100_000;

/// A quantity that an expression is a function of; components are counted from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Input {
    /// A component of the state.
    State(u32),
    /// Time.
    Time,
    /// Length of the step.
    Step,
    /// A control.
    Control(u32),
    /// A parameter.
    Parameter(u32),
    /// A component of a measurement.
    Measure(u32),
}

/// An expression in a [`Graph`]: an index, valid in the graph that gave it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Node(u32);

impl Node {
    /// What stands for a node that could not be made: not a number.
    const NAN: Node = Node(0);

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }

    /// The number by which a front end in another language knows it; see [`Graph::node`].
    #[must_use]
    pub fn number(self) -> u32 {
        self.0
    }
}

/// How a node is made from others, which all have smaller indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Op {
    /// The bits of an `f64`.
    Constant(u64),
    Input(Input),
    Unary(Unary, Node),
    Binary(Binary, Node, Node),
    Power(Node, i32),
    /// Condition, value where it holds, value where it does not.
    Select(Node, Node, Node),
}

impl Op {
    pub(crate) fn operands(self) -> impl Iterator<Item = Node> {
        let all = match self {
            Op::Constant(_) | Op::Input(_) => [None; 3],
            Op::Unary(_, a) | Op::Power(a, _) => [Some(a), None, None],
            Op::Binary(_, a, b) => [Some(a), Some(b), None],
            Op::Select(c, a, b) => [Some(c), Some(a), Some(b)],
        };
        all.into_iter().flatten()
    }
}

/// Expressions as a graph without cycles in which equal subexpressions are one node.
///
/// The operations fold constants and apply only such algebra as holds for every number, not-a-number included, but
/// for the sign of a zero: x·1, x + 0, x − 0, x/1, −(−x), x^1, x^0. In particular 0·x stays. A condition is the
/// number one where it holds and zero where it does not; a number used as a condition holds where it is not zero.
///
/// A graph that holds [`MAX_NODES`] nodes is full: further operations give not-a-number, and
/// [`parse`](crate::parse()), [`derivative`](Graph::derivative) and [`Program::compile`](crate::Program::compile)
/// refuse it. A node of another graph may be taken for one of this or for not-a-number, but never panics.
///
/// ```
/// use givens_expr::{Graph, Input, Unary};
/// let mut graph = Graph::new();
/// let x = graph.input(Input::State(0));
/// let sine = graph.unary(Unary::Sin, x);
/// let slope = graph.derivative(sine, Input::State(0))?;
/// assert_eq!(slope, graph.unary(Unary::Cos, x));
/// # Ok::<(), givens_expr::GraphError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Graph {
    ops: Vec<Op>,
    known: HashMap<Op, Node>,
    full: bool,
}

impl Default for Graph {
    fn default() -> Self {
        Self::new()
    }
}

impl Graph {
    /// An empty graph.
    #[must_use]
    pub fn new() -> Self {
        let mut graph = Self { ops: Vec::new(), known: HashMap::new(), full: false };
        graph.constant(f64::NAN);
        graph
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Whether nothing has been put in yet.
    pub fn is_empty(&self) -> bool {
        self.ops.len() <= 1
    }

    /// Whether an operation has failed because the graph held [`MAX_NODES`] nodes.
    pub fn is_full(&self) -> bool {
        self.full
    }

    /// An error if the graph is full.
    pub(crate) fn check(&self) -> Result<(), GraphError> {
        if self.full { Err(GraphError::TooLarge) } else { Ok(()) }
    }

    /// The node of this number, if there is one.
    pub fn node(&self, number: u32) -> Option<Node> {
        ((number as usize) < self.ops.len()).then_some(Node(number))
    }

    /// The quantity `input`.
    pub fn input(&mut self, input: Input) -> Node {
        self.push(Op::Input(input))
    }

    /// The number `value`.
    pub fn constant(&mut self, value: f64) -> Node {
        let value = if value.is_nan() { f64::NAN } else { value };
        self.push(Op::Constant(value.to_bits()))
    }

    /// The value of a node that is a constant.
    pub fn constant_value(&self, node: Node) -> Option<f64> {
        match self.op(node) {
            Op::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// Whether a node is a comparison or a combination of comparisons.
    pub fn is_condition(&self, node: Node) -> bool {
        match self.op(node) {
            Op::Unary(op, _) => op.is_condition(),
            Op::Binary(op, _, _) => op.is_condition(),
            _ => false,
        }
    }

    /// All that a node depends on.
    pub fn inputs_of(&self, node: Node) -> BTreeSet<Input> {
        self.inputs_of_all(&[node])
    }

    /// All that any of several nodes depends on.
    pub fn inputs_of_all(&self, nodes: &[Node]) -> BTreeSet<Input> {
        let reachable = self.reachable(nodes);
        let inputs = reachable.into_iter().filter_map(|node| match self.op(node) {
            Op::Input(input) => Some(input),
            _ => None,
        });
        inputs.collect()
    }

    /// Which of several nodes depend on no other inputs than those that `may` accepts.
    pub fn depend_only_on(&self, nodes: &[Node], may: impl Fn(Input) -> bool) -> Vec<bool> {
        let order = self.reachable(nodes);
        let mut does = vec![false; order.last().map_or(0, |node| node.index() + 1)];
        for node in order {
            let op = self.op(node);
            does[node.index()] = match op {
                Op::Input(input) => may(input),
                _ => op.operands().all(|operand| does[operand.index()]),
            };
        }
        nodes.iter().map(|node| does.get(node.index()).copied().unwrap_or(true)).collect()
    }

    pub(crate) fn op(&self, node: Node) -> Op {
        self.ops.get(node.index()).copied().unwrap_or(Op::Constant(f64::NAN.to_bits()))
    }

    /// The node, or not-a-number if it is another graph's.
    pub(crate) fn own(&self, node: Node) -> Node {
        if node.index() < self.ops.len() { node } else { Node::NAN }
    }

    /// The nodes that `nodes` are made of, themselves included, operands first.
    pub(crate) fn reachable(&self, nodes: &[Node]) -> Vec<Node> {
        let valid = nodes.iter().filter(|node| node.index() < self.ops.len());
        let mut wanted = vec![false; valid.clone().map(|node| node.index() + 1).max().unwrap_or(0)];
        valid.for_each(|node| wanted[node.index()] = true);
        let mut found = Vec::new();
        for index in (0..wanted.len()).rev() {
            if wanted[index] {
                let node = Node(index as u32);
                found.push(node);
                self.op(node).operands().for_each(|operand| wanted[operand.index()] = true);
            }
        }
        found.reverse();
        found
    }

    /// The node of an operation, a new one if there is none yet.
    pub(crate) fn push(&mut self, op: Op) -> Node {
        if let Some(&node) = self.known.get(&op) {
            return node;
        }
        if self.ops.len() >= MAX_NODES {
            self.full = true;
            return Node::NAN;
        }
        if op.operands().any(|operand| operand.index() >= self.ops.len()) {
            return Node::NAN;
        }
        let node = Node(self.ops.len() as u32);
        self.ops.push(op);
        self.known.insert(op, node);
        node
    }

    /// The constant that an operation on constants gives, by the same functions that evaluate it later.
    pub(crate) fn fold(&self, op: Op) -> Option<f64> {
        let value = |node| self.constant_value(node);
        match op {
            Op::Unary(op, a) if !op.is_condition() => Some(op.apply(value(a)?)),
            Op::Binary(op, a, b) if !op.is_condition() => Some(op.apply(value(a)?, value(b)?)),
            Op::Power(a, e) => Some(Real::powi(value(a)?, e)),
            _ => None,
        }
    }
}

/// Why a graph refuses to go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GraphError {
    /// The graph holds [`MAX_NODES`] nodes.
    TooLarge,
}

impl fmt::Display for GraphError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            GraphError::TooLarge => write!(
                f,
                "the expressions and their derivatives have more than {MAX_NODES} distinct operations: \
                 shorten them"
            ),
        }
    }
}

impl core::error::Error for GraphError {}
