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
use super::{Track, Tracks};
use crate::error::InputErrors;
use crate::findings::{Findings, Found};
use crate::model_file::Model;
use crate::source::whole;

/// Rows of all tracks that are held in memory, some 200 bytes each; of a longer table they lie on a disk.
pub(super) const HELD: usize = 1 << 19;

/// Reads a table, holding up to so many of its rows in memory.
pub(super) fn tracks(
    mut chunks: Chunks,
    name: &str,
    model: &Model,
    measured: bool,
    held: usize,
) -> Result<Tracks, InputErrors> {
    let (mut found, mut begun) = (Found::default(), None);
    loop {
        let chunk = chunks.next()?;
        let findings = Findings::after(found, &chunk.source);
        let (sheet, mut reading) = match begun {
            Some((names, reading)) => (Sheet::resume(&findings, names), reading),
            None => match open(&findings, model, measured, held) {
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
pub(super) fn open<'f, 'm>(
    findings: &'f Findings<'f>,
    model: &'m Model,
    measured: bool,
    held: usize,
) -> Option<(Sheet<'f>, Reading<'m>)> {
    let known = if measured { "time and the measures" } else { "time" };
    let sheet = Sheet::open(findings, known)?;
    let measured = measured || header::names_measures(&sheet, model);
    let columns = header::columns(&sheet, model, measured)?;
    Some((sheet, Reading::new(model, columns, held)))
}

/// A table of which a part was read.
pub(super) struct Reading<'m> {
    model: &'m Model,
    columns: Columns,
    /// In the order in which they are first named; none of a track whose times are not those of the model.
    tracks: Vec<Option<Growing>>,
    known: HashMap<String, usize>,
    /// The kind of the times.
    kind: Option<Time>,
    /// Rows so far, those that were wrong among them.
    rows: usize,
    /// Whether names of tracks are whole numbers.
    pub whole_ids: bool,
    ranges: Vec<Option<[f64; 2]>>,
    /// Rows that were not written to the disk, and how many may be.
    held: (usize, usize),
    spool: Option<Arc<Spool>>,
}

impl<'m> Reading<'m> {
    fn new(model: &'m Model, columns: Columns, held: usize) -> Self {
        let ranges = vec![None; columns.measures.len()];
        Self {
            model,
            columns,
            tracks: Vec::new(),
            known: HashMap::new(),
            kind: None,
            rows: 0,
            whole_ids: false,
            ranges,
            held: (0, held),
            spool: None,
        }
    }

    /// What the columns mean.
    pub fn columns(&self) -> &Columns {
        &self.columns
    }

    /// Takes in a row; what is wrong with it is found so.
    pub fn take(&mut self, findings: &Findings, fields: &impl Cells) -> io::Result<()> {
        let Self { model, columns, .. } = self;
        let raw = row(findings, fields, columns, model, self.kind, self.rows);
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
        let check = Check { findings, model, column: columns.time, cells: fields };
        if let Some(&track) = self.known.get(id) {
            if let Some(Some(track)) = self.tracks.get_mut(track) {
                track.push(&check, raw);
            }
        } else {
            self.known.insert(id.to_owned(), self.tracks.len());
            let id = columns.track.map(|_| id.to_owned());
            self.tracks.push(Growing::begin(&check, id, raw));
        }
        self.held.0 += 1;
        if self.held.0 >= self.held.1 { self.spill() } else { Ok(()) }
    }

    /// Writes what is held to a disk.
    fn spill(&mut self) -> io::Result<()> {
        self.held.0 = 0;
        let spool = match &self.spool {
            Some(spool) => Arc::clone(spool),
            None => Arc::clone(self.spool.insert(Arc::new(Spool::new()?))),
        };
        self.tracks.iter_mut().flatten().try_for_each(|growing| growing.track.rows.spill(&spool))
    }

    /// The tracks, if nothing was found wrong.
    pub fn end(self, findings: Findings, fingerprint: String) -> Result<Tracks, InputErrors> {
        if self.rows == 0 && findings.none() {
            let error = findings.source.whole("the table has a header but no rows");
            findings.push(error.with_help("each row below the header is one measurement"));
        }
        let tracks = self.finish(fingerprint);
        findings.finish(tracks)
    }

    fn finish(self, fingerprint: String) -> Option<Tracks> {
        let tracks: Vec<Track> =
            self.tracks.into_iter().map(|growing| Some(growing?.track)).collect::<Option<_>>()?;
        let (has_track_id, has_sensor) = (self.columns.track.is_some(), self.columns.sensor.is_some());
        let (ignored, ranges) = (self.columns.ignored, self.ranges);
        let whole_ids = self.whole_ids;
        Some(Tracks { tracks, ignored, has_track_id, whole_ids, has_sensor, ranges, fingerprint })
    }
}
