//! Collects errors, so that one reading tells all that is wrong.

use core::cell::RefCell;
use core::ops::Range;

use crate::error::{InputError, InputErrors};
use crate::source::Source;

/// The errors found so far in one source.
pub(crate) struct Findings<'a> {
    pub source: &'a Source,
    errors: RefCell<Vec<InputError>>,
    more: core::cell::Cell<usize>,
}

/// Errors that are kept; of those beyond only the number is told.
const KEPT: usize = 100;

impl<'a> Findings<'a> {
    pub fn new(source: &'a Source) -> Self {
        Self { source, errors: RefCell::default(), more: core::cell::Cell::new(0) }
    }

    pub fn push(&self, error: InputError) {
        let mut errors = self.errors.borrow_mut();
        if errors.len() < KEPT {
            errors.push(error);
        } else {
            self.more.set(self.more.get() + 1);
        }
    }

    /// Whether there is room for more errors; those beyond are only counted.
    pub fn room(&self) -> bool {
        self.errors.borrow().len() < KEPT
    }

    pub fn wrong(&self, span: &Range<usize>, message: impl Into<String>) {
        self.push(self.source.error(span.clone(), message));
    }

    pub fn wrong_help(&self, span: &Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.push(self.source.error(span.clone(), message).with_help(help));
    }

    /// [`Self::wrong`] with a remedy where there is one.
    pub fn wrong_maybe(&self, span: &Range<usize>, message: impl Into<String>, help: Option<String>) {
        let error = self.source.error(span.clone(), message);
        self.push(InputError { help, ..error });
    }

    pub fn none(&self) -> bool {
        self.errors.borrow().is_empty()
    }

    /// `value`, if nothing was wrong; a value that could not be made has left a finding.
    pub fn finish<T>(self, value: Option<T>) -> Result<T, InputErrors> {
        let errors = self.errors.into_inner();
        match value {
            Some(value) if errors.is_empty() => Ok(value),
            _ if errors.is_empty() => Err(self.source.whole("could not be understood").into()),
            _ => Err(InputErrors::sorted(errors, self.more.get())),
        }
    }
}

/// Names in backquotes, for a message: a few of them, then a count.
pub(crate) fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    const FEW: usize = 12;
    let all: Vec<&str> = names.into_iter().collect();
    let mut text = all.iter().take(FEW).map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    if all.len() > FEW {
        text.push_str(&format!(" and {} more", all.len() - FEW));
    }
    text
}

/// `1 state`, `2 states`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}s") }
}
