//! Calls of functions.

use core::ops::Range;

use crate::error::{ExprError, short};
use crate::function::{Body, Function, function, functions};
use crate::hints;
use crate::lex::Token;
use crate::parse::{Parser, Term};
use crate::scope::Scope;
use crate::suggest::suggest;

/// Reads the arguments of `name`, which stands at `span` before a `(`.
pub(crate) fn call(parser: &mut Parser<'_>, name: &str, span: Range<usize>) -> Result<Term, ExprError> {
    let Some(function) = function(name) else {
        if parser.scope.takes_names(name) {
            return of_name(parser, name, span);
        }
        return Err(unknown(parser, name, span));
    };
    let open = parser.span.clone();
    parser.advance()?;
    let mut arguments: Vec<Term> = Vec::new();
    if parser.token != Token::Sign(")") {
        loop {
            arguments.push(parser.expression(0)?);
            if parser.token != Token::Sign(",") {
                break;
            }
            parser.advance()?;
        }
    }
    let whole = span.start..parser.span.end;
    parser.close(&open, ", `,`")?;
    let (least, most) = function.arity();
    if arguments.len() < least || arguments.len() > most {
        let message = format!("`{name}` takes {}, found {}", function.takes(), arguments.len());
        return Err(ExprError::new(span, message).help(format!("write `{}`", function.signature)));
    }
    let node = build(parser, function, &arguments)?;
    parser.grown(&span)?;
    parser.defined(Term { node, span: whole })
}

/// Reads a name in parentheses, for a word that takes names.
fn of_name(parser: &mut Parser<'_>, word: &str, span: Range<usize>) -> Result<Term, ExprError> {
    let open = parser.span.clone();
    parser.advance()?;
    let (token, place) = (parser.token, parser.span.clone());
    let alone = |scope: &Scope, place| {
        ExprError::new(place, format!("`{word}` takes a name, and nothing beside it"))
            .help(scope.names_of(word))
    };
    let Token::Name(name) = token else { return Err(alone(parser.scope, place)) };
    parser.advance()?;
    if !matches!(parser.token, Token::Sign(")") | Token::End) {
        return Err(alone(parser.scope, parser.span.clone()));
    }
    let whole = span.start..parser.span.end;
    parser.close(&open, "")?;
    let found = parser.scope.find_of(word, name);
    let node = found.map_err(|error| ExprError { span: place, ..error })?;
    Ok(Term { node, span: whole })
}

fn build(parser: &mut Parser<'_>, function: &Function, arguments: &[Term]) -> Result<crate::Node, ExprError> {
    let whose = format!("`{}`", function.name);
    let is_where = matches!(function.body, Body::Where);
    for (i, argument) in arguments.iter().enumerate() {
        match (is_where, i) {
            (true, 0) => parser.condition(argument, "the first argument of `where`")?,
            (true, _) => parser.number(argument, "a value of `where`")?,
            (false, _) => parser.number(argument, &whose)?,
        }
    }
    let graph = &mut *parser.graph;
    Ok(match (function.body, arguments) {
        (Body::One(op), [a, ..]) => graph.unary(op, a.node),
        (Body::Two(op), [a, b, ..]) => graph.binary(op, a.node, b.node),
        (Body::Many(op), [first, others @ ..]) => {
            others.iter().fold(first.node, |sofar, next| graph.binary(op, sofar, next.node))
        }
        (Body::Where, [c, a, b, ..]) => graph.select(c.node, a.node, b.node),
        (_, _) => graph.constant(f64::NAN),
    })
}

fn unknown(parser: &Parser<'_>, name: &str, span: Range<usize>) -> ExprError {
    if parser.scope.get(name).is_some() {
        return match parser.refuse_call(name, &span) {
            Err(error) => error,
            Ok(()) => ExprError::new(span, format!("`{}` is not a function", short(name))),
        };
    }
    let error = ExprError::new(span, format!("unknown function `{}`", short(name)));
    match (hints::function(name), suggest(name, functions())) {
        (Some(help), _) => error.help(help),
        (None, Some(near)) => error.help(format!("did you mean `{near}`?")),
        (None, None) => {
            let known: Vec<&str> = functions().collect();
            error.help(format!("the functions are {}", known.join(", ")))
        }
    }
}
