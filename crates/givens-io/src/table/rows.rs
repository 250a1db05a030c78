//! The rows of a track, held in memory or lying on a disk.

use super::Row;
use super::spool::Spool;
use core::ops::Range;
use std::borrow::Cow;
use std::io;
use std::sync::Arc;

/// Rows that lie together on the disk: what is read for one of them.
const TOGETHER: usize = 4096;

/// The rows of a track in order of time. Those of a long table lie in a temporary file, which has no name and is gone with the
/// process; only the newest are held.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    /// What lies on the disk, before the rows that are held.
    blocks: Vec<Block>,
    spool: Option<Arc<Spool>>,
    held: Vec<Row>,
    first: Option<Row>,
}

#[derive(Clone, Debug)]
struct Block {
    rows: Range<usize>,
    bytes: Range<u64>,
}

impl From<Vec<Row>> for Rows {
    fn from(held: Vec<Row>) -> Self {
        Self { first: held.first().cloned(), held, ..Self::default() }
    }
}

impl Rows {
    /// Adds a row behind the others.
    pub fn push(&mut self, row: Row) {
        if self.first.is_none() {
            self.first = Some(row.clone());
        }
        self.held.push(row);
    }

    /// Writes all but the last of the rows that are held to a disk.
    pub(super) fn spill(&mut self, spool: &Arc<Spool>) -> io::Result<()> {
        let Some(last) = self.held.pop() else { return Ok(()) };
        let held = core::mem::replace(&mut self.held, vec![last]);
        for rows in held.chunks(TOGETHER) {
            let first = self.spooled();
            self.blocks.push(Block { rows: first..first + rows.len(), bytes: spool.write(rows)? });
        }
        self.spool = Some(Arc::clone(spool));
        Ok(())
    }

    /// How many lie on the disk.
    fn spooled(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.rows.end)
    }

    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.spooled() + self.held.len()
    }

    /// No rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.first.is_none()
    }

    /// The first row.
    #[must_use]
    pub fn first(&self) -> Option<&Row> {
        self.first.as_ref()
    }

    /// The last row.
    #[must_use]
    pub fn last(&self) -> Option<&Row> {
        self.held.last()
    }

    /// These rows, as far as there are so many.
    ///
    /// # Errors
    /// A temporary file that cannot be read.
    pub fn read(&self, rows: Range<usize>) -> io::Result<Cow<'_, [Row]>> {
        let (spooled, end) = (self.spooled(), rows.end.min(self.len()));
        let held = |from: usize| self.held.get(from - spooled..end - spooled).unwrap_or(&[]);
        if rows.start >= end {
            return Ok(Cow::Borrowed(&[]));
        }
        let Some(spool) = self.spool.as_ref().filter(|_| rows.start < spooled) else {
            return Ok(Cow::Borrowed(held(rows.start)));
        };
        let mut read = Vec::with_capacity(end - rows.start);
        let from = self.blocks.partition_point(|block| block.rows.end <= rows.start);
        for block in self.blocks.iter().skip(from).take_while(|block| block.rows.start < end) {
            let (skip, last) = (rows.start.saturating_sub(block.rows.start), end.min(block.rows.end));
            let those = spool.read(block.bytes.clone())?;
            read.extend(those.into_iter().take(last - block.rows.start).skip(skip));
        }
        if end > spooled {
            read.extend_from_slice(held(spooled));
        }
        Ok(Cow::Owned(read))
    }

    /// Row `k`, if there is one.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn row(&self, k: usize) -> io::Result<Option<Row>> {
        Ok(self.read(k..k + 1)?.first().cloned())
    }

    /// All rows, of which a few are in memory at once.
    pub fn iter(&self) -> impl Iterator<Item = io::Result<Cow<'_, Row>>> {
        let spool = self.spool.as_deref();
        let spooled = self.blocks.iter().zip(spool.into_iter().cycle()).flat_map(|(block, spool)| {
            let (rows, error) = match spool.read(block.bytes.clone()) {
                Ok(rows) => (rows, None),
                Err(error) => (Vec::new(), Some(Err(error))),
            };
            rows.into_iter().map(|row| Ok(Cow::Owned(row))).chain(error)
        });
        spooled.chain(self.held.iter().map(|row| Ok(Cow::Borrowed(row))))
    }

    /// How many rows stand before time `t`.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn before(&self, t: f64) -> io::Result<usize> {
        let (mut from, mut to) = (0, self.len());
        while from < to {
            let middle = from.midpoint(to);
            match self.row(middle)? {
                Some(row) if row.time < t => from = middle + 1,
                _ => to = middle,
            }
        }
        Ok(from)
    }
}
