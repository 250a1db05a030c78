//! A table read from its first row to its last, of which a few are in memory: rows become tracks.

use std::collections::HashMap;
use std::io;
use std::sync::Arc;

use super::cells::Cells;
use super::check::{Check, Growing};
use super::chunks::Chunks;
use super::header::{self, Columns};
use super::row::{row, track_id};
use super::sheet::Sheet;
use super::spool::Spool;
use super::time::Time;
use super::{Ids, Refused, Tracks};
use crate::error::{InputError, InputErrors};
use crate::findings::{Findings, Found};
use crate::scheme::Scheme;
use crate::source::whole;

/// Rows of all tracks that are held in memory, some 200 bytes each; of a longer table they lie on a disk.
pub(super) const HELD: usize = 1 << 19;

/// Reads a table.
pub(super) fn tracks(
    mut chunks: Chunks,
    name: &str,
    scheme: &Scheme,
    how: How,
) -> Result<Tracks, InputErrors> {
    let (mut found, mut begun) = (Found::default(), None);
    loop {
        let chunk = chunks.next()?;
        let findings = Findings::after(found, &chunk.source);
        let (sheet, mut reading) = match begun {
            Some((names, reading)) => (Sheet::resume(&findings, names), reading),
            None => match open(&findings, scheme, how) {
                Some(begun) => begun,
                None => return findings.finish(None),
            },
        };
        let mut sheet = sheet.going_on(!chunk.is_last);
        while let Some(fields) = sheet.next_row() {
            reading.take(&findings, &fields).map_err(|error| whole(name, error.to_string()))?;
        }
        let (names, used) = sheet.into_rest();
        if chunk.is_last {
            return reading.end(findings, chunks.fingerprint());
        }
        begun = Some((names, reading));
        found = findings.found();
        chunks.give_back(chunk, used);
    }
}

/// Reads the header; what is wrong with it is found so.
pub(super) fn open<'f>(
    findings: &'f Findings<'f>,
    scheme: &Scheme,
    how: How,
) -> Option<(Sheet<'f>, Reading)> {
    let known = if how.measured { "time and the measures" } else { "time" };
    let sheet = Sheet::open(findings, known, |name| header::means(scheme, name))?;
    let measured = how.measured || header::names_measures(&sheet, scheme);
    let columns = header::columns(&sheet, scheme, measured)?;
    Some((sheet, Reading::new(scheme, columns, how)))
}

/// How a table is read.
#[derive(Clone, Copy, Debug)]
pub(super) struct How {
    /// Whether it must have columns of measures.
    pub measured: bool,
    /// Rows that are held in memory.
    pub held: usize,
    /// Whether a track with a wrong row is left out alone, in place of the whole table.
    pub apart: bool,
    /// Whether columns of words may hold numbers, as those do that `givens partition` has left as they were written.
    pub in_words: bool,
}

impl Default for How {
    fn default() -> Self {
        Self { measured: true, held: HELD, apart: false, in_words: true }
    }
}

/// A table of which a part was read.
pub(super) struct Reading {
    scheme: Scheme,
    columns: Columns,
    /// In the order in which they are first named; none of a track that is refused.
    tracks: Vec<Option<Growing>>,
    known: HashMap<String, usize>,
    /// The kind of the times.
    kind: Option<Time>,
    /// Rows so far, those that were wrong among them.
    rows: usize,
    /// What names of tracks are.
    pub ids: Ids,
    /// Whether times are dates where no row has told their kind.
    pub dates: bool,
    ranges: Vec<Option<[f64; 2]>>,
    /// Rows that were not written to the disk.
    held: usize,
    how: How,
    refused: Vec<Refused>,
    spool: Option<Arc<Spool>>,
}

impl Reading {
    fn new(scheme: &Scheme, columns: Columns, how: How) -> Self {
        let ranges = vec![None; columns.measures.len()];
        Self {
            scheme: scheme.clone(),
            columns,
            tracks: Vec::new(),
            known: HashMap::new(),
            kind: None,
            rows: 0,
            ids: Ids::Words,
            dates: scheme.epoch.is_some(),
            ranges,
            held: 0,
            how,
            refused: Vec::new(),
            spool: None,
        }
    }

    /// What the columns mean.
    pub fn columns(&self) -> &Columns {
        &self.columns
    }

