//! What wrong expressions are told.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod session;

use givens_expr::{Input, Meaning};
use session::Session;

/// Text, the offending part, what the message says, what the help says. The part is marked by where it starts, since
/// it may occur twice; an empty one stands at the end.
const TABLE: &[(&str, usize, &str, &str, &str)] = &[
    ("", 0, "", "expression is empty", "write a number or a formula"),
    ("  ", 0, "  ", "expression is empty", "write a number or a formula"),
    ("x +", 3, "", "the expression ends where a number, a name or `(` should follow", ""),
    ("2 ^", 3, "", "the expression ends", ""),
    ("* x", 0, "*", "expected a number, a name or `(`, found `*`", ""),
    ("x + )", 4, ")", "found `)`", ""),
    ("()", 1, ")", "found `)`", ""),
    ("x y", 2, "y", "expected an operator or the end, found `y`", "`*`"),
    ("5(x)", 1, "(", "expected an operator or the end, found `(`", "`*` before `(`"),
    ("2x", 0, "2x", "neither a number nor a name", "write `2*x`"),
    ("1.2.3", 0, "1.2.3", "neither a number", "at most one point"),
    ("1_000", 0, "1_000", "neither a number", "no `_`"),
    ("3e + x", 0, "3e", "neither a number", "exponent has no digits"),
    ("1,5", 1, ",", "found `,`", "decimal sign is a point"),
    ("1e999", 0, "1e999", "too large", "1.8e308"),
    ("x*1e-999", 2, "1e-999", "too small", "units"),
    ("2*(x + y", 2, "(", "never closed", "add `)`"),
    ("x)*2", 1, ")", "closes nothing", "add `(`"),
    ("sin(x", 3, "(", "never closed", "add `)`"),
    ("atan(y x)", 7, "x", "expected an operator, `,` or `)`", "`*`"),
    ("2*sin", 2, "sin", "`sin` is a function and needs its arguments", "write `sin(x)`"),
    ("atan2 y", 0, "atan2", "is a function", "write `atan2(y, x)`"),
    ("sin()", 0, "sin", "takes one argument, found 0", "write `sin(x)`"),
    ("1 + atan2(x)", 4, "atan2", "takes two arguments, found 1", "write `atan2(y, x)`"),
    ("min(x)", 0, "min", "takes two or more arguments, found 1", "min(a, b, …)"),
    ("where(x>0, 1)", 0, "where", "takes three arguments, found 2", "where(condition, a, b)"),
    ("hypot(x, y, w)", 0, "hypot", "takes two arguments, found 3", "hypot(x, y)"),
    ("sin(x,)", 6, ")", "expected a number", ""),
    ("x(2)", 0, "x", "`x` is not a function", "write `x*(…)`"),
    ("pi(2)", 0, "pi", "`pi` is not a function", "`pi*(…)`"),
    ("sine(x)", 0, "sine", "unknown function `sine`", "did you mean `sin`?"),
    ("SQRT(x)", 0, "SQRT", "unknown function", "did you mean `sqrt`?"),
    ("foo(x)", 0, "foo", "unknown function `foo`", "the functions are where, abs"),
    ("2*ln(x)", 2, "ln", "unknown function `ln`", "write `log(x)`"),
    ("arctan2(y, x)", 0, "arctan2", "unknown function", "write `atan2(y, x)`"),
    ("pow(x, 2)", 0, "pow", "unknown function", "write `x^y`"),
    ("radians(x)", 0, "radians", "unknown function", "x*pi/180"),
    ("x + vz*dt", 4, "vz", "unknown name `vz`", "did you mean `vx`?"),
    ("dT*x", 0, "dT", "unknown name", "did you mean `dt`?"),
    ("altitude", 0, "altitude", "unknown name `altitude`", "known here: `x`, `y`"),
    ("π*x", 0, "π", "unknown name", "write `pi`"),
    ("x + e", 4, "e", "unknown name", "write `exp(1)`"),
    ("inf", 0, "inf", "unknown name", "infinite"),
    ("x if t else y", 2, "if", "found `if`", "where(condition, a, b)"),
    ("x ** 2", 2, "**", "may not stand here", "write `^`"),
    ("x = 2", 2, "=", "may not stand here", "write `==`"),
    ("x > 0 && y > 0", 6, "&&", "may not stand here", "write `and`"),
    ("x > 0 || y > 0", 6, "||", "may not stand here", "write `or`"),
    ("!x", 0, "!", "may not stand here", "write `not`"),
    ("x <> y", 2, "<>", "may not stand here", "write `!=`"),
    ("x // 2", 2, "//", "may not stand here", "floor(a/b)"),
    ("x % 2", 2, "%", "may not stand here", "a - b*floor(a/b)"),
    ("x ? 1 : 2", 2, "?", "may not stand here", "where(condition, a, b)"),
    ("np.sin(x)", 2, ".", "may not stand here", "names have no dots"),
    ("x − y", 2, "−", "may not stand here", "ASCII minus"),
    ("2×x", 1, "×", "may not stand here", "write `*`"),
    ("x²", 1, "²", "may not stand here", "write `^2`"),
    ("√x", 0, "√", "may not stand here", "sqrt(…)"),
    ("x ≤ y", 2, "≤", "may not stand here", "write `<=`"),
    ("x[0]", 1, "[", "may not stand here", "only `(` and `)` group"),
    ("\"x\"", 0, "\"", "may not stand here", "without quotation marks"),
    ("x\u{0}", 1, "\u{0}", "U+0000", ""),
    ("x > 0", 0, "x > 0", "this is a condition, but a number is needed", "where(condition, 1, 0)"),
    ("x + (y > 0)", 4, "(y > 0)", "`+` takes numbers", "where(condition, 1, 0)"),
    ("-(y > 0)", 1, "(y > 0)", "`-` takes numbers", "where(condition, 1, 0)"),
    ("sin(y > 0)", 4, "y > 0", "`sin` takes numbers", "where(condition, 1, 0)"),
    ("where(x, 1, 2)", 6, "x", "`where` takes a condition", "`x > 0`"),
    ("where(x > 0, y > 0, 2)", 13, "y > 0", "a value of `where` takes numbers", ""),
    ("where(x and y > 0, 1, 2)", 6, "x", "`and` takes a condition", "`x > 0`"),
    ("where(not x, 1, 2)", 10, "x", "`not` takes a condition", "`x > 0`"),
    ("x + not y", 4, "not", "may not stand here", "(not …)"),
    ("where(x < y < 2, 1, 2)", 12, "<", "comparisons cannot be chained", "write `… < y and y < …`"),
    ("(x < y) == 2", 0, "(x < y)", "`==` takes numbers", ""),
    ("3*hidden", 2, "hidden", "`hidden` may not stand here", "a noise may not depend on the state"),
];

