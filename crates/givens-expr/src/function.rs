//! The functions of expressions.

use crate::operation::{Binary, Unary};

/// What a function does with its arguments.
#[derive(Clone, Copy)]
pub(crate) enum Body {
    One(Unary),
    Two(Binary),
    /// Of two or more arguments, from the left.
    Many(Binary),
    Where,
}

pub(crate) struct Function {
    pub name: &'static str,
    pub signature: &'static str,
    pub body: Body,
}

const fn one(name: &'static str, signature: &'static str, operation: Unary) -> Function {
    Function { name, signature, body: Body::One(operation) }
}

/// All functions, in the order of their documentation.
pub(crate) const FUNCTIONS: &[Function] = &[
    Function { name: "where", signature: "where(condition, a, b)", body: Body::Where },
    one("abs", "abs(x)", Unary::Abs),
    one("sign", "sign(x)", Unary::Sign),
    Function { name: "min", signature: "min(a, b, …)", body: Body::Many(Binary::Min) },
    Function { name: "max", signature: "max(a, b, …)", body: Body::Many(Binary::Max) },
    one("floor", "floor(x)", Unary::Floor),
    one("sqrt", "sqrt(x)", Unary::Sqrt),
    Function { name: "hypot", signature: "hypot(x, y)", body: Body::Two(Binary::Hypot) },
    one("exp", "exp(x)", Unary::Exp),
    one("log", "log(x)", Unary::Log),
    one("log10", "log10(x)", Unary::Log10),
    one("sin", "sin(x)", Unary::Sin),
    one("cos", "cos(x)", Unary::Cos),
    one("tan", "tan(x)", Unary::Tan),
    one("asin", "asin(x)", Unary::Asin),
    one("acos", "acos(x)", Unary::Acos),
    one("atan", "atan(x)", Unary::Atan),
    Function { name: "atan2", signature: "atan2(y, x)", body: Body::Two(Binary::Atan2) },
    one("sinh", "sinh(x)", Unary::Sinh),
    one("cosh", "cosh(x)", Unary::Cosh),
    one("tanh", "tanh(x)", Unary::Tanh),
    one("erf", "erf(x)", Unary::Erf),
    one("erfc", "erfc(x)", Unary::Erfc),
];

pub(crate) fn function(name: &str) -> Option<&'static Function> {
    FUNCTIONS.iter().find(|function| function.name == name)
}

impl Function {
    /// How many arguments it takes: at least, and at most.
    pub(crate) fn arity(&self) -> (usize, usize) {
        match self.body {
            Body::One(_) => (1, 1),
            Body::Two(_) => (2, 2),
            Body::Many(_) => (2, usize::MAX),
            Body::Where => (3, 3),
        }
    }

    /// The same in words.
    pub(crate) fn takes(&self) -> &'static str {
        match self.body {
            Body::One(_) => "one argument",
            Body::Two(_) => "two arguments",
            Body::Many(_) => "two or more arguments",
            Body::Where => "three arguments",
        }
    }
}

/// Whether a name belongs to the language of expressions: a function, `pi`, `and`, `or` or `not`.
///
/// ```
/// assert!(givens_expr::is_reserved("atan2") && !givens_expr::is_reserved("range"));
/// ```
#[must_use]
pub fn is_reserved(name: &str) -> bool {
    matches!(name, "pi" | "and" | "or" | "not") || function(name).is_some()
}

/// The names of all functions, in the order of their documentation.
pub fn functions() -> impl Iterator<Item = &'static str> {
    FUNCTIONS.iter().map(|function| function.name)
}
