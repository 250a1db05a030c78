//! The files of a run: none in two roles, and none written before all is checked.

use crate::checkpoint::Checkpoint;
use crate::message::Stop;
use crate::stdout;
use givens_io::{Destination, Written};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Refuses files that stand in two roles; each role is the word of the command line for it.
pub fn check(inputs: &[(&str, Option<&str>)], outputs: &[(&str, Option<&Path>)]) -> Result<(), Stop> {
    let inputs: Vec<(&str, &str)> = inputs.iter().filter_map(|&(role, path)| Some((role, path?))).collect();
    let outputs: Vec<(&str, &Path)> =
        outputs.iter().filter_map(|&(role, path)| Some((role, path?))).collect();
    let mut standard = inputs.iter().filter(|(_, path)| *path == "-").map(|(role, _)| *role);
    if let (Some(first), Some(second)) = (standard.next(), standard.next()) {
        let message = format!("{first} and {second} are both `-`, but there is one standard input");
        return Err(Stop::input(message).help("write one of them to a file"));
    }
    for (k, (role, path)) in outputs.iter().enumerate() {
        let Some(place) = place(path).filter(|_| !is_standard(path)) else { continue };
        // an output is PATH.partial until it is whole
        let mut partial = place.clone().into_os_string();
        partial.push(".partial");
        let partial = PathBuf::from(partial);
        let read = || inputs.iter().map(|&(role, path)| (role, Path::new(path)));
        let mut all = read().chain(outputs.iter().copied());
        if let Some((other, _)) = all.find(|(_, other)| self::place(other).as_ref() == Some(&partial)) {
            let message =
                format!("{role}: {} is written on the way, but it is the file of {other}", partial.display());
            return Err(Stop::input(message).help("choose another name"));
        }
        let mut others = read().chain(outputs[..k].iter().copied());
        if let Some((other, _)) = others.find(|(_, other)| self::place(other).as_ref() == Some(&place)) {
            let message = format!("{role} {}: this is the file of {other} too", path.display());
            return Err(Stop::input(message).help("choose another name"));
        }
    }
    Ok(())
}

/// Whether a path stands for standard output.
pub fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Where a file lies, or would lie; none for devices and what cannot lie anywhere.
fn place(path: &Path) -> Option<PathBuf> {
    if let Ok(found) = path.canonicalize() {
        return found.is_file().then_some(found);
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Some(folder.canonicalize().ok()?.join(path.file_name()?))
}

/// What data are written to.
pub trait Output: Write {
    /// Waits until all that was written is where it will stay.
    fn settle(&mut self) -> io::Result<Written>;
}

impl Output for Destination {
    fn settle(&mut self) -> io::Result<Written> {
        Self::settle(self)
    }
}

/// Where data go: to a file that appears whole, or to standard output.
pub enum Sink {
    Stdout,
    File(Destination),
}

impl Sink {
    /// Opens a file, or standard output for `-` and for none.
    pub fn open(path: Option<&Path>) -> Result<Self, Stop> {
        match path.filter(|path| !is_standard(path)) {
            None => Ok(Self::Stdout),
            Some(path) => match Destination::create(path) {
                Ok(file) => Ok(Self::File(file)),
                Err(error) => Err(Stop::input(error.to_string())),
            },
        }
    }

    /// Opens a file that other processes may be writing too.
    pub fn shared(path: &Path) -> Result<Self, Stop> {
        Destination::shared(path).map(Self::File).map_err(|error| Stop::input(error.to_string()))
    }

    /// Opens the file of one table, which among those of `several` is shared: two runs over the same files may be at work.
    pub fn among(path: Option<&Path>, several: bool) -> Result<Self, Stop> {
        path.filter(|_| several).map_or_else(|| Self::open(path), Self::shared)
    }

    /// Opens a file that another run may go on with, behind what one has left.
    pub fn resumed(path: &Path, left: Written) -> Result<Self, Stop> {
        Destination::resumed(path, left).map(Self::File).map_err(|error| {
            let stop = Stop::input(error.to_string());
            if left == Written::default() {
                return stop;
            }
            stop.help(format!(
                "remove {} and what it was made beside, and the run begins anew",
                Checkpoint::path(path).display()
            ))
        })
    }

    /// Writes the data, and gives the file its name.
    pub fn write(mut self, data: impl FnOnce(&mut dyn Output) -> io::Result<()>) -> Result<(), Stop> {
        self.fill(data)?;
        self.finish()
    }

    /// Writes the data.
    pub fn fill(&mut self, data: impl FnOnce(&mut dyn Output) -> io::Result<()>) -> Result<(), Stop> {
        match self {
            Self::Stdout => stdout::write(data),
            Self::File(file) => data(file)
                .map_err(|error| Stop::failed(format!("cannot write {}: {error}", file.path().display()))),
        }
    }

    /// Gives the file its name.
    pub fn finish(self) -> Result<(), Stop> {
        match self {
            Self::Stdout => Ok(()),
            Self::File(file) => file.finish().map_err(|error| Stop::failed(error.to_string())),
        }
    }
}
