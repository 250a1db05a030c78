//! A file that appears whole or not at all.

use super::place::{locate, own, settle_name};
use super::written::{Written, behind};
use crc32fast::Hasher;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file in the making: `PATH.partial` from its first byte until it is finished, then `PATH`.
#[derive(Debug)]
pub struct Destination {
    path: PathBuf,
    /// What `path` leads to.
    target: PathBuf,
    /// Where it is written before; none for a device.
    partial: Option<PathBuf>,
    /// Open from the first byte on; a device from the beginning.
    file: Option<BufWriter<File>>,
    /// Whether what was written stays if it is not finished: then it is counted and summed.
    kept: Option<(u64, Hasher)>,
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

/// Makes a folder, and those that it lies in; one that is there is left as it is.
///
/// # Errors
/// What the system says.
pub fn make_folder(path: &Path) -> Result<(), DestinationError> {
    fs::create_dir_all(path).map_err(|source| DestinationError { path: path.to_owned(), source })
}

/// The text of a file that was written before; none if there is no such file, or no text in it.
pub fn read_back(path: &Path) -> Option<String> {
    fs::read_to_string(path).ok()
}

impl Destination {
    /// Makes sure that `PATH.partial` can be written, and leaves it away until there is something to write. A device, such
    /// as a terminal, is written as it is; behind a link, the file it leads to.
    ///
    /// # Errors
    /// A path that cannot be written, or that is a folder.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, DestinationError> {
        Self::under(path.as_ref(), ".partial")
    }

    /// The same for a file that other processes may be writing too: until it is finished it is `PATH.ID.partial`, ID that of
    /// this process. Each of them writes a whole file; the last one stays.
    ///
    /// # Errors
    /// A path that cannot be written, or that is a folder.
    pub fn shared(path: impl AsRef<Path>) -> Result<Self, DestinationError> {
        Self::under(path.as_ref(), &format!(".{}.partial", std::process::id()))
    }

    /// The same for a run that may be broken off and gone on with: `PATH.partial` stays if it is not finished, and is written
    /// behind what another run has left there.
    ///
    /// # Errors
    /// A path that cannot be written, or that is no file; a `PATH.partial` that does not begin with what was `left`.
    pub fn resumed(path: impl AsRef<Path>, left: Written) -> Result<Self, DestinationError> {
        let path = path.as_ref().to_owned();
        match behind(&path, left) {
            Ok((target, partial, file, sum)) => {
                let (partial, file) = (Some(partial), Some(BufWriter::new(file)));
                Ok(Self { path, target, partial, file, kept: Some((left.bytes(), sum)) })
            }
            Err(source) => Err(DestinationError { path, source }),
        }
    }

    fn under(path: &Path, ending: &str) -> Result<Self, DestinationError> {
        let path = path.to_owned();
        match Self::open(&path, ending) {
            Ok((target, partial, file)) => {
                Ok(Self { path, target, partial, file: file.map(BufWriter::new), kept: None })
            }
            Err(source) => Err(DestinationError { path, source }),
        }
    }

    fn open(path: &Path, ending: &str) -> io::Result<(PathBuf, Option<PathBuf>, Option<File>)> {
        let (target, partial) = locate(path, ending)?;
        let Some(partial) = partial else {
            return Ok((target, None, Some(OpenOptions::new().write(true).open(path)?)));
        };
        let file = own(&partial)?;
        // a run that is killed before it writes leaves nothing
        fs::remove_file(&partial)?;
        drop(file);
        Ok((target, Some(partial), None))
    }

    /// The file, opened when it is first asked for.
    fn opened(&mut self) -> io::Result<&mut BufWriter<File>> {
        let file = match (self.file.take(), &self.partial) {
            (Some(file), _) => file,
            (None, Some(partial)) => BufWriter::new(own(partial)?),
            (None, None) => return Err(io::Error::from(io::ErrorKind::NotFound)),
        };
        Ok(self.file.insert(file))
    }

    /// The file as the user named it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Waits until all that was written is on the disk, for [`resumed`](Self::resumed) to go on behind it.
    ///
    /// # Errors
    /// What the system says.
    pub fn settle(&mut self) -> io::Result<Written> {
        let file = self.opened()?;
        file.flush()?;
        file.get_ref().sync_data()?;
        Ok(self.kept.as_ref().map_or(Written::default(), |(bytes, sum)| Written::of(*bytes, sum)))
    }

