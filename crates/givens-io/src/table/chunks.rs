//! A table's text, a stretch of it at a time: each begins with a record, and holds at least one.

use crate::error::InputError;
use crate::source::{MARK, Source, fingerprint, not_text, unreadable, whole};
use std::io::Read;

/// Bytes of a stretch; more where a record is longer.
pub(super) const USUAL: usize = 4 << 20;

/// A text that is read as it is needed.
pub(super) struct Chunks<'r> {
    name: String,
    reader: &'r mut dyn Read,
    /// What was read and not used yet.
    bytes: Vec<u8>,
    at_end: bool,
    /// Whether any text was read: a byte order mark is no part of it.
    begun: bool,
    /// Lines before the stretch.
    lines: usize,
    size: usize,
    /// Length and sum of what was read.
    length: u64,
    sum: crc32fast::Hasher,
}

/// A stretch of a text.
pub(super) struct Chunk {
    pub source: Source,
    /// Nothing follows.
    pub is_last: bool,
}

impl<'r> Chunks<'r> {
    /// A text under a name, in stretches of some `size`.
    pub fn new(name: &str, reader: &'r mut dyn Read, size: usize) -> Self {
        Self {
            name: name.to_owned(),
            reader,
            bytes: Vec::new(),
            at_end: false,
            begun: false,
            lines: 0,
            size: size.max(MARK.len()),
            length: 0,
            sum: crc32fast::Hasher::new(),
        }
    }

    /// The next stretch.
    pub fn next(&mut self) -> Result<Chunk, InputError> {
        let mut size = self.size;
        loop {
            self.fill(size)?;
            let text = match core::str::from_utf8(&self.bytes) {
                Ok(text) => text,
                // a character may be cut in two
                Err(error) if error.error_len().is_none() && !self.at_end => {
                    let whole = self.bytes.get(..error.valid_up_to()).unwrap_or(&[]);
                    core::str::from_utf8(whole).unwrap_or("")
                }
                Err(error) => return Err(not_text(&self.name, &self.bytes, error.valid_up_to(), self.lines)),
            };
            if self.at_end || holds_record(text) {
                let rest = self.bytes.split_off(text.len());
                let text = String::from_utf8(core::mem::replace(&mut self.bytes, rest)).unwrap_or_default();
                let is_last = self.at_end && self.bytes.is_empty();
                return Ok(Chunk { source: Source::stretch(&self.name, text, self.lines), is_last });
            }
            size = size.saturating_mul(2);
        }
    }

    /// Of a stretch the bytes from `used` on belong to the next one, and the end of the line before: at the very beginning a
    /// byte order mark would be passed over.
    pub fn give_back(&mut self, chunk: Chunk, used: usize) {
        let ends =
            |at: &usize| chunk.source.text.as_bytes().get(*at).is_some_and(|b| matches!(b, b'\n' | b'\r'));
        let used = used.checked_sub(1).filter(ends).unwrap_or(used);
        // lines are counted up to where the next stretch begins
        self.lines += chunk.source.line_of(used);
        let mut text = chunk.source.text.into_bytes();
        let rest = text.split_off(used.min(text.len()));
        let behind = core::mem::replace(&mut self.bytes, rest);
        self.bytes.extend(behind);
    }

    /// Reads until there are so many bytes, or no more.
    fn fill(&mut self, size: usize) -> Result<(), InputError> {
        let wanted = size.saturating_sub(self.bytes.len());
        if wanted == 0 || self.at_end {
            return Ok(());
        }
        let mut before = self.bytes.len();
        let done = (&mut *self.reader).take(wanted as u64).read_to_end(&mut self.bytes);
        let read = done.map_err(|error| whole(&self.name, unreadable(&error)))?;
        self.at_end = read < wanted;
        if !core::mem::replace(&mut self.begun, true) && self.bytes.starts_with(MARK) {
            self.bytes.drain(..MARK.len());
            before = 0;
        }
        let new = self.bytes.get(before..).unwrap_or(&[]);
        self.length += new.len() as u64;
        self.sum.update(new);
        Ok(())
    }

    /// Tells the text from others, once it was read to its end.
    pub fn fingerprint(&self) -> String {
        fingerprint(self.length, &self.sum)
    }
}

/// Whether the first record ends before the text does.
fn holds_record(text: &str) -> bool {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
    let read = reader.read_record(&mut csv::StringRecord::new()).unwrap_or(false);
    read && reader.position().byte() < text.len() as u64
}
