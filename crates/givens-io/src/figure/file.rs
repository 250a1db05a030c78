//! Figures to files.

use core::fmt;
use std::path::{Path, PathBuf};
use std::{fs, io};

use super::plot::Figure;
use super::{png, svg};

/// Why a figure could not be written.
#[derive(Debug)]
pub enum FigureError {
    /// The name of the file says neither SVG nor PNG.
    Format {
        /// As given.
        path: PathBuf,
    },
    /// The picture could not be held in memory or encoded.
    Encode,
    /// The file system refused.
    Write {
        /// As given.
        path: PathBuf,
        /// What it said.
        source: io::Error,
    },
}

impl fmt::Display for FigureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Format { path } => {
                write!(f, "cannot tell the format of the figure {}: ", path.display())?;
                match path.extension() {
                    Some(found) => write!(f, "“.{}” is none; ", found.display())?,
                    None => write!(f, "its name has no extension; ")?,
                }
                write!(f, "name it with .svg or .png")
            }
            Self::Encode => {
                write!(f, "the figure is too large to encode as PNG; make it smaller, or write it as .svg")
            }
            Self::Write { path, source } => {
                write!(f, "cannot write the figure {}: {source}; ", path.display())?;
                match source.kind() {
                    io::ErrorKind::NotFound => write!(f, "make its folder first"),
                    io::ErrorKind::PermissionDenied => write!(f, "choose a folder that you may write to"),
                    _ => write!(f, "choose another place"),
                }
            }
        }
    }
}

impl core::error::Error for FigureError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Write { source, .. } => Some(source),
            _ => None,
        }
    }
}

/// Writes the figure to `path`, as SVG or PNG by its extension. The file appears whole or not at all: it
/// is written beside its place, as `PATH.partial`, and renamed.
///
/// # Errors
///
/// [`FigureError`], which says what to do: an extension that is neither `.svg` nor `.png`, a picture too
/// large for PNG, or a path that cannot be written.
pub fn write(path: impl AsRef<Path>, figure: &Figure) -> Result<(), FigureError> {
    let path = path.as_ref();
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let bytes = match extension.as_deref() {
        Some("svg") => svg(figure).into_bytes(),
        Some("png") => png(figure)?,
        _ => return Err(FigureError::Format { path: path.to_owned() }),
    };
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let written = fs::write(&partial, bytes).and_then(|()| fs::rename(&partial, path));
    written.map_err(|source| {
        // Nothing half-written stays; if it cannot be removed, the first error is the one to tell.
        let _ = fs::remove_file(&partial);
        FigureError::Write { path: path.to_owned(), source }
    })
}