    /// Gives the finished file its name.
    ///
    /// # Errors
    /// A disk that is full, or a file that cannot be replaced; `PATH.partial` is left.
    pub fn finish(mut self) -> Result<(), DestinationError> {
        let done = self.opened().map(|_| ());
        let file = done.and_then(|()| self.file.take().ok_or(io::ErrorKind::NotFound.into()));
        let done = file.and_then(|file| file.into_inner().map_err(io::IntoInnerError::into_error));
        let done = done.and_then(|file| match &self.partial {
            Some(partial) => {
                file.sync_all()?;
                fs::rename(partial, &self.target).map_err(|error| match error.kind() {
                    io::ErrorKind::NotFound => {
                        io::Error::other("another run has taken away what was written")
                    }
                    _ => error,
                })?;
                settle_name(&self.target);
                Ok(())
            }
            None => Ok(()),
        });
        done.map_err(|source| DestinationError { path: self.path.clone(), source })
    }
}

impl Write for Destination {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.opened()?.write(bytes)?;
        if let Some((count, sum)) = &mut self.kept {
            *count += written as u64;
            sum.update(&bytes[..written]);
        }
        Ok(written)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.file.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Drop for Destination {
    /// A file that was not finished leaves nothing behind.
    fn drop(&mut self) {
        if let (Some(_), Some(partial), None) = (self.file.take(), &self.partial, &self.kept) {
            let _ = fs::remove_file(partial);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Written;
    use super::Destination;
    use std::fs;
    use std::io::Write;

    #[test]
    fn nothing_lies_there_before_the_first_byte_nor_under_the_name_before_the_last() {
        let folder = std::env::temp_dir().join(format!("givens-destination-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (path, partial) = (folder.join("out.csv"), folder.join("out.csv.partial"));
        let mut file = Destination::create(&path).unwrap();
        assert!(!path.exists() && !partial.exists());
        file.write_all(b"x").unwrap();
        assert!(!path.exists() && partial.exists());
        file.finish().unwrap();
        assert!(path.exists() && !partial.exists());
        // an output without a byte is a file all the same, and one that is given up leaves what was there
        Destination::create(folder.join("empty.csv")).unwrap().finish().unwrap();
        assert_eq!(fs::read(folder.join("empty.csv")).unwrap(), b"");
        Destination::create(&path).unwrap().write_all(b"other").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"x");
        assert!(!partial.exists());
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_file_that_may_be_gone_on_with_stays() {
        let folder = std::env::temp_dir().join(format!("givens-resumed-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (path, partial) = (folder.join("out.csv"), folder.join("out.csv.partial"));
        let mut file = Destination::resumed(&path, Written::default()).unwrap();
        file.write_all(b"abc").unwrap();
        let left = file.settle().unwrap();
        file.write_all(b"de").unwrap();
        drop(file);
        assert_eq!(fs::read(&partial).unwrap(), b"abcde");
        let mut file = Destination::resumed(&path, left).unwrap();
        file.write_all(b"f").unwrap();
        let more = file.settle().unwrap();
        drop(file);
        let mut file = Destination::resumed(&path, more).unwrap();
        file.write_all(b"g").unwrap();
        file.finish().unwrap();
        assert_eq!((fs::read(&path).unwrap().as_slice(), partial.exists()), (&b"abcfg"[..], false));
        // named, and killed before its checkpoint was removed
        let mut file = Destination::resumed(&path, left).unwrap();
        assert!(!path.exists());
        file.write_all(b"fg").unwrap();
        let error = Destination::resumed(&path, left).unwrap_err().to_string();
        assert!(error.ends_with("another run is writing it"), "{error}");
        drop(file);
        fs::remove_file(&partial).unwrap();
        let error = Destination::resumed(&path, left).unwrap_err().to_string();
        assert!(error.ends_with("out.csv.partial is gone"), "{error}");
        for other in ["ab", "abd", ""] {
            fs::write(&partial, other).unwrap();
            let error = Destination::resumed(&path, left).unwrap_err().to_string();
            assert!(error.ends_with("out.csv.partial is not what its checkpoint was made beside"), "{error}");
            assert_eq!(fs::read(&partial).unwrap(), other.as_bytes());
        }
        let error = Destination::resumed("/dev/null", left).unwrap_err().to_string();
        assert!(error.ends_with("it is no file"), "{error}");
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_shared_file_is_made_under_a_name_of_this_process() {
        let folder = std::env::temp_dir().join(format!("givens-shared-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("out.csv");
        let (mut one, mut other) = (Destination::shared(&path).unwrap(), Destination::create(&path).unwrap());
        one.write_all(b"one").unwrap();
        other.write_all(b"other").unwrap();
        other.finish().unwrap();
        one.finish().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"one");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }
}