#[test]
fn wrong_expressions_are_told_where_and_what_to_do() {
    let mut session = Session::new();
    session.scope.insert("hidden", Meaning::Forbidden("a noise may not depend on the state".into()));
    for &(text, start, part, message, help) in TABLE {
        let error = session.try_read(text).expect_err(text);
        assert_eq!(text.get(error.span.clone()), Some(part), "{text}: {error:?}");
        assert_eq!(error.span.start, start, "{text}: {error:?}");
        assert!(error.message.contains(message), "{text}: {error:?}");
        assert!(error.help.as_deref().unwrap_or_default().contains(help), "{text}: {error:?}");
        assert!(!error.message.ends_with('.'), "{text}: {error:?}");
    }
}

#[test]
fn an_empty_scope_says_what_may_stand() {
    let mut session = Session::new();
    session.scope = givens_expr::Scope::new();
    let error = session.try_read("x + 1").unwrap_err();
    assert_eq!(error.to_string(), "unknown name `x`: only numbers, `pi` and functions may stand here");
}

#[test]
fn a_long_name_is_shown_in_part() {
    let error = Session::new().try_read(&"ä".repeat(10_000)).unwrap_err();
    assert_eq!(error.span, 0..20_000);
    assert!(error.message.len() < 200);
}

#[test]
fn a_scope_keeps_its_names_in_order_and_tells_what_it_replaced() {
    let mut session = Session::new();
    let (x, node) = (session.read("x"), session.graph.input(Input::State(9)));
    assert_eq!(session.scope.insert("x", Meaning::Forbidden("no".into())), Some(Meaning::Is(x)));
    assert_eq!(session.scope.insert("z", Meaning::Is(node)), None);
    assert_eq!(session.scope.names().next(), Some("x"));
    assert_eq!(session.scope.names().last(), Some("z"));
}

#[test]
fn a_constant_that_is_not_a_number_is_refused_where_it_stands() {
    let mut session = Session::new();
    for (text, span) in [
        ("0/0", 0..3),
        ("x + log(-1)", 4..11),
        ("x*sqrt(2 - 3)", 2..13),
        ("where(x > 0, x, 0/0)", 16..19),
        ("-acos(2)", 1..8),
        ("(-8)^(1/3)", 0..10),
    ] {
        let error = session.try_read(text).unwrap_err();
        assert_eq!(error.span, span, "{text}: {error}");
        assert!(error.message.ends_with("is a constant that is not a number"), "{text}: {error}");
    }
    // of what depends on something, nobody knows yet
    for text in ["0/x", "log(-x)", "x/0"] {
        session.try_read(text).unwrap();
    }
}
