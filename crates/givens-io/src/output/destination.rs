//! A file that appears whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file in the making: `PATH.partial` until it is finished, then `PATH`.
#[derive(Debug)]
pub struct Destination {
    path: PathBuf,
    /// What `path` leads to.
    target: PathBuf,
    /// Where it is written before; none for a device.
    partial: Option<PathBuf>,
    file: Option<BufWriter<File>>,
}

/// Why a file could not be written.
#[derive(Debug)]
pub struct DestinationError {
    /// The file.
    pub path: PathBuf,
    /// What the system said.
    pub source: io::Error,
}

impl core::fmt::Display for DestinationError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "cannot write {}: {}", self.path.display(), self.source)?;
        match self.source.kind() {
            io::ErrorKind::NotFound => write!(f, "; make its folder first"),
            io::ErrorKind::PermissionDenied => write!(f, "; choose a folder that you may write to"),
            _ => Ok(()),
        }
    }
}

impl core::error::Error for DestinationError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.source)
    }
}

impl Destination {
    /// Opens `PATH.partial`. A device, such as a terminal, is written as it is; behind a link, the file it leads to.
    ///
    /// # Errors
    /// A path that cannot be written, or that is a folder.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, DestinationError> {
        let path = path.as_ref().to_owned();
        match Self::open(&path) {
            Ok((target, partial, file)) => {
                Ok(Self { path, target, partial, file: Some(BufWriter::new(file)) })
            }
            Err(source) => Err(DestinationError { path, source }),
        }
    }

    fn open(path: &Path) -> io::Result<(PathBuf, Option<PathBuf>, File)> {
        let found = path.metadata().ok();
        if found.as_ref().is_some_and(fs::Metadata::is_dir) {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
        }
        if found.as_ref().is_some_and(|found| !found.is_file()) {
            return Ok((path.to_owned(), None, OpenOptions::new().write(true).open(path)?));
        }
        let target = if found.is_some() { path.canonicalize()? } else { path.to_owned() };
        let mut partial = target.clone().into_os_string();
        partial.push(".partial");
        let partial = PathBuf::from(partial);
        let file = File::create(&partial)?;
        Ok((target, Some(partial), file))
    }

    /// The file as the user named it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Gives the finished file its name.
    ///
    /// # Errors
    /// A disk that is full, or a file that cannot be replaced; `PATH.partial` is left.
    pub fn finish(mut self) -> Result<(), DestinationError> {
        let Some(file) = self.file.take() else { return Ok(()) };
        let done = file.into_inner().map_err(io::IntoInnerError::into_error);
        let done = done.and_then(|file| match &self.partial {
            Some(partial) => file.sync_all().and_then(|()| fs::rename(partial, &self.target)),
            None => Ok(()),
        });
        done.map_err(|source| DestinationError { path: self.path.clone(), source })
    }
}

impl Write for Destination {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.as_mut().map_or(Ok(0), |file| file.write(bytes))
    }
    fn flush(&mut self) -> io::Result<()> {
        self.file.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Drop for Destination {
    /// A file that was not finished leaves nothing behind.
    fn drop(&mut self) {
        if let (Some(_), Some(partial)) = (self.file.take(), &self.partial) {
            let _ = fs::remove_file(partial);
        }
    }
}
