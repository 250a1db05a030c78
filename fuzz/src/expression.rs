//! The text of an expression: read or refused within itself; what is read is derived, compiled and evaluated.

use givens_core::model::At;
use givens_expr::{Graph, Input, Inputs, Meaning, Node, Program, Scope, is_name, names, parse, parse_any};

/// What expressions are made of.
pub(crate) const WORDS: &[&str] = &[
    "x", "y", "vx", "t", "dt", "u_a", "p", "known", "if_high", "z", "rate(x)", "rate(", "pi", "1", "0",
    "2.5", "1e308", "1e-320", "1e3", ".5", "3.", "1e", "+", "-", "*", "/", "^", "^2", "^-1", "^0.5", "^33",
    "(", ")", ", ", "<", "<=", ">", ">=", "==", "!=", " and ", " or ", "not ", "where(", "min(", "max(",
    "sin(", "cos(", "tan(", "asin(", "acos(", "atan(", "atan2(", "sqrt(", "hypot(", "exp(", "log(", "log10(",
    "sinh(", "cosh(", "tanh(", "erf(", "erfc(", "abs(", "sign(", "floor(", "x*x", "=", "**", "&&", "−", "²",
    "vz", "ln", "\"", "\n", "ω",
];

/// Points at the ends of what there is: two states of seven points, component by component.
const POINTS: [f64; 14] = [
    0.0,
    -0.0,
    1.5,
    f64::NAN,
    f64::INFINITY,
    1e308,
    -5e-324,
    2.0,
    0.0,
    -1.0,
    3.0,
    f64::NEG_INFINITY,
    1e-160,
    0.5,
];

pub(crate) fn body(data: &[u8]) {
    let text = &*String::from_utf8_lossy(data);
    for (span, name) in names(text) {
        assert_eq!(text.get(span), Some(name));
        assert!(is_name(name));
    }
    let (mut graph, scope) = known();
    let before = graph.len();
    match parse_any(&mut graph, &scope, text) {
        Err(error) => {
            assert!(text.get(error.span.clone()).is_some(), "{error:?}");
            assert!(!error.message.is_empty() && !error.to_string().contains('\n') || text.contains('\n'));
        }
        Ok(node) => {
            let made = graph.len();
            assert!(made - before <= 3 * text.len() + 3, "{made} nodes of {} bytes", text.len());
            let number = parse(&mut graph, &scope, text);
            assert_eq!(number.is_ok(), !graph.is_condition(node));
            assert_eq!(graph.len(), made, "the same text made other nodes");
            if let Ok(same) = parse_any(&mut graph, &scope, &format!("({text})")) {
                assert_eq!(same, node, "parentheses around it made another node");
            }
            evaluate(&mut graph, node);
        }
    }
}

/// The names that may stand in the text.
fn known() -> (Graph, Scope) {
    let (mut graph, mut scope) = (Graph::new(), Scope::new());
    let inputs = [
        ("x", Input::State(0)),
        ("vx", Input::State(1)),
        ("t", Input::Time),
        ("dt", Input::Step),
        ("u_a", Input::Control(0)),
        ("p", Input::Parameter(0)),
    ];
    for (name, input) in inputs {
        scope.insert(name, Meaning::Is(graph.input(input)));
    }
    scope.insert("y", Meaning::Forbidden("it is not measured".into()));
    let z = graph.input(Input::Measure(0));
    scope.insert_of("rate", "x", Meaning::Is(z));
    for (name, text) in [("known", "sqrt(x^2 + p)"), ("if_high", "x > p")] {
        let node = parse_any(&mut graph, &scope, text).expect("it is an expression");
        scope.insert(name, Meaning::Is(node));
    }
    (graph, scope)
}

/// A point by itself and among others, in both precisions, with first and second derivatives.
fn evaluate(graph: &mut Graph, node: Node) {
    let mut nodes = vec![node];
    for input in [Input::State(0), Input::State(1), Input::Time, Input::Parameter(0)] {
        let Ok(slope) = graph.derivative(node, input) else { return };
        let Ok(second) = graph.derivative(slope, Input::State(0)) else { return };
        nodes.extend([slope, second]);
    }
    let condition = graph.is_condition(node);
    let Ok(program) = Program::compile(graph, &nodes) else { return };
    let count = POINTS.len() / 2;
    let at = At { t: 0.5, dt: 0.1, u: &[2.0], p: &[3.0] };
    let (mut out, mut scratch) = (vec![0.5; nodes.len() * count], vec![f64::NAN; program.scratch_len(count)]);
    program.eval(&Inputs { at, x: &POINTS, z: &[4.0] }, count, &mut out, &mut scratch);
    for j in 0..count {
        let alone = program.values(&Inputs { at, x: &[POINTS[j], POINTS[count + j]], z: &[4.0] });
        for (i, value) in alone.into_iter().enumerate() {
            let among = out[i * count + j];
            assert!(
                value.to_bits() == among.to_bits() || value.is_nan() && among.is_nan(),
                "{value} {among}"
            );
        }
        assert!(!condition || out[j] == 0.0 || out[j] == 1.0, "a condition is {}", out[j]);
    }
    let x = POINTS.map(|x| x as f32);
    let at = At { t: 0.5_f32, dt: 0.1, u: &[2.0], p: &[3.0] };
    let (mut out, mut scratch) = (vec![0.5; nodes.len() * count], vec![f32::NAN; program.scratch_len(count)]);
    program.eval(&Inputs { at, x: &x, z: &[4.0] }, count, &mut out, &mut scratch);
}
