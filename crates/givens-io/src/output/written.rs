//! What a run that was broken off has left of a file.

use super::place::locate;
use crate::journal::is_locked;
use crc32fast::Hasher;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// The first bytes of a file: how many, and their sum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Written {
    bytes: u64,
    sum: u32,
}

impl Written {
    pub(super) fn of(bytes: u64, sum: &Hasher) -> Self {
        Self { bytes, sum: sum.clone().finalize() }
    }

    pub(super) fn bytes(self) -> u64 {
        self.bytes
    }
}

/// Opens what a run has left, behind that: where it leads to, its own path, the file, and the sum so far.
pub(super) fn behind(path: &Path, left: Written) -> io::Result<(PathBuf, PathBuf, File, Hasher)> {
    let (target, partial) = locate(path, ".partial")?;
    let partial = partial.ok_or_else(|| io::Error::other("it is no file"))?;
    if left.bytes > 0 && !partial.exists() {
        // killed behind its last word: the output has its name already
        fs::rename(&target, &partial)
            .map_err(|_| io::Error::other(format!("{} is gone", partial.display())))?;
    }
    let file =
        OpenOptions::new().read(true).write(true).create(left.bytes == 0).truncate(false).open(&partial)?;
    if is_locked(&file) {
        return Err(io::Error::other("another run is writing it"));
    }
    let (mut sum, mut rest, mut block) = (Hasher::new(), left.bytes, vec![0; 1 << 16]);
    let mut reader = BufReader::new(&file);
    while rest > 0 {
        let length = reader.read(&mut block)?.min(usize::try_from(rest).unwrap_or(usize::MAX));
        if length == 0 {
            break;
        }
        sum.update(&block[..length]);
        rest -= length as u64;
    }
    if rest > 0 || Written::of(left.bytes, &sum) != left {
        let message = format!("{} is not what its checkpoint was made beside", partial.display());
        return Err(io::Error::other(message));
    }
    file.set_len(left.bytes)?;
    // where it is written
    (&file).seek(SeekFrom::Start(left.bytes))?;
    Ok((target, partial, file, sum))
}
