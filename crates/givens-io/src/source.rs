//! A text with its name: spans of bytes become places.

use core::ops::Range;
use std::io::Read;

use crate::error::{InputError, Location, Place};
use crate::table::MAGIC;

/// A text that was read, and the name under which errors speak of it.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub name: String,
    pub text: String,
    /// Where each line begins.
    lines: Vec<usize>,
    /// Lines before the text, which is a stretch of a longer one.
    before: usize,
}

/// A byte order mark, which is no part of a text.
pub(crate) const MARK: &[u8] = "\u{feff}".as_bytes();

impl Source {
    pub fn new(name: &str, mut text: String) -> Self {
        if text.as_bytes().starts_with(MARK) {
            text.drain(..MARK.len());
        }
        Self::stretch(name, text, 0)
    }

    /// A stretch of a text, behind so many lines of it.
    pub fn stretch(name: &str, text: String, before: usize) -> Self {
        let lines = core::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Self { name: name.to_string(), text, lines, before }
    }

    /// Reads a file, or standard input for `-`.
    pub fn read(path: &str) -> Result<Self, InputError> {
        Self::read_up_to(path, u64::MAX)
    }

    /// The same, of at most so many bytes: what is behind them is not looked at.
    pub fn read_up_to(path: &str, most: u64) -> Result<Self, InputError> {
        let name = called(path);
        let mut bytes = Vec::new();
        let done = if path == "-" {
            std::io::stdin().lock().take(most).read_to_end(&mut bytes)
        } else {
            // the length is asked for as much memory at once, where there is one
            std::fs::File::open(path).and_then(|file| {
                let length = file.metadata().map_or(0, |about| about.len()).min(most);
                bytes.try_reserve(usize::try_from(length).unwrap_or(0))?;
                file.take(most).read_to_end(&mut bytes)
            })
        };
        done.map_err(|error| whole(name, unreadable(&error)))?;
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self::new(name, text)),
            Err(error) => Err(not_text(name, error.as_bytes(), error.utf8_error().valid_up_to(), 0)),
        }
    }

    /// Tells it from other texts: its length and its sum.
    pub fn fingerprint(&self) -> String {
        let mut sum = crc32fast::Hasher::new();
        sum.update(self.text.as_bytes());
        fingerprint(self.text.len() as u64, &sum)
    }

    /// The line of the text, from zero, in which a byte stands.
    pub fn line_of(&self, byte: usize) -> usize {
        self.lines.partition_point(|&start| start <= byte).saturating_sub(1)
    }

    /// The number of that line in the whole text, from one.
    pub fn number(&self, byte: usize) -> usize {
        self.before + self.line_of(byte) + 1
    }

    /// Line `line` of the text, from zero, without its end.
    pub fn line(&self, line: usize) -> &str {
        let start = self.lines.get(line).copied().unwrap_or(self.text.len());
        let end = self.lines.get(line + 1).copied().unwrap_or(self.text.len());
        self.text.get(start..end).unwrap_or("").trim_end_matches(['\n', '\r'])
    }

    /// The place of a span of bytes; of a span over several lines, what lies on the first.
    pub fn place(&self, span: Range<usize>) -> Place {
        let line = self.line_of(span.start.min(self.text.len()));
        let source = self.line(line);
        let start = span.start.saturating_sub(self.lines.get(line).copied().unwrap_or(0));
        let end = start + span.len();
        let (mut before, mut width) = (0, 0);
        for (at, _) in source.char_indices() {
            before += usize::from(at < start);
            width += usize::from(at >= start && at < end);
        }
        Place {
            line: self.before + line + 1,
            column: before + 1,
            width: width.max(1),
            source: source.to_string(),
        }
    }

    pub fn location(&self, span: Range<usize>) -> Location {
        Location { file: self.name.clone(), place: Some(self.place(span)) }
    }

    pub fn error(&self, span: Range<usize>, message: impl Into<String>) -> InputError {
        self.location(span).error(message)
    }

    /// An error about the file as a whole.
    pub fn whole(&self, message: impl Into<String>) -> InputError {
        whole(&self.name, message)
    }
}

/// The name of what a path stands for.
pub(crate) fn called(path: &str) -> &str {
    if path == "-" { "standard input" } else { path }
}

/// An error about a file as a whole.
pub(crate) fn whole(name: &str, message: impl Into<String>) -> InputError {
    Location { file: name.to_owned(), place: None }.error(message)
}

/// Tells a text from others: its length and its sum.
pub(crate) fn fingerprint(length: u64, sum: &crc32fast::Hasher) -> String {
    format!("{length} bytes, sum {:08x}", sum.clone().finalize())
}

/// The error of bytes that are no text but for the first `valid`, behind so many lines.
pub(crate) fn not_text(name: &str, bytes: &[u8], valid: usize, lines: usize) -> InputError {
    if bytes.starts_with(MAGIC) {
        let error = whole(name, "this is a Parquet file, which is read from its end");
        return error.with_help("name the file in place of `-`; a truth and a model are text");
    }
    let text = String::from_utf8_lossy(bytes).into_owned();
    let wrong = Source::stretch(name, text, lines).error(valid..valid + 1, "this is not UTF-8 text");
    wrong.with_help("save the file in the encoding UTF-8")
}

/// What is told of a file that cannot be read.
pub(crate) fn unreadable(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_string(),
        std::io::ErrorKind::PermissionDenied => "this file may not be read".to_string(),
        std::io::ErrorKind::IsADirectory => "this is a directory, not a file".to_string(),
        _ => format!("cannot be read: {error}"),
    }
}

#[cfg(test)]
mod tests {
    use super::Source;

    #[test]
    fn places_count_characters_not_bytes() {
        let source = Source::new("f", "a\r\nπ = x\n".into());
        let at = source.text.find('x').unwrap();
        let place = source.place(at..at + 1);
        assert_eq!((place.line, place.column, place.width), (2, 5, 1));
        assert_eq!(place.source, "π = x");
    }

    #[test]
    fn a_place_at_the_end_of_the_text_lies_on_its_last_line() {
        let source = Source::new("f", "abc".into());
        assert_eq!((source.place(3..9).line, source.place(3..9).column), (1, 4));
        assert_eq!(Source::new("f", String::new()).place(0..0).line, 1);
    }
}