    /// Takes in a row; what is wrong with it is found so, or, where tracks are read apart, ends its track.
    pub fn take(&mut self, findings: &Findings, fields: &impl Cells) -> io::Result<()> {
        if !self.how.apart {
            return self.row(findings, fields);
        }
        let own = Findings::new(findings.source);
        self.row(&own, fields)?;
        if let Err(InputErrors { errors, .. }) = own.finish(Some(())) {
            let message = errors.into_iter().next().map_or_else(String::new, InputError::brief);
            self.refuse(fields, message);
        }
        Ok(())
    }

    /// Leaves the track of the row just read out.
    fn refuse(&mut self, fields: &impl Cells, message: String) {
        let name = self.columns.track.map(|column| fields.word(column));
        // a row of no track is no other's fault
        if name != Some("") {
            let next = self.tracks.len();
            let place = *self.known.entry(name.unwrap_or_default().to_owned()).or_insert(next);
            if place == next {
                self.tracks.push(None);
            } else if self.tracks.get_mut(place).is_none_or(|track| track.take().is_none()) {
                // of a track that was refused before
                return;
            }
        }
        let id = name.filter(|name| !name.is_empty()).map(str::to_owned);
        self.refused.push(Refused { id, row: self.rows - 1, message });
    }

    fn row(&mut self, findings: &Findings, fields: &impl Cells) -> io::Result<()> {
        let Self { scheme, columns, .. } = self;
        let raw = row(findings, fields, columns, scheme, self.kind, self.rows);
        self.rows += 1;
        let track = match columns.track {
            Some(column) => track_id(findings, fields, column),
            None => Some(""),
        };
        let (Some(raw), Some(id)) = (raw, track) else { return Ok(()) };
        self.kind = self.kind.or(Some(raw.time));
        for (range, &z) in self.ranges.iter_mut().zip(&raw.row.z) {
            if !z.is_nan() {
                let [least, most] = range.unwrap_or([z, z]);
                *range = Some([least.min(z), most.max(z)]);
            }
        }
        let check = Check { findings, scheme, column: columns.time, cells: fields };
        if let Some(&track) = self.known.get(id) {
            if let Some(Some(track)) = self.tracks.get_mut(track) {
                track.push(&check, raw);
            }
        } else {
            self.known.insert(id.to_owned(), self.tracks.len());
            let id = columns.track.map(|_| id.to_owned());
            self.tracks.push(Growing::begin(&check, id, raw));
        }
        self.held += 1;
        if self.held >= self.how.held { self.spill() } else { Ok(()) }
    }

    /// Writes what is held to a disk.
    fn spill(&mut self) -> io::Result<()> {
        self.held = 0;
        let spool = match &self.spool {
            Some(spool) => Arc::clone(spool),
            None => Arc::clone(self.spool.insert(Arc::new(Spool::new()?))),
        };
        self.tracks.iter_mut().flatten().try_for_each(|growing| growing.track.rows.spill(&spool))
    }

    /// The tracks, if nothing was found wrong.
    pub fn end(self, findings: Findings, fingerprint: String) -> Result<Tracks, InputErrors> {
        if self.rows == 0 && !self.how.apart && findings.none() {
            let error = findings.source.whole("the table has a header but no rows");
            findings.push(error.with_help("each row below the header is one measurement"));
        }
        let tracks = self.finish(fingerprint);
        findings.finish(tracks)
    }

    fn finish(self, fingerprint: String) -> Option<Tracks> {
        let mut tracks = Vec::with_capacity(self.tracks.len());
        for growing in self.tracks {
            match growing {
                Some(growing) => tracks.push(growing.track),
                None if self.how.apart => {}
                None => return None,
            }
        }
        let (scheme, refused) = (self.scheme, self.refused);
        let (has_track_id, has_sensor) = (self.columns.track.is_some(), self.columns.sensor.is_some());
        let (ignored, ranges) = (self.columns.ignored, self.ranges);
        let ids = self.ids;
        let dated = self.kind.map_or(self.dates, |time| matches!(time, Time::Calendar(_)));
        Some(Tracks {
            scheme,
            tracks,
            refused,
            ignored,
            has_track_id,
            ids,
            dated,
            has_sensor,
            ranges,
            fingerprint,
        })
    }
}
