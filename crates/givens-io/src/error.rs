//! Errors about input: where, what, and the remedy.

use core::fmt;

/// A stretch of one line of a text file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line, from one.
    pub line: usize,
    /// Column in characters, from one.
    pub column: usize,
    /// Length in characters, at least one.
    pub width: usize,
    /// The whole line, without its end.
    pub source: String,
}

/// A place in a named file: what is kept of an input that may prove wrong later.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// The file as the user named it.
    pub file: String,
    /// The place in the file, where one is known.
    pub place: Option<Place>,
}

impl Location {
    /// An error at this location.
    #[must_use]
    pub fn error(&self, message: impl Into<String>) -> InputError {
        InputError { file: self.file.clone(), place: self.place.clone(), message: message.into(), help: None }
    }
}

/// One thing that is wrong with an input.
///
/// ```
/// use givens_io::{InputError, Place};
/// let source = r#"x = "x + dt*vz""#.to_string();
/// let error = InputError {
///     file: "model.toml".into(),
///     place: Some(Place { line: 14, column: 13, width: 2, source }),
///     message: "unknown name `vz`".into(),
///     help: Some("did you mean `vx`?".into()),
/// };
/// assert_eq!(error.to_string(), r#"model.toml:14:13: unknown name `vz`
///   14 | x = "x + dt*vz"
///      |             ^^
///   help: did you mean `vx`?"#);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputError {
    /// The file as the user named it, or the option that brought the input.
    pub file: String,
    /// Where in the file; none if the whole of it is meant.
    pub place: Option<Place>,
    /// What is wrong: the quantity by name.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl InputError {
    /// The same with a remedy.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// What is wrong, where and the remedy, in a line without the file's name.
    pub(crate) fn brief(self) -> String {
        let at = self.place.map_or(String::new(), |place| format!("line {}: ", place.line));
        let help = self.help.map_or(String::new(), |help| format!("; {help}"));
        format!("{at}{}{help}", self.message)
    }

    /// Line and column, from one; zeros where no place is known.
    #[must_use]
    pub fn position(&self) -> (usize, usize) {
        self.place.as_ref().map_or((0, 0), |place| (place.line, place.column))
    }
}

/// Characters of a source line that are shown around the place of an error.
const SHOWN: usize = 120;

/// Writes the line and, below it, carets under the place. Of a long line only the neighbourhood is shown.
fn excerpt(f: &mut fmt::Formatter<'_>, place: &Place) -> fmt::Result {
    let at = place.column.saturating_sub(1);
    let from = if place.source.chars().count() <= SHOWN { 0 } else { at.saturating_sub(SHOWN / 2) };
    let (number, dots) = (place.line.to_string(), if from > 0 { "…" } else { "" });
    write!(f, "\n  {number} | {dots}")?;
    let mut window = place.source.chars().skip(from);
    for c in window.by_ref().take(SHOWN) {
        write!(f, "{}", shown(c))?;
    }
    if window.next().is_some() {
        write!(f, "…")?;
    }
    write!(f, "\n  {:w$} | {:d$}", "", "", w = number.len(), d = dots.chars().count())?;
    for c in place.source.chars().chain(core::iter::repeat(' ')).take(at).skip(from) {
        write!(f, "{}", if c == '\t' { '\t' } else { ' ' })?;
    }
    let room = SHOWN.saturating_sub(at.saturating_sub(from)).max(1);
    write!(f, "{}", "^".repeat(place.width.clamp(1, room)))
}

/// Control characters would move the cursor of a terminal.
fn shown(c: char) -> char {
    if c.is_control() && c != '\t' { '\u{fffd}' } else { c }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.file)?;
        if let Some(place) = &self.place {
            write!(f, "{}:{}:", place.line, place.column)?;
        }
        write!(f, " {}", self.message)?;
        if let Some(place) = &self.place {
            excerpt(f, place)?;
        }
        if let Some(help) = &self.help {
            write!(f, "\n  help: {help}")?;
        }
        Ok(())
    }
}

impl core::error::Error for InputError {}

/// All that was found wrong with an input, the earliest place first. Never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputErrors {
    /// The errors that are told one by one.
    pub errors: Vec<InputError>,
    /// How many more there are of their kind.
    pub more: usize,
}

/// Errors that are told one by one; a table of a million bad cells shall not fill the screen.
const TOLD: usize = 20;

impl InputErrors {
    /// Sorts the errors by place and keeps the first twenty; `more` counts those that were found but not kept.
    pub(crate) fn sorted(mut errors: Vec<InputError>, more: usize) -> Self {
        errors.sort_by_key(InputError::position);
        errors.dedup();
        let beyond = errors.len().saturating_sub(TOLD);
        errors.truncate(TOLD);
        Self { errors, more: more + beyond }
    }

    /// The earliest error.
    pub fn first(&self) -> Option<&InputError> {
        self.errors.first()
    }
}

impl From<InputError> for InputErrors {
    fn from(error: InputError) -> Self {
        Self { errors: vec![error], more: 0 }
    }
}

impl fmt::Display for InputErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, error) in self.errors.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{error}")?;
        }
        match self.more {
            0 => Ok(()),
            1 => write!(f, "\nand 1 error more"),
            more => write!(f, "\nand {more} errors more"),
        }
    }
}

impl core::error::Error for InputErrors {}
