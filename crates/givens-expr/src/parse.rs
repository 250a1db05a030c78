//! From text to the graph, by precedence climbing.

use core::ops::Range;

use crate::call::call;
use crate::error::ExprError;
use crate::graph::{Graph, Node};
use crate::lex::{Lexer, Token};
use crate::operation::{Binary, Unary};
use crate::scope::Scope;

/// The deepest nesting of parentheses, signs and powers.
const MAX_DEPTH: usize = 200;

// how tightly operators bind
const ANY: u8 = 0;
const OR: u8 = 1;
const AND: u8 = 2;
const NOT: u8 = 3;
pub(crate) const COMPARISON: u8 = 4;
const SUM: u8 = 5;
const PRODUCT: u8 = 6;
const NEGATION: u8 = 7;
const POWER: u8 = 8;

/// Reads an expression that gives a number.
///
/// From the tightest: `^` (to the right, also over a sign: `2^-1`), signs (−x^2 = −(x^2)), `*` and `/`, `+` and
/// `-`, comparisons `< <= > >= == !=`, `not`, `and`, `or`. Functions: `where(condition, a, b)`, abs, sign, min and
/// max (of two or more), floor, sqrt, hypot, exp, log, log10, sin, cos, tan, asin, acos, atan, atan2, sinh, cosh,
/// tanh, erf, erfc; and `pi`. Angles are in radians. Comparisons give conditions, which only `and`, `or`, `not` and `where`
/// take.
///
/// # Errors
/// What is wrong with the text, where, and the remedy.
///
/// ```
/// use givens_expr::{Graph, Input, Meaning, Scope, parse};
/// let (mut graph, mut scope) = (Graph::new(), Scope::new());
/// scope.insert("x", Meaning::Is(graph.input(Input::State(0))));
/// assert_eq!(parse(&mut graph, &scope, "-x^2")?, parse(&mut graph, &scope, "-(x*x)")?);
/// let error = parse(&mut graph, &scope, "2*ln(x)").unwrap_err();
/// assert_eq!(error.span, 2..4);
/// assert_eq!(error.to_string(), "unknown function `ln`: write `log(x)`, which is the natural logarithm");
/// # Ok::<(), givens_expr::ExprError>(())
/// ```
pub fn parse(graph: &mut Graph, scope: &Scope, text: &str) -> Result<Node, ExprError> {
    let node = parse_any(graph, scope, text)?;
    if graph.is_condition(node) {
        let error = ExprError::new(0..text.len(), "this is a condition, but a number is needed");
        return Err(error.help("write `where(condition, 1, 0)`"));
    }
    Ok(node)
}

/// Reads an expression that gives a number or a condition: a definition may be either.
///
/// # Errors
/// As [`parse`].
pub fn parse_any(graph: &mut Graph, scope: &Scope, text: &str) -> Result<Node, ExprError> {
    let (token, span) = (Token::End, 0..0);
    let mut parser = Parser { graph, scope, text, lexer: Lexer::new(text), token, span, last: 0, depth: 0 };
    parser.advance()?;
    if parser.token == Token::End {
        return Err(
            ExprError::new(0..text.len(), "the expression is empty").help("write a number or a formula")
        );
    }
    let term = parser.expression(ANY)?;
    parser.end()?;
    Ok(term.node)
}

/// A subexpression and where it stands.
#[derive(Clone)]
pub(crate) struct Term {
    pub node: Node,
    pub span: Range<usize>,
}

pub(crate) struct Parser<'p> {
    pub graph: &'p mut Graph,
    pub scope: &'p Scope,
    pub text: &'p str,
    lexer: Lexer<'p>,
    /// The token to be read next, and its place.
    pub token: Token<'p>,
    pub span: Range<usize>,
    /// The end of the token before.
    last: usize,
    depth: usize,
}

