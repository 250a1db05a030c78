//! Tables and lists of the document: keys, and lists in order or tables by name.

use core::ops::Range;

use givens_expr::suggest;

use super::document::{Entry, Kind, Value};
use crate::findings::{Findings, count, list};

/// A table with its title, such as `[state]`.
#[derive(Clone, Copy)]
pub(super) struct Section<'a> {
    pub title: &'static str,
    /// Where it begins.
    pub span: &'a Range<usize>,
    pub entries: &'a [Entry],
}

impl<'a> Section<'a> {
    /// The table that a key of the document holds. Keys other than `keys` are found wrong.
    pub fn of(findings: &Findings, title: &'static str, entry: &'a Entry, keys: &[&str]) -> Option<Self> {
        let Kind::Table(entries) = &entry.value.kind else {
            let message = format!("{title} is a table; found {}", entry.value.kind.noun());
            findings.wrong_help(
                &entry.span,
                message,
                format!("write {title} on a line of its own, its keys below"),
            );
            return None;
        };
        let section = Self { title, span: &entry.span, entries };
        section.known(findings, keys);
        Some(section)
    }

    /// Finds keys wrong that are not of `keys`.
    pub fn known(&self, findings: &Findings, keys: &[&str]) {
        for entry in self.entries.iter().filter(|entry| !keys.contains(&entry.key.as_str())) {
            unknown_key(findings, entry, self.title, keys);
        }
    }

    /// The entry of a key.
    pub fn get(&self, key: &str) -> Option<&'a Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// The entry of a key that must be there.
    pub fn need(&self, findings: &Findings, key: &str, help: &str) -> Option<&'a Entry> {
        let found = self.get(key);
        if found.is_none() {
            findings.wrong_help(self.span, format!("{} has no `{key}`", self.title), help);
        }
        found
    }
}

/// Finds a key wrong that a table does not know.
pub(super) fn unknown_key(findings: &Findings, entry: &Entry, title: &str, keys: &[&str]) {
    let help = match suggest(&entry.key, keys.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("{title} has the keys {}", list(keys.iter().copied())),
    };
    findings.wrong_help(&entry.span, format!("unknown key `{}` in {title}", entry.key), help);
}

/// What is named: `state`, `measure`.
#[derive(Clone, Copy)]
pub(super) struct Named<'a> {
    pub noun: &'a str,
    pub names: &'a [String],
}

impl Named<'_> {
    fn all(&self) -> String {
        list(self.names.iter().map(String::as_str))
    }

    /// The index of a name, which is found wrong if there is none such.
    pub fn index(&self, findings: &Findings, name: &str, span: &Range<usize>, place: &str) -> Option<usize> {
        let found = self.names.iter().position(|other| other == name);
        if found.is_none() {
            findings.wrong_by(span, || {
                let help = match suggest(name, self.names.iter().map(String::as_str)) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("the {}s are {}", self.noun, self.all()),
                };
                (format!("unknown {} `{name}` in {place}", self.noun), help)
            });
        }
        found
    }

    /// The values of a list in order or of a table by name, one for each name. None if any is missing.
    pub fn values<'a>(&self, findings: &Findings, value: &'a Value, what: &str) -> Option<Vec<&'a Value>> {
        match &value.kind {
            Kind::List(items) if items.len() == self.names.len() => Some(items.iter().collect()),
            Kind::List(items) => {
                let message = format!(
                    "{what} has {}, but there {} {}",
                    count(items.len(), "value"),
                    if self.names.len() == 1 { "is" } else { "are" },
                    count(self.names.len(), self.noun)
                );
                let help = format!("one for each of {}, in this order", self.all());
                findings.wrong_help(&value.span, message, help);
                None
            }
            Kind::Table(entries) => self.by_name(findings, entries, &value.span, what),
            other => {
                let message = format!("{what} is a list or a table; found {}", other.noun());
                let help = format!("write [ … ] in the order of the {}s, or {{ name = … }}", self.noun);
                findings.wrong_help(&value.span, message, help);
                None
            }
        }
    }

    fn by_name<'a>(
        &self,
        findings: &Findings,
        entries: &'a [Entry],
        span: &Range<usize>,
        what: &str,
    ) -> Option<Vec<&'a Value>> {
        let mut found: Vec<Option<&Value>> = vec![None; self.names.len()];
        let mut unknown = 0;
        for entry in entries {
            match self.index(findings, &entry.key, &entry.span, what) {
                Some(index) => found[index] = Some(&entry.value),
                None => unknown += 1,
            }
        }
        let missing =
            || self.names.iter().zip(&found).filter(|(_, value)| value.is_none()).map(|(name, _)| name);
        let number = missing().count();
        // An unknown name is likely a missing one, misspelt.
        if number > unknown {
            let plural = if number == 1 { "" } else { "s" };
            let names = list(missing().map(String::as_str));
            let first = missing().next().map_or("", String::as_str);
            let help = match what {
                "`transition`" => {
                    format!("a state that stays as it is has the transition {first} = \"{first}\"")
                }
                "`drift`" => format!("a state that stays as it is has the drift {first} = 0"),
                _ => format!("add {first} = …"),
            };
            let message = format!("{what} leaves out the {}{plural} {names}", self.noun);
            findings.wrong_help(span, message, help);
        }
        found.into_iter().collect()
    }
}

/// The text of a value, which must be one.
pub(super) fn text<'a>(findings: &Findings, value: &'a Value, what: &str) -> Option<&'a str> {
    match &value.kind {
        Kind::Text(text, _) => Some(text),
        other => {
            findings.wrong_help(
                &value.span,
                format!("{what} is a text; found {}", other.noun()),
                "write it in quotes",
            );
            None
        }
    }
}

/// The items of a list of texts, each with its span.
pub(super) fn texts<'a>(
    findings: &Findings,
    value: &'a Value,
    what: &str,
) -> Option<Vec<(&'a str, &'a Range<usize>)>> {
    let Kind::List(items) = &value.kind else {
        let message = format!("{what} is a list of names; found {}", value.kind.noun());
        findings.wrong_help(&value.span, message, "write [\"…\", \"…\"]");
        return None;
    };
    // All items are looked at, so that all that are wrong are told.
    let texts: Vec<_> = items.iter().map(|item| Some((text(findings, item, what)?, &item.span))).collect();
    texts.into_iter().collect()
}
