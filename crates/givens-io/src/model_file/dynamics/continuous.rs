//! The dynamics of a continuous model: `drift` and `diffusion`.

use givens_expr::{ModelSde, Node, SdeParts};

use super::super::context::{Context, MANY};
use super::super::document::{Entry, Kind, Value};
use super::super::section::{Named, Section};
use super::super::vocabulary::Role;
use crate::findings::count;

/// Reads the drift and the diffusion.
pub(super) fn read(context: &mut Context, section: &Section, states: &[String]) -> Option<ModelSde> {
    let drift = drift(context, section, states);
    let diffusion = match section.get("diffusion") {
        None => Some((Vec::new(), 0)),
        Some(entry) => diffusion(context, &entry.value, states),
    };
    let (diffusion, noises) = diffusion?;
    let parts = SdeParts {
        states: states.len(),
        controls: context.controls,
        parameters: context.parameters.clone(),
        drift: drift?,
        diffusion,
        noises,
    };
    if parts.parameters.iter().any(|value| !value.is_finite()) {
        // told where the parameter stands
        return None;
    }
    match ModelSde::new(&mut context.graph, parts) {
        Ok(sde) => Some(sde),
        Err(error) => {
            context.findings.wrong(section.span, format!("[dynamics]: {error}"));
            None
        }
    }
}

fn drift(context: &mut Context, section: &Section, states: &[String]) -> Option<Vec<Node>> {
    let help = "write the rate of change of every state: drift = { x = \"vx\", … }";
    let entry = section.need(context.findings, "drift", help)?;
    let named = Named { noun: "state", names: states };
    let values = named.values(context.findings, &entry.value, "`drift`")?;
    let scope = context.scope(Role::Drift);
    let mut nodes = Vec::with_capacity(values.len());
    for (value, name) in values.into_iter().zip(states) {
        nodes.push(context.finite_expression(&scope, value, &format!("the drift of `{name}`")));
    }
    nodes.into_iter().collect()
}

const SHAPE: &str = "write the diagonal of G as { state = \"…\", … } or a value for each state, or all of G as a row for \
                     each state: [[\"…\", …], …]";

/// The entries of G row by row, and the number of its columns.
fn diffusion(context: &mut Context, value: &Value, states: &[String]) -> Option<(Vec<Node>, usize)> {
    match &value.kind {
        Kind::Table(entries) => by_name(context, entries, states),
        Kind::List(items) if items.iter().any(|item| matches!(item.kind, Kind::List(_))) => {
            rows(context, value, items, states)
        }
        Kind::List(_) => {
            let named = Named { noun: "state", names: states };
            let values = named.values(context.findings, value, "`diffusion`")?;
            diagonal(context, values.into_iter().enumerate(), states)
        }
        other => {
            let message = format!("`diffusion` is a table or a list; found {}", other.noun());
            context.findings.wrong_help(&value.span, message, SHAPE);
            None
        }
    }
}

/// The diagonal by name: a state that is left out has no noise.
fn by_name(context: &mut Context, entries: &[Entry], states: &[String]) -> Option<(Vec<Node>, usize)> {
    let named = Named { noun: "state", names: states };
    let index = |entry: &Entry| named.index(context.findings, &entry.key, &entry.span, "`diffusion`");
    // All names are looked at, so that all that are unknown are told.
    let found: Vec<Option<usize>> = entries.iter().map(index).collect();
    let good = found.iter().all(Option::is_some);
    let values = found.into_iter().zip(entries).filter_map(|(i, entry)| Some((i?, &entry.value)));
    diagonal(context, values, states).filter(|_| good)
}

fn diagonal<'v>(
    context: &mut Context,
    values: impl Iterator<Item = (usize, &'v Value)>,
    states: &[String],
) -> Option<(Vec<Node>, usize)> {
    let n = states.len();
    let scope = context.scope(Role::Diffusion);
    let mut nodes = vec![Some(context.graph.constant(0.0)); n * n];
    for (i, value) in values {
        let name = states.get(i).map_or("", String::as_str);
        let what = format!("the diffusion of `{name}`");
        nodes[i * n + i] = if matches!(value.kind, Kind::List(_)) {
            let message = format!("{what} is a number or an expression; found a list");
            context.findings.wrong_help(&value.span, message, SHAPE);
            None
        } else {
            context.finite_expression(&scope, value, &what)
        };
    }
    Some((nodes.into_iter().collect::<Option<Vec<Node>>>()?, n))
}

fn rows(
    context: &mut Context,
    value: &Value,
    items: &[Value],
    states: &[String],
) -> Option<(Vec<Node>, usize)> {
    let n = states.len();
    if items.len() != n {
        let message =
            format!("`diffusion` has {}, but there are {}", count(items.len(), "row"), count(n, "state"));
        context.findings.wrong_help(&value.span, message, "write a row for each state, in their order");
        return None;
    }
    let columns =
        items.iter().find_map(|item| if let Kind::List(row) = &item.kind { Some(row.len()) } else { None });
    let columns = columns.unwrap_or(0);
    if columns > MANY {
        let message = format!("`diffusion` has {columns} columns, more than {MANY}");
        context.findings.wrong(&value.span, message);
        return None;
    }
    let scope = context.scope(Role::Diffusion);
    let mut nodes = Vec::with_capacity(n * columns);
    for (i, item) in items.iter().enumerate() {
        let found = match &item.kind {
            Kind::List(row) if row.len() == columns => {
                for (j, value) in row.iter().enumerate() {
                    let what = format!("row {}, column {} of `diffusion`", i + 1, j + 1);
                    nodes.push(context.finite_expression(&scope, value, &what));
                }
                continue;
            }
            Kind::List(row) => count(row.len(), "value"),
            other => other.noun().to_string(),
        };
        let message = format!("row {} of `diffusion` has {found}, but needs {columns}", i + 1);
        let help = "all rows of G are of one length, its number of independent noises";
        context.findings.wrong_help(&item.span, message, help);
        nodes.push(None);
    }
    Some((nodes.into_iter().collect::<Option<Vec<Node>>>()?, columns))
}
