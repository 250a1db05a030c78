//! TOML as a tree in file order, each value with its span.

use core::ops::Range;

use toml::de::{DeTable, DeValue};

use crate::findings::Findings;
use crate::source::Source;

/// A key, where it stands, and its value.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub key: String,
    pub span: Range<usize>,
    pub value: Value,
}

/// A value and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Value {
    pub kind: Kind,
    pub span: Range<usize>,
}

/// What a value is.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    /// A string, and the byte of the source at which it begins if it stands there letter by letter.
    Text(String, Option<usize>),
    Number(f64),
    Truth(bool),
    /// A date or time, as written.
    Moment(String),
    List(Vec<Value>),
    Table(Vec<Entry>),
}

impl Kind {
    /// The kind in words, for "found …".
    pub fn noun(&self) -> &'static str {
        match self {
            Kind::Text(..) => "a string",
            Kind::Number(_) => "a number",
            Kind::Truth(_) => "a truth value",
            Kind::Moment(_) => "a date or time",
            Kind::List(_) => "a list",
            Kind::Table(_) => "a table",
        }
    }
}

impl Value {
    /// The span of a part of a string, given in bytes of the string; the whole value where escapes hide the place.
    pub fn within(&self, part: &Range<usize>) -> Range<usize> {
        match self.kind {
            Kind::Text(_, Some(start)) => start + part.start..start + part.end,
            _ => self.span.clone(),
        }
    }
}

/// Reads a document; the first slip in the syntax of TOML is found wrong, and there is no tree then.
pub(super) fn read(findings: &Findings) -> Option<Vec<Entry>> {
    let source = findings.source;
    let (table, errors) = DeTable::parse_recoverable(&source.text);
    if errors.is_empty() {
        return Some(entries(table.into_inner(), source));
    }
    // One slip makes many errors after it.
    let spans = errors.iter().map(|error| error.span().unwrap_or_else(|| deepest(source)));
    if let Some((span, error)) = spans.zip(&errors).min_by_key(|(span, _)| span.start) {
        if is_table(source) {
            let message = "this is a table, not a model file";
            findings.wrong_help(&(0..source.line(0).len()), message, "the model comes first, then the data");
            return None;
        }
        let found = source.text.get(span.clone()).and_then(|found| found.lines().next()).unwrap_or("").trim();
        let found = if found.is_empty() { String::new() } else { format!(" at `{found}`") };
        let help = "strings stand in quotes, lists in [ ], tables in { }, with commas between their items";
        findings.wrong_help(&span, format!("not valid TOML{found}: {}", error.message()), help);
    }
    None
}

/// The line that opens the most tables and lists: where a document nests too deeply to be read, as far as is known.
fn deepest(source: &Source) -> Range<usize> {
    let opens = |line: &str| line.bytes().filter(|byte| b".[{".contains(byte)).count();
    let mut at = 0;
    let lines = source.text.split_inclusive('\n');
    let spans: Vec<_> = lines
        .map(|line| {
            at += line.len();
            (opens(line), at - line.len()..at - line.len() + line.trim_end().len())
        })
        .collect();
    spans.into_iter().rev().max_by_key(|(opens, _)| *opens).map_or(0..0, |(_, span)| span)
}

/// Whether the text, which is no TOML, begins as tables do: with names and commas between.
fn is_table(source: &Source) -> bool {
    let first = source.line(0);
    first.contains(',') && !first.contains(['=', '[', '#'])
}

fn entries(table: DeTable, source: &Source) -> Vec<Entry> {
    let mut entries: Vec<Entry> = table
        .into_iter()
        .map(|(key, value)| Entry {
            span: key.span(),
            key: key.into_inner().into_owned(),
            value: Value { span: value.span(), kind: kind(value.span(), value.into_inner(), source) },
        })
        .collect();
    entries.sort_by_key(|entry| entry.span.start);
    entries
}

fn kind(span: Range<usize>, value: DeValue, source: &Source) -> Kind {
    match value {
        DeValue::String(text) => {
            let start = verbatim(&span, &text, source);
            Kind::Text(text.into_owned(), start)
        }
        DeValue::Integer(integer) => Kind::Number(whole(integer.as_str(), integer.radix())),
        DeValue::Float(float) => Kind::Number(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(truth) => Kind::Truth(truth),
        DeValue::Datetime(moment) => {
            Kind::Moment(source.text.get(span).map_or_else(|| moment.to_string(), str::to_string))
        }
        DeValue::Array(list) => Kind::List(
            list.into_iter()
                .map(|item| Value { span: item.span(), kind: kind(item.span(), item.into_inner(), source) })
                .collect(),
        ),
        DeValue::Table(table) => Kind::Table(entries(table, source)),
    }
}

fn whole(digits: &str, radix: u32) -> f64 {
    match radix {
        10 => digits.parse().unwrap_or(f64::NAN),
        _ => i128::from_str_radix(digits, radix).map_or(f64::NAN, |number| number as f64),
    }
}

/// Where a string begins in the source, if no escape stands between.
fn verbatim(span: &Range<usize>, text: &str, source: &Source) -> Option<usize> {
    let raw = source.text.get(span.clone())?;
    let quote = raw.get(..3).filter(|three| matches!(*three, "\"\"\"" | "'''")).or_else(|| raw.get(..1))?;
    let inner = raw.strip_prefix(quote)?.strip_suffix(quote)?;
    // The first line end of a string of several lines is no part of it.
    let end = if quote.len() == 1 { 0 } else { inner.len() - without_line_end(inner).len() };
    (inner.get(end..)? == text).then_some(span.start + quote.len() + end)
}

fn without_line_end(text: &str) -> &str {
    text.strip_prefix("\r\n").or_else(|| text.strip_prefix('\n')).unwrap_or(text)
}
