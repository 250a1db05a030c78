//! `start`: states found from the first measurement of a track, and their rates from the first two.

use givens_expr::{Input, Meaning, ModelStart, Node, Scope, StartParts, names};

use super::context::Context;
use super::document::{Kind, Value};
use super::section::{Named, Section};
use super::vocabulary::{Role, broken, is_broken_node};

/// What finds states from a measurement.
#[derive(Clone, Debug)]
pub struct Start {
    /// The expressions, with their derivatives along the measures.
    pub function: ModelStart,
    /// The states that it finds, ascending.
    pub states: Vec<usize>,
    /// The measures that it reads, as places in the stack, ascending: a row can start a track if it has all of them.
    pub measures: Vec<usize>,
    /// Whether it reads two such rows, the first of a track, for a `rate`.
    pub two_rows: bool,
}

/// The expressions of `start`, by state.
#[derive(Debug, Default)]
pub(super) struct Found {
    /// For each state its expression, if `start` has one.
    pub nodes: Vec<Option<Node>>,
    /// For each state whether `start` names it, be its expression right or wrong.
    pub started: Vec<bool>,
}

/// Reads the expressions, in `measures` measures; what is wrong is found so.
pub(super) fn read(context: &mut Context, section: &Section, states: &[String], measures: usize) -> Found {
    let mut found = Found { nodes: vec![None; states.len()], started: vec![false; states.len()] };
    let Some(entry) = section.get("start") else { return found };
    let named = Named { noun: "state", names: states };
    let values: Vec<(usize, &Value)> = match &entry.value.kind {
        Kind::Table(entries) => {
            if entries.is_empty() {
                let help = "write start = { x = \"range*cos(bearing)\", … }, or leave it out";
                context.findings.wrong_help(&entry.value.span, "`start` finds no state", help);
            }
            let index = |name: &str, span| named.index(context.findings, name, span, "`start`");
            entries.iter().filter_map(|entry| Some((index(&entry.key, &entry.span)?, &entry.value))).collect()
        }
        _ => named
            .values(context.findings, &entry.value, "`start`")
            .unwrap_or_default()
            .into_iter()
            .enumerate()
            .collect(),
    };
    let (rates, plain): (Vec<_>, Vec<_>) = values.into_iter().partition(|(_, value)| has_rate(value));
    let scope = context.scope(Role::Start);
    for (state, value) in plain {
        found.started[state] = true;
        found.nodes[state] = one(context, &scope, value, states, state);
    }
    for &(state, _) in &rates {
        found.started[state] = true;
    }
    if rates.is_empty() {
        return found;
    }
    let scope = with_rates(context, scope, &found, states, &rates, measures);
    for (state, value) in rates {
        let node = one(context, &scope, value, states, state);
        found.nodes[state] = node.filter(|&node| !is_broken_node(&context.graph, node));
    }
    found
}

/// Reads the expression of one state.
fn one(context: &mut Context, scope: &Scope, value: &Value, states: &[String], state: usize) -> Option<Node> {
    let name = states.get(state).map_or("", String::as_str);
    let node = context.expression(scope, value, &format!("the start of `{name}`"))?;
    let measured = context.graph.inputs_of(node).iter().any(|input| matches!(input, Input::Measure(_)));
    if !measured {
        let message = format!("the start of `{name}` names no measure, so it would be known exactly");
        context.findings.wrong_help(&value.span, message, "give it `mean` and `std` instead");
    }
    Some(node)
}

/// Whether an expression calls `rate`: a parameter may have this name, without arguments.
fn has_rate(value: &Value) -> bool {
    let Kind::Text(text, _) = &value.kind else { return false };
    let called = |end: usize| text.get(end..).is_some_and(|rest| rest.trim_start().starts_with('('));
    names(text).any(|(span, name)| name == "rate" && called(span.end))
}

/// The scope in which `rate(x)` stands for the rate of a state that `start` finds from one row.
fn with_rates(
    context: &mut Context,
    mut scope: Scope,
    found: &Found,
    states: &[String],
    rates: &[(usize, &Value)],
    measures: usize,
) -> Scope {
    let named: Vec<String> = scope.names().map(str::to_string).collect();
    for name in named {
        let why = "`rate` is of a state: let `start` find one from this, and write its name here";
        scope.insert_of("rate", &name, Meaning::Forbidden(why.into()));
    }
    for (i, name) in states.iter().enumerate() {
        let meaning = match found.nodes.get(i).copied().flatten() {
            Some(node) => {
                Meaning::Is(givens_expr::rate(&mut context.graph, node, measures, context.controls))
            }
            None if rates.iter().any(|(state, _)| *state == i) => Meaning::Forbidden(format!(
                "`{name}` is found from two rows itself, and its rate would need three; give it `mean` and `std`"
            )),
            None if found.started.get(i) == Some(&true) => Meaning::Is(broken(&mut context.graph)),
            None => {
                Meaning::Forbidden(format!("`start` does not find `{name}`; give it an expression there"))
            }
        };
        scope.insert_of("rate", name, meaning);
    }
    scope
}

/// The function that finds `states`, if `start` has them all.
pub(super) fn function(
    context: &mut Context,
    found: &Found,
    states: &[usize],
    measures: usize,
) -> Option<Start> {
    let values: Option<Vec<Node>> = states.iter().map(|&i| found.nodes.get(i).copied().flatten()).collect();
    let values = values.filter(|values| !values.is_empty())?;
    let inputs = values.iter().flat_map(|&node| context.graph.inputs_of(node));
    let mut used: Vec<usize> = inputs
        .filter_map(|input| {
            if let Input::Measure(index) = input { Some(index as usize % measures.max(1)) } else { None }
        })
        .collect();
    used.sort_unstable();
    used.dedup();
    let parts = StartParts {
        measures,
        controls: context.controls,
        parameters: context.parameters.len(),
        states: states.iter().map(|&i| i as u32).collect(),
        values,
    };
    match ModelStart::new(&mut context.graph, parts) {
        Ok(function) => {
            let two_rows = function.reads_earlier();
            Some(Start { function, states: states.to_vec(), measures: used, two_rows })
        }
        Err(error) => {
            context.findings.push(context.findings.source.whole(format!("`start`: {error}")));
            None
        }
    }
}
