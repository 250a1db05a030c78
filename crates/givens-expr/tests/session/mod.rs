//! A graph with the names that the tests use.

use givens_expr::{ExprError, Graph, Input, Inputs, Meaning, Node, Program, Scope, parse};

/// Names of every kind of input.
pub const NAMES: [(&str, Input); 11] = [
    ("x", Input::State(0)),
    ("y", Input::State(1)),
    ("vx", Input::State(2)),
    ("vy", Input::State(3)),
    ("w", Input::State(4)),
    ("t", Input::Time),
    ("dt", Input::Step),
    ("u_a", Input::Control(0)),
    ("u_b", Input::Control(1)),
    ("p", Input::Parameter(0)),
    ("q", Input::Parameter(1)),
];

pub struct Session {
    pub graph: Graph,
    pub scope: Scope,
}

#[allow(dead_code, reason = "each test file uses what it needs")]
impl Session {
    pub fn new() -> Self {
        let (mut graph, mut scope) = (Graph::new(), Scope::new());
        for (name, input) in NAMES {
            scope.insert(name, Meaning::Is(graph.input(input)));
        }
        Self { graph, scope }
    }

    pub fn read(&mut self, text: &str) -> Node {
        self.try_read(text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    pub fn try_read(&mut self, text: &str) -> Result<Node, ExprError> {
        parse(&mut self.graph, &self.scope, text)
    }

    pub fn read_all(&mut self, texts: &[&str]) -> Vec<Node> {
        texts.iter().map(|text| self.read(text)).collect()
    }

    pub fn slope(&mut self, node: Node, component: u32) -> Node {
        self.graph.derivative(node, Input::State(component)).unwrap()
    }

    /// The value of one node at a state.
    pub fn value(&self, node: Node, state: &[f64]) -> f64 {
        Program::compile(&self.graph, &[node]).unwrap().values(&Inputs::of_state(state))[0]
    }

    pub fn value_of(&mut self, text: &str, state: &[f64]) -> f64 {
        let node = self.read(text);
        self.value(node, state)
    }
}

/// Whether two numbers agree to a fraction of the larger one, or of one; not-a-number agrees with itself.
#[allow(dead_code, reason = "each test file uses what it needs")]
pub fn close(a: f64, b: f64, tolerance: f64) -> bool {
    a == b || (a - b).abs() <= tolerance * a.abs().max(b.abs()).max(1.0) || a.is_nan() && b.is_nan()
}
