//! Rows of a table that lie on a disk, because there are too many for memory.

use super::Row;
use core::ops::Range;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::sync::{Mutex, PoisonError};

/// A temporary file without a name: it is gone with the process, however that ends.
#[derive(Debug)]
pub(super) struct Spool(Mutex<File>);

impl Spool {
    /// An empty one, in the folder for temporary files.
    pub fn new() -> io::Result<Self> {
        tempfile::tempfile().map(|file| Self(Mutex::new(file))).map_err(|error| told(&error))
    }

    /// Writes rows behind the others, and says where.
    pub fn write(&self, rows: &[Row]) -> io::Result<Range<u64>> {
        let bytes = postcard::to_extend(rows, Vec::new()).map_err(io::Error::other)?;
        let mut file = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let start = file.seek(SeekFrom::End(0)).map_err(|error| told(&error))?;
        file.write_all(&bytes).map_err(|error| told(&error))?;
        Ok(start..start + bytes.len() as u64)
    }

    /// Reads the rows that were written there.
    pub fn read(&self, place: Range<u64>) -> io::Result<Vec<Row>> {
        let mut bytes = vec![0; usize::try_from(place.end - place.start).map_err(io::Error::other)?];
        {
            let mut file = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            file.seek(SeekFrom::Start(place.start)).map_err(|error| told(&error))?;
            file.read_exact(&mut bytes).map_err(|error| told(&error))?;
        }
        postcard::from_bytes(&bytes).map_err(io::Error::other)
    }
}

/// Says what the file is for, and what can be done.
fn told(error: &io::Error) -> io::Error {
    let folder = std::env::temp_dir();
    let message = format!(
        "the rows of a long table lie in the folder for temporary files, {}: {error} (set TMPDIR to one with room)",
        folder.display()
    );
    io::Error::new(error.kind(), message)
}
