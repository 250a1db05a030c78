//! `[parameters]` and `[let]`: the names that expressions share.

use std::collections::{BTreeSet, HashMap};

use givens_expr::{Input, Meaning, names, parse_any, suggest};

use super::context::Context;
use super::document::{Entry, Kind};
use super::names::{Names, Use};
use super::section::Section;
use super::vocabulary::{Role, broken, expression_by};
use crate::findings::{Findings, list};

/// Reads the parameters and takes up those that are set from outside. A parameter may be an expression in those
/// that stand above it.
pub(super) fn parameters(
    context: &mut Context,
    section: Option<Section>,
    given: &[(&str, f64)],
    taken: &mut Names,
) -> Vec<(String, f64)> {
    let entries = section.map_or(&[][..], |section| section.entries);
    unknown(context.findings, entries, given);
    let mut found = Vec::with_capacity(entries.len());
    for entry in entries {
        taken.take(&entry.key, Use::Parameter, &entry.span);
        let scope = context.scope(Role::Fixed);
        let what = format!("the parameter `{}`", entry.key);
        let written = context.number(&scope, &entry.value, &what);
        let value = given.iter().rev().find(|(name, _)| *name == entry.key).map(|(_, value)| *value).or(written);
        let index = context.parameters.len();
        context.parameters.push(value.unwrap_or(f64::NAN));
        let node = value.map(|_| context.graph.input(Input::Parameter(index as u32)));
        context.vocabulary.define(&mut context.graph, &entry.key, node);
        found.push((entry.key.clone(), value.unwrap_or(f64::NAN)));
    }
    found
}

/// Finds values wrong that are set for no parameter of the model, or are no numbers.
fn unknown(findings: &Findings, entries: &[Entry], given: &[(&str, f64)]) {
    let names = || entries.iter().map(|entry| entry.key.as_str());
    for (name, value) in given {
        if !names().any(|other| other == *name) {
            let help = match suggest(name, names()) {
                Some(near) => format!("did you mean `{near}`?"),
                None if entries.is_empty() => "it has no [parameters]".into(),
                None => format!("it has {}", list(names())),
            };
            let message = format!("the parameter `{name}` was set, but the model has none of this name");
            findings.push(findings.source.whole(message).with_help(help));
        } else if !value.is_finite() {
            let message = format!("the parameter `{name}` was set to {value}, not a finite number");
            findings.push(findings.source.whole(message));
        }
    }
}

/// Reads the subexpressions of `[let]`, which may use each other in any order but not in a circle.
pub(super) fn lets(context: &mut Context, section: Option<Section>, taken: &mut Names) {
    let entries = section.map_or(&[][..], |section| section.entries);
    for entry in entries {
        taken.take(&entry.key, Use::Let, &entry.span);
    }
    let order = order(entries);
    circle(context.findings, entries, &order);
    let mut scope = context.scope(Role::Let);
    for &index in &order.done {
        let Some(entry) = entries.get(index) else { continue };
        let what = format!("`{}`", entry.key);
        // A definition may be a condition, for `where`.
        let node = expression_by(parse_any, context.findings, &mut context.graph, &scope, &entry.value, &what);
        context.vocabulary.define(&mut context.graph, &entry.key, node);
        let node = node.unwrap_or_else(|| broken(&mut context.graph));
        scope.insert(entry.key.as_str(), Meaning::Is(node));
    }
    for index in order.left {
        if let Some(entry) = entries.get(index) {
            context.vocabulary.define(&mut context.graph, &entry.key, None);
        }
    }
}

/// The entries in an order in which each uses only those before it, and those for which there is none.
struct Order {
    done: Vec<usize>,
    left: BTreeSet<usize>,
    /// For each entry, the entries that it uses.
    uses: Vec<Vec<usize>>,
}

fn order(entries: &[Entry]) -> Order {
    let index: HashMap<&str, usize> = entries.iter().enumerate().map(|(i, entry)| (entry.key.as_str(), i)).collect();
    let uses = |entry: &Entry| -> Vec<usize> {
        let Kind::Text(text, _) = &entry.value.kind else { return Vec::new() };
        let used: BTreeSet<usize> = names(text).filter_map(|(_, name)| index.get(name).copied()).collect();
        used.into_iter().collect()
    };
    let uses: Vec<Vec<usize>> = entries.iter().map(uses).collect();
    let mut users: Vec<Vec<usize>> = vec![Vec::new(); entries.len()];
    for (user, used) in uses.iter().enumerate() {
        for &used in used {
            users[used].push(user);
        }
    }
    let mut open: Vec<usize> = uses.iter().map(Vec::len).collect();
    let mut ready: BTreeSet<usize> = (0..entries.len()).filter(|&i| open[i] == 0).collect();
    let mut done = Vec::with_capacity(entries.len());
    while let Some(next) = ready.pop_first() {
        done.push(next);
        for &user in &users[next] {
            open[user] -= 1;
            if open[user] == 0 {
                ready.insert(user);
            }
        }
    }
    let finished: BTreeSet<usize> = done.iter().copied().collect();
    Order { done, left: (0..entries.len()).filter(|i| !finished.contains(i)).collect(), uses }
}

/// Finds one circle wrong: from an entry that is left, what it uses and is left, until one comes again.
fn circle(findings: &Findings, entries: &[Entry], order: &Order) {
    let Some(&first) = order.left.first() else { return };
    let mut path = vec![first];
    let mut seen = HashMap::from([(first, 0)]);
    loop {
        let last = path.last().copied().unwrap_or(first);
        let next = order.uses.get(last).and_then(|uses| uses.iter().find(|used| order.left.contains(used)));
        let Some(&next) = next else { return };
        if let Some(&start) = seen.get(&next) {
            path.drain(..start);
            path.push(next);
            break;
        }
        seen.insert(next, path.len());
        path.push(next);
    }
    let ring: Vec<&str> = path.iter().filter_map(|&i| entries.get(i)).map(|entry| entry.key.as_str()).collect();
    if let Some(entry) = path.iter().min().and_then(|&i| entries.get(i)) {
        let shown = if ring.len() > 12 { format!("{} → …", ring[..12].join(" → ")) } else { ring.join(" → ") };
        let message = format!("[let] defines `{}` by itself: {shown}", entry.key);
        findings.wrong_help(&entry.span, message, "write one of them without the others");
    }
}
