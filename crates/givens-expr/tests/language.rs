//! What expressions mean.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod session;

use givens_core::scalar::Real;
use givens_expr::{Binary, Input, Meaning, Unary, functions, is_reserved, names, parse_any};
use session::{Session, close};

const STATE: [f64; 5] = [0.6, -0.3, 2.5, 0.25, -1.5];

#[test]
fn operators_bind_as_documented() {
    let table = [
        ("1 + 2*3", "1 + (2*3)"),
        ("x - y - w", "(x - y) - w"),
        ("x / y / w", "(x / y) / w"),
        ("x / y * w", "(x / y) * w"),
        ("x^y^w", "x^(y^w)"),
        ("-x^2", "-(x^2)"),
        ("(-x)^2", "(-x)*(-x)"),
        ("2^-1", "0.5"),
        ("2^-x^2", "2^(-(x^2))"),
        ("x^-y*w", "(x^(-y))*w"),
        ("-x*y", "(-x)*y"),
        ("x*-y", "x*(-y)"),
        ("x - -y", "x + y"),
        ("+x", "x"),
        ("--x", "x"),
        ("x*y^2", "x*(y^2)"),
        ("where(x + 1 < y*2, 1, 2)", "where((x + 1) < (y*2), 1, 2)"),
        ("where(x > y, 1, 2)", "where(y < x, 1, 2)"),
        ("where(x >= y, 1, 2)", "where(y <= x, 1, 2)"),
        ("where(x != y, 1, 2)", "where(not x == y, 1, 2)"),
        ("where(not x < y and y < w, 1, 2)", "where((not (x < y)) and (y < w), 1, 2)"),
        ("where(x < y or y < w and w < 1, 1, 2)", "where((x < y) or ((y < w) and (w < 1)), 1, 2)"),
        ("where(not not x < y, 1, 2)", "where(not (not (x < y)), 1, 2)"),
        ("min(x, y, w)", "min(min(x, y), w)"),
        ("max(x, y, w, vx)", "max(max(max(x, y), w), vx)"),
        ("1.5e2 + .5 + 2. + 1E-3", "150 + 0.5 + 2 + 0.001"),
        ("\t x\n+ y ", "x+y"),
    ];
    for (text, meant) in table {
        let mut session = Session::new();
        let (read, meant_node) = (session.read(text), session.read(meant));
        let (value, wanted) = (session.value(read, &STATE), session.value(meant_node, &STATE));
        assert!(value == wanted || value.is_nan() && wanted.is_nan(), "{text}: {value}, not {wanted}");
        assert!(read == meant_node || text.contains("(-x)^2"), "{text} is not {meant}");
    }
}

#[test]
fn arithmetic_gives_known_numbers() {
    let table = [
        ("2 + 3*4^2/8 - 1", 7.0),
        ("2^3^2", 512.0),
        ("-2^2", -4.0),
        ("7 - 2 - 1", 4.0),
        ("2*pi", core::f64::consts::TAU),
        ("where(1 < 2 and not 2 < 1, 3, 4)", 3.0),
        ("where(1 == 2 or 1 != 1, 3, 4)", 4.0),
        ("where(2 >= 2, 3, 4) + where(2 <= 1, 10, 20)", 23.0),
        ("min(3, 1, 2) + 10*max(3, 1, 2)", 31.0),
        ("sign(-3) + sign(0) + 5*sign(2)", 4.0),
        ("floor(-1.5)", -2.0),
        ("log10(1000)", 3.0),
        ("hypot(3, -4)", 5.0),
        ("atan2(1, -1)", 3.0 * core::f64::consts::FRAC_PI_4),
    ];
    for (text, wanted) in table {
        let value = Session::new().value_of(text, &STATE);
        assert!(close(value, wanted, 1e-15), "{text}: {value}, not {wanted}");
    }
}

/// The functions of one argument as std computes them.
fn of_std(name: &str, a: f64) -> f64 {
    match name {
        "abs" => a.abs(),
        "sign" if a == 0.0 => 0.0,
        "sign" => a.signum(),
        "floor" => a.floor(),
        "sqrt" => a.sqrt(),
        "exp" => a.exp(),
        "log" => a.ln(),
        "log10" => a.log10(),
        "sin" => a.sin(),
        "cos" => a.cos(),
        "tan" => a.tan(),
        "asin" => a.asin(),
        "acos" => a.acos(),
        "atan" => a.atan(),
        "sinh" => a.sinh(),
        "cosh" => a.cosh(),
        "tanh" => a.tanh(),
        "erf" => Real::erf(a),
        "erfc" => Real::erfc(a),
        other => panic!("{other} is not tested"),
    }
}

#[test]
fn every_function_of_one_argument_is_std() {
    let two_or_more = ["where", "min", "max", "hypot", "atan2"];
    for name in functions().filter(|name| !two_or_more.contains(name)) {
        for a in [-2.5, -1.0, -0.3, -0.0, 0.0, 0.2, 0.999, 1.0, 3.7, 80.0, f64::INFINITY, f64::NAN] {
            let value = Session::new().value_of(&format!("{name}(x)"), &[a]);
            let wanted = of_std(name, a);
            assert!(close(value, wanted, 4e-16), "{name}({a}): {value}, not {wanted}");
        }
    }
}

