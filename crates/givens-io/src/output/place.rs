//! Where a file is written, and by whom.

use crate::journal::is_locked;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

/// Opens a file for this process alone, and empties it.
pub(super) fn own(path: &Path) -> io::Result<File> {
    let file = OpenOptions::new().write(true).create(true).truncate(false).open(path)?;
    if is_locked(&file) {
        return Err(io::Error::other("another run is writing it"));
    }
    file.set_len(0)?;
    Ok(file)
}

/// Waits until the name of a file is on the disk, where a folder can be waited for.
pub(crate) fn settle_name(path: &Path) {
    if cfg!(unix) {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        // what is written is right in any case; without it, a machine that loses its power may forget the name
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
    }
}

/// What a path leads to, and where it is written before; none for a device.
pub(super) fn locate(path: &Path, ending: &str) -> io::Result<(PathBuf, Option<PathBuf>)> {
    let found = path.metadata().ok();
    if found.as_ref().is_some_and(fs::Metadata::is_dir) {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
    }
    if found.as_ref().is_some_and(|found| !found.is_file()) {
        return Ok((path.to_owned(), None));
    }
    let target = if found.is_some() { path.canonicalize()? } else { path.to_owned() };
    let mut partial = target.clone().into_os_string();
    partial.push(ending);
    Ok((target, Some(PathBuf::from(partial))))
}
