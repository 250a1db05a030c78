//! What the parser refuses, and in which words.

use core::ops::Range;

use crate::error::{ExprError, short};
use crate::graph::MAX_NODES;
use crate::hints;
use crate::lex::Token;
use crate::parse::{COMPARISON, Parser, Term, binding};

impl<'p> Parser<'p> {
    /// An error unless `term` is a number.
    pub(crate) fn number(&self, term: &Term, whose: &str) -> Result<(), ExprError> {
        if !self.graph.is_condition(term.node) {
            return Ok(());
        }
        let message = format!("{whose} takes numbers, but this is a condition");
        Err(ExprError::new(term.span.clone(), message).help("make it a number by `where(condition, 1, 0)`"))
    }

    /// An error unless `term` is a condition.
    pub(crate) fn condition(&self, term: &Term, whose: &str) -> Result<(), ExprError> {
        if self.graph.is_condition(term.node) {
            return Ok(());
        }
        let message = format!("{whose} takes a condition, but this is a number");
        let text = self.shown(&term.span);
        Err(ExprError::new(term.span.clone(), message).help(format!("compare it, as in `{text} > 0`")))
    }

    /// The text of a part, if it is short.
    pub(crate) fn shown(&self, span: &Range<usize>) -> &'p str {
        self.text.get(span.clone()).filter(|text| text.len() <= 40).unwrap_or("…")
    }

    /// `a < b < c` would compare a condition with a number.
    pub(crate) fn refuse_chain(&self, sign: &str, right: &Term) -> Result<(), ExprError> {
        match self.token {
            Token::Sign(next) if binding(next) == Some(COMPARISON) => {
                let middle = self.shown(&right.span);
                let error = ExprError::new(self.span.clone(), "comparisons cannot be chained");
                Err(error.help(format!("write `… {sign} {middle} and {middle} {next} …`")))
            }
            _ => Ok(()),
        }
    }

    /// A name that is no function, before a parenthesis.
    pub(crate) fn refuse_call(&self, name: &str, span: &Range<usize>) -> Result<(), ExprError> {
        if self.token != Token::Sign("(") {
            return Ok(());
        }
        let name = short(name);
        let error = ExprError::new(span.clone(), format!("`{name}` is not a function"));
        Err(error.help(format!("write `{name}*(…)` to multiply")))
    }

    /// The error for a token that stands where `wanted` should.
    pub(crate) fn unexpected(&self, wanted: &str) -> ExprError {
        let found = short(self.text.get(self.span.clone()).unwrap_or_default());
        let error = ExprError::new(self.span.clone(), format!("expected {wanted}, found `{found}`"));
        match self.token {
            Token::Name(name) => match hints::name(name) {
                Some(help) => error.help(help),
                None => error.help("write `*` to multiply"),
            },
            Token::Number(_) => error.help("write `*` to multiply"),
            Token::Sign("(") => error.help("write `*` before `(` to multiply"),
            Token::Sign(",") => {
                error.help("the decimal sign is a point; commas separate the arguments of a function")
            }
            _ => error,
        }
    }

    pub(crate) fn missing_operand(&self) -> ExprError {
        let found = short(self.text.get(self.span.clone()).unwrap_or_default());
        match self.token {
            Token::End => ExprError::new(
                self.span.clone(),
                "the expression ends where a number, a name or `(` should follow",
            )
            .help("complete it, or leave out what stands last"),
            _ => ExprError::new(
                self.span.clone(),
                format!("expected a number, a name or `(`, found `{found}`"),
            )
            .help(format!("write one before `{found}`, or leave `{found}` out")),
        }
    }

    /// An error if `term` is a constant that does not exist, such as `0/0`.
    pub(crate) fn defined(&self, term: Term) -> Result<Term, ExprError> {
        let undefined = self.graph.constant_value(term.node).is_some_and(f64::is_nan);
        // what a full graph could not take up is told as that
        if !undefined || self.graph.is_full() {
            return Ok(term);
        }
        let text = short(self.text.get(term.span.clone()).unwrap_or_default());
        let error = ExprError::new(term.span, format!("`{text}` is a constant that is not a number"));
        Err(error.help("look for a division by zero, or the root or logarithm of a negative number"))
    }

    /// An error if the graph has no room for what was just built.
    pub(crate) fn grown(&self, place: &Range<usize>) -> Result<(), ExprError> {
        if !self.graph.is_full() {
            return Ok(());
        }
        let message = format!("the expressions have more than {MAX_NODES} distinct operations");
        Err(ExprError::new(place.clone(), message).help("shorten them"))
    }
}
