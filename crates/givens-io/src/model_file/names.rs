//! Which names may be given.

use core::ops::Range;
use std::collections::HashMap;

use givens_expr::{is_name, is_reserved};

use crate::findings::Findings;

/// Columns of every table.
const COLUMNS: &[&str] = &["time", "sensor", "track_id"];
/// Columns that an output has beside the states.
const RESULTS: &[&str] = &["nis", "nis_dof", "log_likelihood", "gated"];

/// What a name is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    State,
    Parameter,
    Let,
    Measure,
}

impl Use {
    fn noun(self) -> &'static str {
        match self {
            Use::State => "a state",
            Use::Parameter => "a parameter",
            Use::Let => "an expression of [let]",
            Use::Measure => "a measure",
        }
    }
}

/// Whether a character breaks a line, or steers a terminal.
pub(super) fn breaks(c: char) -> bool {
    c.is_control() || matches!(c, '\u{2028}' | '\u{2029}')
}

/// Why a name may not be given, if it may not: a message and the remedy.
fn refused(name: &str, used: Use) -> Option<(String, String)> {
    let noun = used.noun();
    let another = || "choose another name".to_string();
    let reserved =
        |as_what: &str| Some((format!("`{name}` is {as_what}, so {noun} cannot have this name"), another()));
    if name.trim().is_empty() {
        return Some((format!("{noun} has an empty name"), "give it a name".into()));
    }
    match name {
        "t" => return reserved("the time"),
        "dt" => return reserved("the length of a step"),
        "pi" => return reserved("the number π"),
        _ => {}
    }
    if matches!(name, "and" | "or" | "not") {
        return reserved("an operator");
    }
    if is_reserved(name) {
        return reserved("a function");
    }
    if name.starts_with("u_") {
        return Some((
            format!("names that begin with `u_` are controls, so {noun} cannot be called `{name}`"),
            another(),
        ));
    }
    if matches!(used, Use::State | Use::Measure) && COLUMNS.contains(&name) {
        return reserved("a column of every table");
    }
    if used == Use::State && RESULTS.contains(&name) {
        return reserved("a column of every output");
    }
    if used == Use::Measure {
        // A measure is a column first; only `start` names it in expressions.
        let odd = name.trim() != name || name.chars().any(breaks);
        return odd.then(|| {
            (format!("the measure {name:?} begins or ends with a space, or has a line end or a control character"), another())
        });
    }
    (!is_name(name)).then(|| {
        let help = "names are made of letters, digits and _, and begin with no digit".to_string();
        (format!("`{name}` cannot be the name of {noun}"), help)
    })
}

/// Finds names wrong that may not be given, and those given twice.
pub(super) struct Names<'a> {
    findings: &'a Findings<'a>,
    taken: HashMap<String, (Use, Range<usize>)>,
}

impl<'a> Names<'a> {
    pub fn new(findings: &'a Findings<'a>) -> Self {
        Self { findings, taken: HashMap::new() }
    }

    /// Takes a name for states, parameters and `[let]`, which expressions tell apart by name alone. Whether it could
    /// be taken.
    pub fn take(&mut self, name: &str, used: Use, span: &Range<usize>) -> bool {
        if let Some((message, help)) = refused(name, used) {
            self.findings.wrong_help(span, message, help);
            false
        } else if let Some((other, at)) = self.taken.get(name) {
            let line = self.findings.source.place(at.clone()).line;
            let message = if *other == used {
                format!("the name `{name}` is given twice (line {line})")
            } else {
                format!("`{name}` is {} already (line {line})", other.noun())
            };
            self.findings.wrong_help(span, message, "rename one of them");
            false
        } else {
            self.taken.insert(name.to_string(), (used, span.clone()));
            true
        }
    }

    /// Looks at the name of a measure: a column, which may bear the name of a state.
    pub fn measure(&self, name: &str, span: &Range<usize>) {
        if let Some((message, help)) = refused(name, Use::Measure) {
            self.findings.wrong_help(span, message, help);
        }
    }
}
