//! A CSV text as a header and rows of fields, each with its place.

use core::ops::Range;

use crate::findings::{Findings, count};
use crate::source::Source;

/// A table whose header was read.
pub(super) struct Sheet<'a> {
    pub findings: &'a Findings<'a>,
    /// The column names, without the space around them.
    pub header: Vec<String>,
    /// The byte at which the header begins.
    start: usize,
    reader: csv::Reader<&'a [u8]>,
    record: csv::StringRecord,
    /// Whether another stretch of the table follows: a record that reaches the end of this one may go on there.
    goes_on: bool,
    /// The byte up to which rows were read.
    used: usize,
}

/// One row of a table.
pub(super) struct Fields<'s> {
    source: &'s Source,
    header: &'s [String],
    record: &'s csv::StringRecord,
    start: usize,
}

impl<'a> Sheet<'a> {
    /// Reads the header; an empty text is found wrong, and a name that stands twice if it is one that is `read`.
    pub fn open(findings: &'a Findings<'a>, columns: &str, read: impl Fn(&str) -> bool) -> Option<Self> {
        let source = findings.source;
        let mut reader = reader(source);
        let mut record = csv::StringRecord::new();
        if source.text.trim().is_empty() || !record_of(&mut reader, &mut record) {
            let help = format!("the first line names the columns: {columns}");
            findings.push(source.whole("the table is empty").with_help(help));
            return None;
        }
        let header: Vec<String> = record.iter().map(|name| name.trim().to_string()).collect();
        let start = start_of(source, &record);
        let used = reader.position().byte() as usize;
        let sheet = Self { findings, header, start, reader, record, goes_on: false, used };
        sheet.duplicates(read);
        Some(sheet)
    }

    /// Another stretch of a table, whose header was read before.
    pub fn resume(findings: &'a Findings<'a>, header: Vec<String>) -> Self {
        let reader = reader(findings.source);
        Self { findings, header, start: 0, reader, record: csv::StringRecord::new(), goes_on: false, used: 0 }
    }

    /// The same, if other stretches follow.
    pub fn going_on(self, goes_on: bool) -> Self {
        Self { goes_on, ..self }
    }

    /// The header, and the byte from which on nothing was read.
    pub fn into_rest(self) -> (Vec<String>, usize) {
        (self.header, self.used)
    }

    /// The place of a column's name.
    pub fn name_span(&self, column: usize) -> Range<usize> {
        field_span(&self.findings.source.text, self.start, column)
    }

    /// The place of the whole header.
    pub fn header_span(&self) -> Range<usize> {
        let line = self.findings.source.place(self.start..self.start).source;
        self.start..self.start + line.len()
    }

    /// The first column of this name.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|other| other == name)
    }

    fn duplicates(&self, read: impl Fn(&str) -> bool) {
        let mut seen = std::collections::HashMap::new();
        for (column, name) in self.header.iter().enumerate().filter(|(_, name)| read(name)) {
            if let Some(first) = seen.insert(name.as_str(), column) {
                let message =
                    format!("the column `{name}` stands twice: columns {} and {}", first + 1, column + 1);
                self.findings.wrong_help(&self.name_span(column), message, "rename or remove one of them");
            }
        }
    }

    /// The next row with as many fields as the header; others are found wrong and passed over.
    pub fn next_row(&mut self) -> Option<Fields<'_>> {
        loop {
            let is_read = record_of(&mut self.reader, &mut self.record);
            let end = self.reader.position().byte() as usize;
            if !is_read || self.goes_on && end >= self.findings.source.text.len() {
                return None;
            }
            self.used = end;
            let start = start_of(self.findings.source, &self.record);
            if self.record.len() == self.header.len() {
                break;
            }
            self.wrong_length(start);
        }
        let source = self.findings.source;
        let start = start_of(source, &self.record);
        Some(Fields { source, header: &self.header, record: &self.record, start })
    }

    fn wrong_length(&self, start: usize) {
        let message = format!(
            "the row has {}, the header {}",
            count(self.record.len(), "field"),
            count(self.header.len(), "column")
        );
        let quoted = self.record.iter().any(|field| field.contains('\n'));
        let help = if quoted {
            "a quotation mark that opens a field must also close it"
        } else if self.record.len() > self.header.len() {
            "numbers are written with a point, and a text with commas stands in quotation marks"
        } else {
            "leave a cell empty, but keep its comma"
        };
        let last = self.record.len().min(self.header.len() + 1).saturating_sub(1);
        self.findings.wrong_help(&field_span(&self.findings.source.text, start, last), message, help);
    }
}

fn reader(source: &Source) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(source.text.as_bytes())
}

/// Reads one record. The text is UTF-8 and rows may have any length, so nothing else can end it but its end.
fn record_of(reader: &mut csv::Reader<&[u8]>, record: &mut csv::StringRecord) -> bool {
    reader.read_record(record).unwrap_or(false)
}

/// The byte at which a record begins; the reader counts empty lines before it as its own.
fn start_of(source: &Source, record: &csv::StringRecord) -> usize {
    let from = record.position().map_or(0, |position| position.byte() as usize);
    let rest = source.text.as_bytes().get(from..).unwrap_or(&[]);
    from + rest.iter().take_while(|&&byte| byte == b'\n' || byte == b'\r').count()
}

/// The span of field `index` of the record that begins at `start`.
pub(super) fn field_span(text: &str, start: usize, index: usize) -> Range<usize> {
    let (mut field, mut begin, mut quoted, mut closed) = (0, start, false, None);
    let bytes = text.as_bytes().get(start..).unwrap_or(&[]);
    for (at, &byte) in bytes.iter().enumerate() {
        match byte {
            b'"' if quoted => (quoted, closed) = (false, Some(at + 1)),
            // a mark opens a field at its beginning only, or goes on with one in which it is doubled
            b'"' if start + at == begin || closed == Some(at) => quoted = true,
            b',' | b'\n' | b'\r' if !quoted => {
                if field == index || byte != b',' {
                    return begin..start + at;
                }
                field += 1;
                begin = start + at + 1;
            }
            _ => {}
        }
    }
    begin..text.len()
}

impl Fields<'_> {
    /// The text of a field, without the space around it; empty where there is none.
    pub fn text(&self, column: usize) -> &str {
        self.record.get(column).unwrap_or("").trim()
    }

    /// The line, from one.
    pub fn line(&self) -> usize {
        self.source.number(self.start)
    }

    /// The place of a field.
    pub fn span(&self, column: usize) -> Range<usize> {
        field_span(&self.source.text, self.start, column)
    }

    pub fn name(&self, column: usize) -> &str {
        self.header.get(column).map_or("", String::as_str)
    }

    /// A column in words: its name and its number.
    pub fn column(&self, column: usize) -> String {
        format!("`{}` (column {})", self.name(column), column + 1)
    }
}
