//! `start`: states found from the first measurement of a track.

use givens_expr::{Input, ModelStart, Node, StartParts, names};

use super::context::Context;
use super::document::{Kind, Value};
use super::section::{Named, Section};
use super::vocabulary::Role;

/// What finds states from a measurement.
#[derive(Clone, Debug)]
pub struct Start {
    /// The expressions, with their derivatives along the measures.
    pub function: ModelStart,
    /// The states that it finds, ascending.
    pub states: Vec<usize>,
    /// The measures that it reads, as places in the stack, ascending: a row can start a track if it has all of them.
    pub measures: Vec<usize>,
}

/// The expressions of `start`, by state.
#[derive(Debug, Default)]
pub(super) struct Found {
    /// For each state its expression, if `start` has one.
    pub nodes: Vec<Option<Node>>,
    /// For each state whether `start` names it, be its expression right or wrong.
    pub started: Vec<bool>,
}

/// Reads the expressions; what is wrong is found so.
pub(super) fn read(context: &mut Context, section: &Section, states: &[String]) -> Found {
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
    let scope = context.scope(Role::Start);
    for (state, value) in values {
        let name = states.get(state).map_or("", String::as_str);
        found.started[state] = true;
        if rate(context, value) {
            continue;
        }
        let node = context.expression(&scope, value, &format!("the start of `{name}`"));
        let measured =
            |node: &Node| context.graph.inputs_of(*node).iter().any(|i| matches!(i, Input::Measure(_)));
        if node.is_some_and(|node| !measured(&node)) {
            let message = format!("the start of `{name}` names no measure, so it would be known exactly");
            context.findings.wrong_help(&value.span, message, "give it `mean` and `std` instead");
        }
        found.nodes[state] = node;
    }
    found
}

/// Two-point differencing is not there yet; this is told plainly.
fn rate(context: &Context, value: &Value) -> bool {
    let Kind::Text(text, _) = &value.kind else { return false };
    // a state or a parameter may have this name: only with arguments is it the function
    let called = |end: usize| text.get(end..).is_some_and(|rest| rest.trim_start().starts_with('('));
    let found = names(text).find(|(span, name)| *name == "rate" && called(span.end));
    let Some((span, _)) = found else { return false };
    let message = "`rate`, a state from the first two rows, is not in this version yet";
    let help = "leave the state out of `start` and give it `mean` and `std`";
    context.findings.wrong_help(&value.within(&span), message, help);
    true
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
        .filter_map(|input| if let Input::Measure(index) = input { Some(index as usize) } else { None })
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
        Ok(function) => Some(Start { function, states: states.to_vec(), measures: used }),
        Err(error) => {
            context.findings.push(context.findings.source.whole(format!("`start`: {error}")));
            None
        }
    }
}
