//! The coordinated turn and its radar, in expressions.

use givens_expr::{
    Graph, Input, Meaning, ModelObservation, ModelTransition, Node, NoiseBlock, ObservationParts, Scope,
    TransitionParts, parse,
};

/// A graph, and the nodes of texts in the words of the coordinated turn.
pub struct Turn {
    pub graph: Graph,
    pub scope: Scope,
}

const TURN: [&str; 5] = [
    "x + along*vx - across*vy",
    "cos(w*dt)*vx - sin(w*dt)*vy",
    "y + across*vx + along*vy",
    "sin(w*dt)*vx + cos(w*dt)*vy",
    "w",
];

#[allow(dead_code, reason = "each test file uses what it needs")]
impl Turn {
    pub fn new() -> Self {
        let (mut graph, mut scope) = (Graph::new(), Scope::new());
        for (i, name) in ["x", "vx", "y", "vy", "w"].into_iter().enumerate() {
            scope.insert(name, Meaning::Is(graph.input(Input::State(i as u32))));
        }
        let inputs =
            [("dt", Input::Step), ("t", Input::Time), ("p", Input::Parameter(0)), ("u_a", Input::Control(0))];
        for (name, input) in inputs {
            scope.insert(name, Meaning::Is(graph.input(input)));
        }
        let mut turn = Self { graph, scope };
        for (name, text) in [
            ("half", "0.5*w*dt"),
            ("along", "where(abs(half) < 1e-9, dt, sin(w*dt)/w)"),
            ("across", "where(abs(half) < 1e-9, half*dt, 2*sin(half)*sin(half)/w)"),
        ] {
            let node = turn.read(text);
            turn.scope.insert(name, Meaning::Is(node));
        }
        turn
    }

    pub fn read(&mut self, text: &str) -> Node {
        parse(&mut self.graph, &self.scope, text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    pub fn read_all(&mut self, texts: &[&str]) -> Vec<Node> {
        texts.iter().map(|text| self.read(text)).collect()
    }

    pub fn transition(&mut self) -> ModelTransition {
        let next = self.read_all(&TURN);
        let block = ["0.1*dt^3/3", "0.1*dt^2/2", "0.1*dt^2/2", "0.1*dt"];
        let mut noise_cov = self.read_all(&["0"; 25]);
        for axis in [0, 2] {
            for (i, text) in block.into_iter().enumerate() {
                noise_cov[(axis + i / 2) * 5 + axis + i % 2] = self.read(text);
            }
        }
        noise_cov[24] = self.read("1.75e-4*dt");
        let parts = TransitionParts { states: 5, next, noise_cov, ..Default::default() };
        ModelTransition::new(&mut self.graph, parts).unwrap()
    }

    pub fn radar(&mut self) -> ModelObservation {
        let parts = ObservationParts {
            states: 5,
            measures: self.read_all(&["hypot(x, y)", "atan2(y, x)"]),
            angles: vec![None, Some(core::f64::consts::TAU)],
            noise: vec![NoiseBlock::Std(self.read_all(&["10", "0.0031622776601683795"]))],
            ..Default::default()
        };
        ModelObservation::new(&mut self.graph, parts).unwrap()
    }
}
