//! A file to which entries are appended while a long run works, each of them whole or not at all.
//!
//! A line names the format. Then the entries, each behind its length and two sums, one of the length and one of the entry. What
//! a run that was killed was about to write is cut off; anything else that is not as it was written is refused.

use crate::output::settle_name;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The first line: what the file is, and the version of its format.
const TITLE: &[u8] = b"givens checkpoint 1\n";
/// What every version begins with.
const KIND: &[u8] = b"givens checkpoint ";
/// The length of an entry, its sum, and that of the entry.
const HEAD: usize = 16;

/// What a run is of: a name and a value for everything on which its numbers depend.
pub type Identity = Vec<(String, String)>;

/// A journal that is open.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: BufWriter<File>,
}

/// Why a journal could not be opened, and what to do.
#[derive(Debug)]
pub struct JournalError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: String,
}

impl core::fmt::Display for JournalError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.message)
    }
}

impl core::error::Error for JournalError {}

impl Journal {
    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Opens the journal of a run, and reads the entries of one that was broken off; begins it if there is none.
    ///
    /// # Errors
    /// A file that cannot be read or written, that is no journal or one of another version, that is damaged, or of another run.
    pub fn open<T: DeserializeOwned>(
        path: &Path,
        identity: &Identity,
    ) -> Result<(Self, Vec<T>), JournalError> {
        let anew = "remove it, and the run begins anew";
        let wrong = |message: &str, help: &str| JournalError {
            path: path.to_owned(),
            message: message.to_owned(),
            help: help.to_owned(),
        };
        let told = |error: io::Error| {
            if path.is_dir() {
                return wrong("this is a folder", "move it away, or name another output");
            }
            wrong(&format!("cannot be opened: {error}"), "choose a folder that you may write to")
        };
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(told)?;
        if is_locked(&file) {
            return Err(wrong(
                "another run is at work with it",
                "wait until it is done, or name another output",
            ));
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(told)?;
        let Some(rest) = bytes.strip_prefix(TITLE) else {
            if TITLE.starts_with(&bytes) {
                let journal = Self { path: path.to_owned(), file: BufWriter::new(file) };
                return journal.begin(identity).map_err(told);
            }
            let message = match bytes.strip_prefix(KIND) {
                Some(_) => "this is a checkpoint of another version of givens",
                None => "this is no checkpoint",
            };
            return Err(wrong(message, "move it away, or name another output"));
        };
        let damaged = |k: usize| wrong(&format!("entry {} of the checkpoint is damaged", k + 1), anew);
        let (mut entries, mut begun, mut whole) = (Vec::new(), false, TITLE.len());
        for (k, entry) in (Entries { rest }).enumerate() {
            let entry = entry.ok_or_else(|| damaged(k))?;
            whole += HEAD + entry.len();
            if k > 0 {
                entries.push(postcard::from_bytes(entry).map_err(|_| damaged(k))?);
                continue;
            }
            begun = true;
            let found: Identity = postcard::from_bytes(entry).map_err(|_| damaged(k))?;
            if found != *identity {
                let other = found.iter().find(|pair| !identity.contains(pair)).or_else(|| identity.last());
                let name = other.map_or("parameters", |(name, _)| name.as_str());
                let message = format!("this is the checkpoint of another run: its {name} differs");
                let help = "go on with what it was begun with, or remove it, and the run begins anew";
                return Err(wrong(&message, help));
            }
        }
        file.set_len(whole as u64).and_then(|()| file.seek(SeekFrom::End(0))).map_err(told)?;
        let journal = Self { path: path.to_owned(), file: BufWriter::new(file) };
        if begun { Ok((journal, entries)) } else { journal.begin(identity).map_err(told) }
    }

    /// Writes title and identity, from the start of the file.
    fn begin<T>(mut self, identity: &Identity) -> io::Result<(Self, Vec<T>)> {
        self.file.get_ref().set_len(0)?;
        self.file.rewind()?;
        self.file.write_all(TITLE)?;
        self.append(identity)?;
        Ok((self, Vec::new()))
    }

    /// Adds an entry, which is safe when [`settle`](Self::settle) has returned.
    ///
    /// # Errors
    /// What the system says.
    pub fn append<T: Serialize>(&mut self, entry: &T) -> io::Result<()> {
        let bytes = postcard::to_allocvec(entry).map_err(io::Error::other)?;
        let length = (bytes.len() as u64).to_le_bytes();
        for part in [&length[..], &sum(&length), &sum(&bytes), &bytes] {
            self.file.write_all(part)?;
        }
        Ok(())
    }

    /// Puts one entry in the place of all. At every moment the file is whole, with the old ones or with this.
    ///
    /// # Errors
    /// What the system says.
    pub fn replace<T: Serialize>(&mut self, identity: &Identity, entry: &T) -> io::Result<()> {
        let path = Self::next(&self.path);
        let file = OpenOptions::new().write(true).create(true).truncate(true).open(&path)?;
        let fresh = Self { path: path.clone(), file: BufWriter::new(file) };
        let (mut fresh, _) = fresh.begin::<T>(identity)?;
        fresh.append(entry)?;
        fresh.settle()?;
        std::fs::rename(&path, &self.path)?;
        settle_name(&self.path);
        self.file = fresh.file;
        Ok(())
    }

    /// Waits until all entries are on the disk.
    ///
    /// # Errors
    /// What the system says.
    pub fn settle(&mut self) -> io::Result<()> {
        self.file.flush()?;
        self.file.get_ref().sync_data()
    }

    /// Where an entry is written that is to take the place of all.
    pub fn next(path: &Path) -> PathBuf {
        let mut path = path.to_owned().into_os_string();
        path.push(".new");
        PathBuf::from(path)
    }

    /// Removes the file: the run is done.
    ///
    /// # Errors
    /// What the system says.
    pub fn remove(self) -> io::Result<()> {
        // one that was killed while it wrote there
        let _ = std::fs::remove_file(Self::next(&self.path));
        std::fs::remove_file(&self.path)
    }
}

/// Whether another process has the file; from now on this one has it. Where files cannot be locked, nobody is kept out.
pub(crate) fn is_locked(file: &File) -> bool {
    matches!(file.try_lock(), Err(TryLockError::WouldBlock))
}

fn sum(bytes: &[u8]) -> [u8; 4] {
    crc32fast::hash(bytes).to_le_bytes()
}

/// The entries of a journal; nothing in place of one that is damaged. What was not finished ends them.
struct Entries<'b> {
    rest: &'b [u8],
}

impl<'b> Iterator for Entries<'b> {
    type Item = Option<&'b [u8]>;

    fn next(&mut self) -> Option<Self::Item> {
        let (head, rest) = self.rest.split_at_checked(HEAD)?;
        let (length, sums) = head.split_at(8);
        if sum(length) != sums[..4] {
            self.rest = &[];
            return Some(None);
        }
        let length = length.iter().rev().fold(0, |length, &byte| (length << 8) | usize::from(byte));
        let (entry, rest) = rest.split_at_checked(length)?;
        self.rest = rest;
        Some((sum(entry) == sums[4..]).then_some(entry))
    }
}

#[cfg(test)]
mod tests;
