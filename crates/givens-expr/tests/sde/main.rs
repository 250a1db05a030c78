//! Continuous models of expressions: their derivatives by symbol against those by duals and by differences.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod expansion;
mod filters;
mod parts;

use givens_core::model::{At, Sde, Varies};
use givens_core::scalar::Real;
use givens_expr::{Graph, Input, Meaning, ModelError, ModelSde, Node, Scope, SdeParts, parse};

/// Two parameters `a`, `b` and a control `u_f` beside the states x0, x1, …
fn scope(graph: &mut Graph, states: usize) -> Scope {
    let mut scope = Scope::new();
    let states = (0..states).map(|i| (format!("x{i}"), Input::State(i as u32)));
    let others = [
        ("t", Input::Time),
        ("dt", Input::Step),
        ("u_f", Input::Control(0)),
        ("a", Input::Parameter(0)),
        ("b", Input::Parameter(1)),
    ];
    for (name, input) in states.chain(others.map(|(name, input)| (name.to_string(), input))) {
        scope.insert(name, Meaning::Is(graph.input(input)));
    }
    scope
}

fn model<S: AsRef<str>>(drift: &[S], diffusion: &[S]) -> Result<ModelSde, ModelError> {
    let mut graph = Graph::new();
    let scope = scope(&mut graph, drift.len());
    let mut read = |texts: &[S]| -> Vec<Node> {
        texts.iter().map(|text| parse(&mut graph, &scope, text.as_ref()).unwrap()).collect()
    };
    let parts = SdeParts {
        states: drift.len(),
        controls: 1,
        parameters: vec![0.7, -0.4],
        drift: read(drift),
        diffusion: read(diffusion),
        noises: diffusion.len() / drift.len(),
    };
    ModelSde::new(&mut graph, parts)
}

/// The same model with nothing but its two required bodies.
struct ByDuals<'m>(&'m ModelSde);

impl Sde for ByDuals<'_> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn noises(&self) -> usize {
        self.0.noises()
    }
    fn controls(&self) -> usize {
        self.0.controls()
    }
    fn parameters(&self) -> &[f64] {
        self.0.parameters()
    }
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        self.0.drift(at, x, dx);
    }
    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        self.0.diffusion(at, x, g);
    }
    fn diffusion_varies(&self) -> Varies {
        self.0.diffusion_varies()
    }
}

/// Texts of drift and diffusion.
type Texts = (Vec<String>, Vec<String>);

fn texts(drift: &[&str], diffusion: &[&str]) -> Texts {
    let owned = |texts: &[&str]| texts.iter().map(|text| (*text).to_string()).collect();
    (owned(drift), owned(diffusion))
}

/// Models whose derivatives take every turn: time, parameters, controls, choices, full and missing columns of G.
fn models() -> Vec<Texts> {
    vec![
        texts(&["x1", "a*(1 - x0^2)*x1 - x0 + u_f*cos(b*t)"], &["0", "0.2", "exp(-t)", "a"]),
        texts(
            &["where(x0 > 0.1, sin(x0*x1)*t, x0^3*x1)", "x2*x1 - t^2", "atan2(x0, 1 + x1^2) + u_f*x2"],
            &["0.5", "0", "u_f", "a*b", "0", "1 + t"],
        ),
        texts(&["-x1*x2", "x0*x2", "0"], &["0.3", "0", "0", "0", "0.3", "0", "0", "0", "0.02"]),
        texts(&["hypot(x0, x1)*exp(-x1)", "sqrt(1 + x0^2)/x1"], &["0", "0"]),
        texts(
            &["abs(x0)*min(x0, x1)^2 + floor(x1)*x0^2", "max(x0, 0.2)^(1.5 + x1) + tanh(x0)*sign(x1)"],
            &["b", "1", "0", "a*u_f"],
        ),
        (lorenz96(9), diagonal(9)),
        (lorenz96(5), full(5)),
    ]
}

fn lorenz96(n: usize) -> Vec<String> {
    let x = |i: usize| format!("x{}", i % n);
    (0..n).map(|i| format!("({} - {})*{} - {} + 8", x(i + 1), x(i + n - 2), x(i + n - 1), x(i))).collect()
}

fn diagonal(n: usize) -> Vec<String> {
    (0..n * n).map(|k| if k % (n + 1) == 0 { "0.1 + a".into() } else { "0".into() }).collect()
}

fn full(n: usize) -> Vec<String> {
    (0..n * n).map(|k| format!("a*{}", 0.1 + (0.7 * k as f64).sin())).collect()
}

/// States near one, those of three points side by side.
fn states(n: usize) -> Vec<f64> {
    (0..3 * n).map(|k| 0.3 + (2.7 * k as f64).sin()).collect()
}

fn near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len());
    for (k, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= tolerance * (1.0 + b.abs()), "{what}, entry {k}: {a} for {b}");
    }
}
