//! A text with its name: spans of bytes become places.

use core::ops::Range;
use std::io::Read;

use crate::error::{InputError, Location, Place};

/// A text that was read, and the name under which errors speak of it.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub name: String,
    pub text: String,
    /// Where each line begins.
    lines: Vec<usize>,
}

impl Source {
    pub fn new(name: &str, mut text: String) -> Self {
        // A byte order mark is no part of the text.
        if text.starts_with('\u{feff}') {
            text.drain(..'\u{feff}'.len_utf8());
        }
        let lines = core::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Self { name: name.to_string(), text, lines }
    }

    /// Reads a file, or standard input for `-`.
    pub fn read(path: &str) -> Result<Self, InputError> {
        Self::read_up_to(path, u64::MAX)
    }

    /// The same, of at most so many bytes: what is behind them is not looked at.
    pub fn read_up_to(path: &str, most: u64) -> Result<Self, InputError> {
        let name = if path == "-" { "standard input" } else { path };
        let whole = Location { file: name.to_string(), place: None };
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
        done.map_err(|error| whole.error(unreadable(&error)))?;
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self::new(name, text)),
            Err(error) => {
                let valid = error.utf8_error().valid_up_to();
                let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
                let mut wrong = Self::new(name, text).error(valid..valid + 1, "this is not UTF-8 text");
                if error.as_bytes().starts_with(b"PAR1") {
                    wrong.place = None;
                    wrong.message = "this is a Parquet file, which this version does not read yet".into();
                    return Err(wrong.with_help("write it as CSV"));
                }
                Err(wrong.with_help("save the file in the encoding UTF-8"))
            }
        }
    }

    /// Tells it from other texts: its length and its sum.
    pub fn fingerprint(&self) -> String {
        format!("{} bytes, sum {:08x}", self.text.len(), crc32fast::hash(self.text.as_bytes()))
    }

    /// The line, from zero, in which a byte stands.
    pub fn line_of(&self, byte: usize) -> usize {
        self.lines.partition_point(|&start| start <= byte).saturating_sub(1)
    }

    /// Line `line`, from zero, without its end.
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
        Place { line: line + 1, column: before + 1, width: width.max(1), source: source.to_string() }
    }

    pub fn location(&self, span: Range<usize>) -> Location {
        Location { file: self.name.clone(), place: Some(self.place(span)) }
    }

    pub fn error(&self, span: Range<usize>, message: impl Into<String>) -> InputError {
        self.location(span).error(message)
    }

    /// An error about the file as a whole.
    pub fn whole(&self, message: impl Into<String>) -> InputError {
        Location { file: self.name.clone(), place: None }.error(message)
    }
}

fn unreadable(error: &std::io::Error) -> String {
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
