//! First and second derivatives: against duals, against differences, and at the places where there is none.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod session;

use givens_core::scalar::{Dual2, Real};
use givens_expr::{Input, Inputs, Program};
use session::{Session, close};

/// Expressions in x and y, and points within their domain.
const FUNCTIONS: &[(&str, &[f64])] = &[
    ("abs(x)", &[-1.3, 0.4]),
    ("sign(x)*x^2", &[-1.3, 0.4]),
    ("floor(x)*x", &[-1.3, 0.4]),
    ("sqrt(x)", &[0.2, 9.0]),
    ("exp(x)", &[-2.0, 0.4]),
    ("log(x)", &[0.1, 30.0]),
    ("log10(x)", &[0.1, 30.0]),
    ("sin(x)", &[-2.0, 0.4]),
    ("cos(x)", &[-2.0, 0.4]),
    ("tan(x)", &[-1.0, 0.4]),
    ("asin(x)", &[-0.8, 0.4]),
    ("acos(x)", &[-0.8, 0.4]),
    ("atan(x)", &[-3.0, 0.4]),
    ("sinh(x)", &[-2.0, 0.4]),
    ("cosh(x)", &[-2.0, 0.4]),
    ("tanh(x)", &[-2.0, 0.4]),
    ("erf(x)", &[-2.0, 0.4]),
    ("erfc(x)", &[-2.0, 0.4]),
    ("erf(x*y)", &[-2.0, 0.4]),
    ("x + y", &[-2.0, 0.4]),
    ("x - y*x", &[-2.0, 0.4]),
    ("y - x", &[-2.0, 0.4]),
    ("x*y*x", &[-2.0, 0.4]),
    ("y/x", &[-2.0, 0.4]),
    ("x/y", &[-2.0, 0.4]),
    ("(x + y)/(x*y - 3)", &[-2.0, 0.4]),
    ("x^3", &[-2.0, 0.4]),
    ("x^-2", &[-2.0, 0.4]),
    ("x^40", &[-1.1, 0.9]),
    ("x^1.5", &[0.2, 3.0]),
    ("x^y", &[0.2, 3.0]),
    ("y^x", &[-2.0, 0.4]),
    ("x^x", &[0.2, 3.0]),
    ("2^x", &[-2.0, 0.4]),
    ("hypot(x, y)", &[-2.0, 0.4]),
    ("hypot(y, x)", &[-2.0, 0.4]),
    ("hypot(x, 3*x + y)", &[-2.0, 0.4]),
    ("atan2(x, y)", &[-2.0, 0.4]),
    ("atan2(y, x)", &[-2.0, 0.4]),
    ("atan2(x^2, y - x)", &[-2.0, 0.4]),
    ("min(x, x^2, y)", &[-2.0, 0.4, 1.7]),
    ("max(x, x^2, y)", &[-2.0, 0.4, 1.7]),
    ("where(x < y, sin(x), x^3)", &[-2.0, 0.4, 1.7]),
    ("where(x > 0 and not x > 1, x^2, x^3)", &[-2.0, 0.4, 1.7]),
    ("sin(x*y)*exp(-x^2)/sqrt(1 + x^2)", &[-2.0, 0.4]),
    ("log(x^2 + y^2)", &[-2.0, 0.4]),
];

const Y: f64 = 0.7;

#[test]
fn first_and_second_derivatives_are_those_of_duals() {
    for &(text, points) in FUNCTIONS {
        let mut session = Session::new();
        let node = session.read(text);
        let first = session.slope(node, 0);
        let second = session.slope(first, 0);
        let program = Program::compile(&session.graph, &[node, first, second]).unwrap();
        for &x in points {
            let [value, slope, bend] = program.values(&Inputs::of_state(&[x, Y]))[..] else { panic!() };
            let dual = dual_value(&session, node, [Dual2::variable(x), Dual2::of(Y)]);
            assert!(close(value, dual.v, 1e-14), "{text} at {x}: {value} {dual:?}");
            assert!(close(slope, dual.d, 1e-13), "{text}' at {x}: {slope} {dual:?}");
            assert!(close(bend, dual.dd, 1e-12), "{text}'' at {x}: {bend} {dual:?}");
        }
    }
}

#[test]
fn mixed_derivatives_are_those_of_duals() {
    // along (1, 1): f_xx + 2 f_xy + f_yy
    for &(text, points) in FUNCTIONS {
        let mut session = Session::new();
        let node = session.read(text);
        let (by_x, by_y) = (session.slope(node, 0), session.slope(node, 1));
        let parts =
            [session.slope(by_x, 0), session.slope(by_x, 1), session.slope(by_y, 0), session.slope(by_y, 1)];
        let program = Program::compile(&session.graph, &parts).unwrap();
        for &x in points {
            let [xx, xy, yx, yy] = program.values(&Inputs::of_state(&[x, Y]))[..] else { panic!() };
            assert!(close(xy, yx, 1e-12), "{text} at {x}: {xy}, {yx}");
            let dual = dual_value(&session, node, [Dual2::variable(x), Dual2::variable(Y)]);
            assert!(close(xx + xy + yx + yy, dual.dd, 1e-11), "{text} at {x}: {dual:?}");
        }
    }
}

#[test]
fn derivatives_are_limits_of_differences() {
    let h = 1e-5;
    for &(text, points) in FUNCTIONS {
        let mut session = Session::new();
        let node = session.read(text);
        let first = session.slope(node, 0);
        let second = session.slope(first, 0);
        for &x in points {
            let difference =
                |of| (session.value(of, &[x + h, Y]) - session.value(of, &[x - h, Y])) / (2.0 * h);
            let (slope, bend) = (session.value(first, &[x, Y]), session.value(second, &[x, Y]));
            assert!(close(slope, difference(node), 1e-7), "{text}' at {x}: {slope}, {}", difference(node));
            assert!(close(bend, difference(first), 1e-7), "{text}'' at {x}: {bend}, {}", difference(first));
        }
    }
}