impl Parser<'_> {
    pub(crate) fn advance(&mut self) -> Result<(), ExprError> {
        self.last = self.span.end;
        (self.token, self.span) = self.lexer.next()?;
        Ok(())
    }

    /// Reads all that binds at least as tightly as `least`.
    pub(crate) fn expression(&mut self, least: u8) -> Result<Term, ExprError> {
        if self.depth >= MAX_DEPTH {
            let message = format!("the expression is nested more than {MAX_DEPTH} deep");
            return Err(
                ExprError::new(self.span.clone(), message).help("give a part of it a name of its own")
            );
        }
        self.depth += 1;
        let term = self.operators(least);
        self.depth -= 1;
        term
    }

    fn operators(&mut self, least: u8) -> Result<Term, ExprError> {
        let mut left = self.operand(least)?;
        loop {
            let (sign, place) = match self.token {
                Token::Sign(sign) => (sign, self.span.clone()),
                Token::Name(name @ ("and" | "or")) => (name, self.span.clone()),
                _ => return Ok(left),
            };
            let Some(binding) = binding(sign).filter(|&binding| binding >= least) else {
                return Ok(left);
            };
            self.advance()?;
            // to the right of `^` a sign may stand, and further powers; elsewhere what binds more tightly
            let right = self.expression(if binding == POWER { NEGATION } else { binding + 1 })?;
            left = self.combine(sign, &left, &right)?;
            self.grown(&place)?;
            if binding == COMPARISON {
                self.refuse_chain(sign, &right)?;
            }
        }
    }

    /// What stands before, between and after operators.
    fn operand(&mut self, least: u8) -> Result<Term, ExprError> {
        let (token, span) = (self.token, self.span.clone());
        match token {
            Token::Number(value) => {
                self.advance()?;
                Ok(Term { node: self.graph.constant(value), span })
            }
            Token::Name("not") if least <= NOT => {
                self.advance()?;
                let right = self.expression(NOT)?;
                self.condition(&right, "`not`")?;
                self.made(Unary::Not, &span, &right)
            }
            Token::Name("not") => {
                Err(ExprError::new(span, "`not` may not stand here").help("write `(not …)`"))
            }
            Token::Name("and" | "or") => Err(self.missing_operand()),
            Token::Name("pi") => {
                self.advance()?;
                self.refuse_call("pi", &span)?;
                Ok(Term { node: self.graph.constant(core::f64::consts::PI), span })
            }
            Token::Name(name) => {
                self.advance()?;
                if self.token == Token::Sign("(") {
                    return call(self, name, span);
                }
                let node =
                    self.scope.find(name).map_err(|error| ExprError { span: span.clone(), ..error })?;
                Ok(Term { node, span })
            }
            Token::Sign("(") => {
                self.advance()?;
                let inner = self.expression(ANY)?;
                self.close(&span, "")?;
                Ok(Term { node: inner.node, span: span.start..self.last })
            }
            Token::Sign(sign @ ("-" | "+")) => {
                self.advance()?;
                let right = self.expression(NEGATION)?;
                self.number(&right, &format!("`{sign}`"))?;
                let whole = span.start..right.span.end;
                if sign == "-" {
                    self.made(Unary::Neg, &span, &right)
                } else {
                    Ok(Term { span: whole, ..right })
                }
            }
            Token::Sign(_) | Token::End => Err(self.missing_operand()),
        }
    }

    fn made(&mut self, op: Unary, sign: &Range<usize>, right: &Term) -> Result<Term, ExprError> {
        let node = self.graph.unary(op, right.node);
        self.defined(Term { node, span: sign.start..right.span.end })
    }

    fn combine(&mut self, sign: &str, left: &Term, right: &Term) -> Result<Term, ExprError> {
        let name = format!("`{sign}`");
        for side in [left, right] {
            if matches!(sign, "and" | "or") {
                self.condition(side, &name)?;
            } else {
                self.number(side, &name)?;
            }
        }
        let (a, b) = (left.node, right.node);
        let node = match sign {
            "+" => self.graph.add(a, b),
            "-" => self.graph.sub(a, b),
            "*" => self.graph.mul(a, b),
            "/" => self.graph.div(a, b),
            "^" => self.graph.binary(Binary::Pow, a, b),
            "<" => self.graph.binary(Binary::Less, a, b),
            "<=" => self.graph.binary(Binary::LessEqual, a, b),
            ">" => self.graph.binary(Binary::Less, b, a),
            ">=" => self.graph.binary(Binary::LessEqual, b, a),
            "==" => self.graph.binary(Binary::Equal, a, b),
            "and" => self.graph.binary(Binary::And, a, b),
            "or" => self.graph.binary(Binary::Or, a, b),
            _ => {
                let equal = self.graph.binary(Binary::Equal, a, b);
                self.graph.unary(Unary::Not, equal)
            }
        };
        self.defined(Term { node, span: left.span.start..right.span.end })
    }

    /// Reads the `)` that belongs to the `(` at `open`.
    pub(crate) fn close(&mut self, open: &Range<usize>, or: &str) -> Result<(), ExprError> {
        match self.token {
            Token::Sign(")") => self.advance(),
            Token::End => Err(ExprError::new(open.clone(), "this `(` is never closed").help("add `)`")),
            _ => Err(self.unexpected(&format!("an operator{or} or `)`"))),
        }
    }

    fn end(&self) -> Result<(), ExprError> {
        match self.token {
            Token::End => Ok(()),
            Token::Sign(")") => {
                Err(ExprError::new(self.span.clone(), "this `)` closes nothing")
                    .help("add `(`, or leave it out"))
            }
            _ => Err(self.unexpected("an operator or the end")),
        }
    }
}

pub(crate) fn binding(sign: &str) -> Option<u8> {
    Some(match sign {
        "or" => OR,
        "and" => AND,
        "<" | "<=" | ">" | ">=" | "==" | "!=" => COMPARISON,
        "+" | "-" => SUM,
        "*" | "/" => PRODUCT,
        "^" => POWER,
        _ => return None,
    })
}
