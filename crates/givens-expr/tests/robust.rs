//! Nothing panics and nothing overflows the stack, whatever the text.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod session;

use givens_core::model::At;
use givens_expr::{Graph, GraphError, Input, Inputs, MAX_NODES, Node, Program, Unary, names, parse};
use proptest::prelude::*;
use session::Session;

#[test]
fn deep_nesting_is_an_error() {
    for piece in ["(", "-", "+", "sin(", "2^", "where(not ", "where(x > (", "max(1, ", "((x)*("] {
        let error = Session::new().try_read(&piece.repeat(100_000)).unwrap_err();
        assert!(error.message.contains("nested more than 200 deep"), "{piece}: {error}");
    }
    let deep = format!("{}x{}", "(".repeat(150), ")".repeat(150));
    assert!(Session::new().try_read(&deep).is_ok());
}

#[test]
fn long_sums_are_read_derived_and_compiled() {
    let mut session = Session::new();
    let text = (0..8_000).map(|i| format!("sin(x*{i})")).collect::<Vec<_>>().join(" + ");
    let node = session.read(&text);
    let slope = session.slope(node, 0);
    let program = Program::compile(&session.graph, &[node, slope]).unwrap();
    let wanted: f64 = (0..8_000).map(f64::from).sum();
    assert_eq!(program.values(&Inputs::of_state(&[0.0])), [0.0, wanted]);
}

#[test]
fn a_full_graph_is_an_error_everywhere() {
    let mut session = Session::new();
    let text = (0..MAX_NODES).map(|i| i.to_string()).collect::<Vec<_>>().join("*x + ");
    let error = session.try_read(&text).unwrap_err();
    assert!(error.message.contains("100000 distinct operations"), "{error}");
    assert!(session.graph.is_full() && session.graph.len() == MAX_NODES);
    let x = session.graph.input(Input::State(0));
    assert_eq!(session.graph.derivative(x, Input::State(0)), Err(GraphError::TooLarge));
    assert_eq!(Program::compile(&session.graph, &[x]).unwrap_err(), GraphError::TooLarge);
    assert!(session.try_read("x + 1").is_err());
}

#[test]
fn a_tower_of_derivatives_stays_finite_or_fails() {
    let mut session = Session::new();
    let mut node = session.read("sin(x*exp(sin(x)))*sqrt(1 + x^2)/atan2(x, 2)");
    for _ in 0..12 {
        match session.graph.derivative(node, Input::State(0)) {
            Ok(slope) => node = slope,
            Err(GraphError::TooLarge) => return,
        }
    }
    assert!(session.value(node, &[0.5]).is_finite());
}

#[test]
fn a_node_of_another_graph_does_not_panic() {
    let mut long = Graph::new();
    let x = long.input(Input::State(0));
    let far = (0..100).fold(x, |node, _| long.unary(Unary::Sin, node));
    let mut short = Graph::new();
    let sum = short.add(far, far);
    assert!(short.constant_value(sum).is_some_and(f64::is_nan));
    assert!(short.constant_value(far).is_some_and(f64::is_nan));
    assert!(short.inputs_of(far).is_empty() && !short.is_condition(far));
    let zero = short.constant(0.0);
    assert_eq!(short.derivative(far, Input::State(0)), Ok(zero));
    let program = Program::compile(&short, &[far]).unwrap();
    assert!(program.values(&Inputs::of_state(&[])).iter().all(|value| value.is_nan()));
}

#[test]
fn memory_or_inputs_that_are_too_short_give_not_a_number() {
    let mut session = Session::new();
    let nodes: Vec<Node> = ["x*y", "u_b + p", "t"].iter().map(|text| session.read(text)).collect();
    let program = Program::compile(&session.graph, &nodes).unwrap();
    let need = program.scratch_len(2);
    let (x, u, p) = ([1.0, 2.0, 3.0, 4.0], [1.0, 2.0], [3.0]);
    let run = |x: &[f64], u: &[f64], p: &[f64], outputs: usize, scratch: usize| {
        let at = At { t: 7.0, dt: 0.0, u, p };
        let (mut out, mut scratch) = (vec![0.0; outputs], vec![0.0; scratch]);
        program.eval(&Inputs { at, x, z: &[] }, 2, &mut out, &mut scratch);
        out
    };
    assert_eq!(run(&x, &u, &p, 6, need), [3.0, 8.0, 5.0, 5.0, 7.0, 7.0]);
    let failed = [
        run(&x[..3], &u, &p, 6, need),
        run(&x, &u[..1], &p, 6, need),
        run(&x, &u, &[], 6, need),
        run(&x, &u, &p, 5, need),
        run(&x, &u, &p, 6, need - 1),
    ];
    assert!(failed.iter().flatten().all(|value| value.is_nan()), "{failed:?}");
    // points without end
    program.eval(&Inputs::of_state(&x), usize::MAX, &mut [0.0], &mut [0.0]);
    program.eval(&Inputs::of_state(&x), 0, &mut [], &mut []);
}

const TOKENS: [&str; 48] = [
    "x", "y", "w", "t", "dt", "u_a", "p", "1", "2.5", "1e3", ".5", "3.", "1e", "+", "-", "*", "/", "^", "(",
    ")", "(", ")", ",", "<", "<=", ">", ">=", "==", "!=", "and", "or", "not", "where(", "min(", "max(",
    "sin(", "sqrt(", "atan2(", "pi", "=", "**", "&&", "−", "²", "vz", "ln", "\"", "\n",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn any_text_is_read_or_refused_within_itself(text in any::<String>()) {
        survives(&text)?;
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..60)) {
        survives(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn any_tokens_are_read_or_refused(
        tokens in proptest::collection::vec(proptest::sample::select(&TOKENS[..]), 0..25),
        spaced in any::<bool>(),
    ) {
        survives(&tokens.join(if spaced { " " } else { "" }))?;
    }
}

/// Reads, derives and evaluates a text; a refusal must point into it.
fn survives(text: &str) -> Result<(), TestCaseError> {
    let mut session = Session::new();
    for (span, name) in names(text) {
        prop_assert_eq!(text.get(span), Some(name));
    }
    match parse(&mut session.graph, &session.scope, text) {
        Ok(node) => {
            let slope = session.slope(node, 0);
            let at = At { t: 0.5, dt: 0.1, u: &[1.0, 2.0], p: &[3.0, 4.0] };
            let program = Program::compile(&session.graph, &[node, slope]).unwrap();
            program.values(&Inputs { at, x: &[0.1, 0.2, 0.3, 0.4, 0.5], z: &[] });
        }
        Err(error) => {
            prop_assert!(text.get(error.span.clone()).is_some(), "{:?} in {:?}", error, text);
            prop_assert!(!error.message.is_empty());
        }
    }
    Ok(())
}