#[test]
fn every_input_has_a_derivative() {
    let mut session = Session::new();
    let node = session.read("t^2*dt + u_a*p - q*u_b");
    let table = [
        (Input::Time, "2*t*dt"),
        (Input::Step, "t^2"),
        (Input::Control(0), "p"),
        (Input::Control(1), "-q"),
        (Input::Parameter(0), "u_a"),
        (Input::Parameter(1), "-u_b"),
        (Input::State(0), "0"),
        (Input::Measure(0), "0"),
    ];
    for (input, wanted) in table {
        let slope = session.graph.derivative(node, input).unwrap();
        assert_eq!(slope, session.read(wanted), "{input:?}");
    }
}

#[test]
fn what_is_not_chosen_never_leaks() {
    // text, where, value, slope, bend
    let table = [
        ("where(x > 0, sqrt(x), 0)", 0.0, 0.0, 0.0, 0.0),
        ("where(x > 0, sqrt(x), 0)", -1.0, 0.0, 0.0, 0.0),
        ("where(x > 0, log(x), x)", -1.0, -1.0, 1.0, 0.0),
        ("where(x > 0, log(x), x)", 0.0, 0.0, 1.0, 0.0),
        ("where(x == 0, 1, sin(x)/x)", 0.0, 1.0, 0.0, 0.0),
        ("2*where(x < 1, x^2, 1/0)*x", 0.5, 0.25, 1.5, 6.0),
        ("sin(where(x > 0, x^0.3, 0))", -2.0, 0.0, 0.0, 0.0),
        ("where(abs(x) < 1, asin(x), 0)", 5.0, 0.0, 0.0, 0.0),
    ];
    for (text, x, value, slope, bend) in table {
        let mut session = Session::new();
        let node = session.read(text);
        let first = session.slope(node, 0);
        let second = session.slope(first, 0);
        let found = [node, first, second].map(|node| session.value(node, &[x]));
        assert_eq!(found, [value, slope, bend], "{text} at {x}");
    }
}

#[test]
fn what_does_not_move_has_no_derivative_even_where_the_slope_is_infinite() {
    let table = [
        ("sqrt(x^2)", 0.0, 0.0),
        ("sqrt(max(x, 0))", -1.0, 0.0),
        ("sqrt(where(x > 0, x, 0))", -1.0, 0.0),
        ("asin(where(x > 0, 1, x))", 2.0, 0.0),
        ("where(x > 0, x, 0)^0.5", -1.0, 0.0),
        ("where(x > 0, x, 0)^-2", -1.0, 0.0),
        ("log(x^2*0 + where(x > 0, x, 0))", -1.0, 0.0),
    ];
    for (text, x, wanted) in table {
        let mut session = Session::new();
        let node = session.read(text);
        let slope = session.slope(node, 0);
        assert_eq!(session.value(slope, &[x]), wanted, "{text} at {x}");
        let dual = dual_value(&session, node, [Dual2::variable(x), Dual2::of(Y)]);
        assert_eq!(dual.d, wanted, "{text} at {x}, by duals");
    }
    // … but the bend of √(1 + x²) at zero, where the inner slope is zero and moves, is there
    let mut session = Session::new();
    let node = session.read("sqrt(1 + x^2)");
    let first = session.slope(node, 0);
    let second = session.slope(first, 0);
    assert_eq!([first, second].map(|node| session.value(node, &[0.0])), [0.0, 1.0]);
}

#[test]
fn a_derivative_that_does_not_exist_is_not_hidden() {
    for (text, x) in [("sqrt(x)", 0.0), ("log(x)", 0.0), ("asin(x)", 1.0), ("x^0.5", 0.0), ("1/x", 0.0)] {
        let mut session = Session::new();
        let node = session.read(text);
        let slope = session.slope(node, 0);
        assert!(!session.value(slope, &[x]).is_finite(), "{text} at {x}");
    }
    let mut session = Session::new();
    let bearing = session.read("atan2(y, x)");
    let slope = session.slope(bearing, 0);
    assert!(session.value(slope, &[0.0, 0.0]).is_nan());
}

#[test]
fn conventions_at_kinks_hold() {
    let table = [
        ("abs(x)", 0.0, 1.0),
        ("sign(x)", 0.0, 0.0),
        ("floor(x)", 1.0, 0.0),
        ("min(x, 2*x)", 0.0, 2.0),
        ("max(x, 2*x)", 0.0, 2.0),
        ("where(x < 0, 3*x, 4*x)", 0.0, 4.0),
    ];
    for (text, x, wanted) in table {
        let mut session = Session::new();
        let node = session.read(text);
        let slope = session.slope(node, 0);
        assert_eq!(session.value(slope, &[x]), wanted, "{text} at {x}");
        assert_eq!(
            dual_value(&session, node, [Dual2::variable(x), Dual2::of(Y)]).d,
            wanted,
            "{text}, by duals"
        );
    }
}

/// The program of a node, run on duals.
fn dual_value(session: &Session, node: givens_expr::Node, state: [Dual2<f64>; 2]) -> Dual2<f64> {
    let program = Program::compile(&session.graph, &[node]).unwrap();
    let (mut out, mut scratch) = ([Dual2::zero()], vec![Dual2::zero(); program.scratch_len(1)]);
    program.eval(&Inputs::of_state(&state), 1, &mut out, &mut scratch);
    out[0]
}
