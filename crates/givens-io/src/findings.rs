//! Collects errors, so that one reading tells all that is wrong.

use core::cell::{Cell, RefCell};
use core::ops::Range;

use crate::error::{InputError, InputErrors};
use crate::source::{Source, whole};

/// The errors found so far in one source.
pub(crate) struct Findings<'a> {
    pub source: &'a Source,
    errors: RefCell<Vec<InputError>>,
    /// Bytes of the lines that they show.
    shown: Cell<usize>,
    more: Cell<usize>,
}

/// What was found in the stretches of a text before.
#[derive(Default)]
pub(crate) struct Found {
    errors: Vec<InputError>,
    shown: usize,
    more: usize,
}

impl Found {
    /// `value`, if nothing was wrong; a value of the file `name` that could not be made has left a finding.
    pub fn finish<T>(self, name: &str, value: Option<T>) -> Result<T, InputErrors> {
        match value {
            Some(value) if self.errors.is_empty() => Ok(value),
            _ if self.errors.is_empty() => Err(whole(name, "could not be understood").into()),
            _ => Err(InputErrors::sorted(self.errors, self.more)),
        }
    }
}

/// Errors that are kept; of those beyond only the number is told.
const KEPT: usize = 100;

/// Bytes of lines that errors show, if there are several: a line may be as long as its file.
const SHOWN: usize = 1 << 20;

impl<'a> Findings<'a> {
    pub fn new(source: &'a Source) -> Self {
        Self::after(Found::default(), source)
    }

    /// Goes on with the next stretch of a text.
    pub fn after(found: Found, source: &'a Source) -> Self {
        let Found { errors, shown, more } = found;
        Self { source, errors: RefCell::new(errors), shown: Cell::new(shown), more: Cell::new(more) }
    }

    /// What was found so far.
    pub fn found(self) -> Found {
        Found { errors: self.errors.into_inner(), shown: self.shown.get(), more: self.more.get() }
    }

    pub fn push(&self, error: InputError) {
        self.push_with(|| error);
    }

    /// An error is made only where there is room: each shows its line, and there may be as many as there are characters.
    fn push_with(&self, error: impl FnOnce() -> InputError) {
        if !self.room() {
            return self.more.set(self.more.get() + 1);
        }
        let error = error();
        self.shown.set(self.shown.get() + error.place.as_ref().map_or(0, |place| place.source.len()));
        self.errors.borrow_mut().push(error);
    }

    /// Whether there is room for more errors; those beyond are only counted.
    pub fn room(&self) -> bool {
        self.errors.borrow().len() < KEPT && self.shown.get() < SHOWN
    }

    pub fn wrong(&self, span: &Range<usize>, message: impl Into<String>) {
        self.push_with(|| self.source.error(span.clone(), message));
    }

    pub fn wrong_help(&self, span: &Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.push_with(|| self.source.error(span.clone(), message).with_help(help));
    }

    /// An error and its remedy, where it takes long to find the remedy.
    pub fn wrong_by(&self, span: &Range<usize>, told: impl FnOnce() -> (String, String)) {
        self.push_with(|| {
            let (message, help) = told();
            self.source.error(span.clone(), message).with_help(help)
        });
    }

    /// An error about a row of a table that is no text.
    pub fn wrong_in_row(&self, row: usize, told: impl FnOnce() -> (String, String)) {
        self.push_with(|| {
            let (message, help) = told();
            self.source.whole(format!("row {row}: {message}")).with_help(help)
        });
    }

    /// [`Self::wrong`] with a remedy where there is one.
    pub fn wrong_maybe(&self, span: &Range<usize>, message: impl Into<String>, help: Option<String>) {
        self.push_with(|| InputError { help, ..self.source.error(span.clone(), message) });
    }

    pub fn none(&self) -> bool {
        self.errors.borrow().is_empty()
    }

    /// `value`, if nothing was wrong; a value that could not be made has left a finding.
    pub fn finish<T>(self, value: Option<T>) -> Result<T, InputErrors> {
        let name = &self.source.name;
        self.found().finish(name, value)
    }
}

/// Names in backquotes, for a message: a few of them, then a count.
pub(crate) fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    const FEW: usize = 12;
    let all: Vec<&str> = names.into_iter().collect();
    let text = all.iter().take(FEW).map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    match all.len().saturating_sub(FEW) {
        0 => text,
        more => format!("{text} and {more} more"),
    }
}

/// `1 state`, `2 states`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}s") }
}