#[test]
fn functions_of_two_arguments_are_std() {
    type OfTwo = fn(f64, f64) -> f64;
    let table: [(&str, OfTwo); 6] = [
        ("atan2(x, y)", f64::atan2),
        ("hypot(x, y)", f64::hypot),
        ("min(x, y)", f64::min),
        ("max(x, y)", f64::max),
        ("x^y", f64::powf),
        ("where(x < y, x, y)", f64::min),
    ];
    for (text, std) in table {
        for x in [-2.5, -0.0, 0.0, 0.4, 3.0] {
            for y in [-1.5, -1.0, 0.0, 0.7, 2.0] {
                let value = Session::new().value_of(text, &[x, y]);
                assert!(close(value, std(x, y), 4e-16), "{text} at {x}, {y}: {value}, not {}", std(x, y));
            }
        }
    }
}

#[test]
fn whole_powers_agree_with_pow() {
    for e in [-33, -32, -7, -3, -1, 0, 1, 2, 3, 4, 5, 17, 32, 33, 100] {
        for x in [-1.7, 0.3, 2.0] {
            let value = Session::new().value_of(&format!("x^({e})"), &[x]);
            assert!(close(value, f64::powf(x, f64::from(e)), 1e-14), "{x}^{e}");
        }
    }
}

#[test]
fn equal_subexpressions_are_one_node() {
    let mut session = Session::new();
    let before = session.read("sin(x*dt)*vx + (1 - cos(x*dt))");
    let nodes = session.graph.len();
    let again = session.read("(1 - cos(dt*x)) + vx*sin(dt*x)");
    assert_eq!(before, again);
    assert_eq!(session.graph.len(), nodes);
}

#[test]
fn neutral_operations_leave_no_node() {
    let mut session = Session::new();
    let x = session.read("x");
    for text in
        ["x*1", "1*x", "x + 0", "0 + x", "x - 0", "x/1", "x^1", "-(-x)", "(x*-1)*-1", "where(x < 1, x, x)"]
    {
        assert_eq!(session.read(text), x, "{text}");
    }
    assert_eq!(session.read("x^0.5"), session.read("sqrt(x)"));
    assert_eq!(session.read("x*x"), session.read("x^2"));
}

#[test]
fn a_product_with_zero_keeps_what_is_not_a_number() {
    let mut session = Session::new();
    assert!(session.value_of("0*x", &[f64::NAN]).is_nan());
    assert!(session.value_of("x - x", &[f64::INFINITY]).is_nan());
    assert!(session.value_of("x/x", &[0.0]).is_nan());
    let node = session.read("0*x + y");
    assert!(session.graph.inputs_of(node).contains(&Input::State(0)));
}

#[test]
fn inputs_of_an_expression_are_found_in_order() {
    let mut session = Session::new();
    let node = session.read("where(t > 1, u_b*y, q) + x + dt");
    let inputs: Vec<Input> = session.graph.inputs_of(node).into_iter().collect();
    let wanted =
        [Input::State(0), Input::State(1), Input::Time, Input::Step, Input::Control(1), Input::Parameter(1)];
    assert_eq!(inputs, wanted);
    assert!(session.graph.inputs_of(session.graph.clone().constant(1.0)).is_empty());
}

#[test]
fn a_definition_may_be_a_condition() {
    let mut session = Session::new();
    let near = parse_any(&mut session.graph, &session.scope, "hypot(x, y) < 5").unwrap();
    session.scope.insert("near", Meaning::Is(near));
    assert_eq!(session.value_of("where(near and x > 0, 1, 2)", &[3.0, 1.0]), 1.0);
    assert_eq!(session.value_of("where(near and x > 0, 1, 2)", &[3.0, 10.0]), 2.0);
    let error = session.try_read("near + 1").unwrap_err();
    assert_eq!(error.span, 0..4);
    // also where it is known before
    let sure = parse_any(&mut session.graph, &session.scope, "1 < 2").unwrap();
    session.scope.insert("sure", Meaning::Is(sure));
    assert_eq!(session.value_of("where(sure, 1, 2)", &[]), 1.0);
}

#[test]
fn a_condition_in_the_graph_is_one_or_zero() {
    let mut session = Session::new();
    let (x, y) = (session.read("x"), session.read("y"));
    let less = session.graph.binary(Binary::Less, x, y);
    let sum = session.graph.add(less, less);
    assert_eq!((session.value(sum, &[1.0, 2.0]), session.value(sum, &[2.0, 1.0])), (2.0, 0.0));
    let both = session.graph.binary(Binary::And, x, y);
    let neither = session.graph.unary(Unary::Not, x);
    assert_eq!((session.value(both, &[3.0, -2.0]), session.value(neither, &[0.0])), (1.0, 1.0));
}

#[test]
fn names_are_found_also_in_wrong_text() {
    let found: Vec<_> = names("a + 2b*sin(u_1) ) $ ω2").map(|(span, name)| (span.start, name)).collect();
    assert_eq!(found, [(0, "a"), (7, "sin"), (11, "u_1"), (20, "ω2")]);
    assert!(functions().all(is_reserved) && is_reserved("pi") && is_reserved("not") && !is_reserved("x"));
}
