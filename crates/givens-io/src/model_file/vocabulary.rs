//! The names that expressions may use, and where each may stand.

use std::collections::BTreeSet;

use givens_expr::{ExprError, Graph, Input, Meaning, Node, Scope, names, parse};

use super::document::{Kind, Value};
use crate::findings::Findings;

/// Where an expression stands; this decides what it may depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Let,
    Transition,
    ProcessNoise,
    Drift,
    Diffusion,
    Measure,
    MeasurementNoise,
    Start,
    /// Evaluated once, when the model is read.
    Fixed,
}

impl Role {
    /// Why a quantity may not stand here, and the remedy; none if it may.
    fn forbids(self, input: Input) -> Option<&'static str> {
        let may = match input {
            Input::Parameter(_) => true,
            Input::Time | Input::Control(_) => self != Role::Fixed,
            Input::State(_) => {
                matches!(self, Role::Let | Role::Transition | Role::Drift | Role::Diffusion | Role::Measure)
            }
            Input::Step => matches!(self, Role::Let | Role::Transition | Role::ProcessNoise),
            Input::Measure(_) => self == Role::Start,
        };
        if may {
            return None;
        }
        Some(match (self, input) {
            (Role::Fixed, _) => "only numbers and parameters may, since this is evaluated before any data",
            (Role::Drift | Role::Diffusion, Input::Step) => {
                "drift and diffusion are rates, which hold at a moment; only `transition` and `noise_cov` have a step"
            }
            (_, Input::Step) => "a measurement has no step; only transition and noise_cov depend on `dt`",
            (Role::Start, _) => "`start` finds the states from measures; use their names",
            (_, Input::State(_)) => {
                "a noise covariance may not depend on the state; use parameters, `t` and controls"
            }
            _ => "measures may be named in `start` only",
        })
    }
}

/// Stands for a name whose definition was found wrong, so that its users are not found wrong as well.
const BROKEN: Input = Input::Measure(u32::MAX);

/// What a name stands for whose definition was found wrong.
pub(super) fn broken(graph: &mut Graph) -> Node {
    graph.input(BROKEN)
}

/// All names of a model file with what they stand for.
#[derive(Debug, Default)]
pub(super) struct Vocabulary {
    /// Each with all that it depends on, which is looked for once: a definition may be long, and scopes are many.
    words: Vec<(String, Node, BTreeSet<Input>)>,
    /// Names of measures, for `start`: each with its place in the stack, or none if sensors share it.
    measures: Vec<(String, Option<Node>)>,
}

impl Vocabulary {
    /// Gives a name its meaning; a definition that was found wrong is none.
    pub fn define(&mut self, graph: &mut Graph, name: &str, node: Option<Node>) {
        let node = node.unwrap_or_else(|| broken(graph));
        self.words.push((name.to_string(), node, graph.inputs_of(node)));
    }

    /// Gives `start` the name of a measure; a name that two sensors share is none's.
    pub fn define_measure(&mut self, graph: &mut Graph, name: &str, index: usize) {
        if let Some((_, shared)) = self.measures.iter_mut().find(|(other, _)| other == name) {
            *shared = None;
        } else {
            self.measures.push((name.to_string(), Some(graph.input(Input::Measure(index as u32)))));
        }
    }

    /// The names that may stand in a role, and why the others may not.
    pub fn scope(&self, role: Role) -> Scope {
        let mut scope = Scope::new();
        for (name, node, inputs) in &self.words {
            scope.insert(name.as_str(), meaning(role, *node, inputs));
        }
        for (name, node) in self.measures.iter().filter(|_| role == Role::Start) {
            let taken = matches!(scope.get(name), Some(Meaning::Is(_)));
            let meaning = match node {
                _ if taken => {
                    Meaning::Forbidden("it is both a measure and a parameter or of [let]; rename one".into())
                }
                Some(node) => Meaning::Is(*node),
                None => {
                    Meaning::Forbidden("several sensors have this measure; give it different names".into())
                }
            };
            scope.insert(name.as_str(), meaning);
        }
        scope
    }
}

fn meaning(role: Role, node: Node, inputs: &BTreeSet<Input>) -> Meaning {
    if inputs.contains(&BROKEN) {
        return Meaning::Is(node);
    }
    match inputs.iter().find_map(|&input| role.forbids(input)) {
        Some(why) => Meaning::Forbidden(why.into()),
        None => Meaning::Is(node),
    }
}

/// Reads a number, or an expression in the names of `scope`; what is wrong is found so.
pub(super) fn expression(
    findings: &Findings,
    graph: &mut Graph,
    scope: &Scope,
    value: &Value,
    what: &str,
) -> Option<Node> {
    expression_by(parse, findings, graph, scope, value, what)
}

/// How a text becomes a node.
type Read = fn(&mut Graph, &Scope, &str) -> Result<Node, ExprError>;

/// [`expression`] by another reader of text.
pub(super) fn expression_by(
    read: Read,
    findings: &Findings,
    graph: &mut Graph,
    scope: &Scope,
    value: &Value,
    what: &str,
) -> Option<Node> {
    // what was found is told, and a wrong name is compared with all others
    if !findings.room() {
        return None;
    }
    let broken = broken(graph);
    match &value.kind {
        Kind::Number(number) if number.is_finite() => Some(graph.constant(*number)),
        Kind::Number(_) => {
            findings.wrong_help(
                &value.span,
                format!("{what} is not a finite number"),
                "write a finite number",
            );
            None
        }
        Kind::Text(text, _) if names(text).any(|(_, name)| is(scope, name, broken)) => None,
        Kind::Text(text, _) => match read(graph, scope, text) {
            Ok(node) => Some(node),
            Err(error) => {
                let name = text.get(error.span.clone()).unwrap_or("");
                let help = error.help.map(|help| {
                    let listed = help.starts_with("known here");
                    if listed { help + &or_control(scope, name) } else { help }
                });
                findings.wrong_maybe(
                    &value.within(&error.span),
                    format!("{} in {what}", error.message),
                    help,
                );
                None
            }
        },
        other => {
            let message = format!("{what} is a number or an expression; found {}", other.noun());
            findings.wrong_help(&value.span, message, "write a number, or an expression in quotes");
            None
        }
    }
}

/// What else an unknown name may have been meant for, where controls may stand.
fn or_control(scope: &Scope, name: &str) -> String {
    let may = matches!(scope.get("t"), Some(Meaning::Is(_)));
    if may && name.len() <= 40 { format!(" (a control would be `u_{name}`)") } else { String::new() }
}

/// Whether a name stands for this node: a definition with a broken name is broken as a whole.
fn is(scope: &Scope, name: &str, node: Node) -> bool {
    matches!(scope.get(name), Some(Meaning::Is(of)) if *of == node)
}

/// Whether a node is made of what was found wrong.
pub(super) fn is_broken_node(graph: &Graph, node: Node) -> bool {
    graph.inputs_of(node).contains(&BROKEN)
}

/// The controls that expressions in a value use, each with the byte where it stands.
pub(super) fn controls(value: &Value, found: &mut Vec<(usize, String)>) {
    match &value.kind {
        Kind::Text(text, _) => {
            let used = names(text).filter(|(_, name)| name.starts_with("u_"));
            found.extend(used.map(|(at, name)| (value.within(&at).start, name.to_string())));
        }
        Kind::List(items) => items.iter().for_each(|item| controls(item, found)),
        Kind::Table(entries) => entries.iter().for_each(|entry| controls(&entry.value, found)),
        Kind::Number(_) | Kind::Truth(_) | Kind::Moment(_) => {}
    }
}
