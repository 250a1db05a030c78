//! The files that a folder or a pattern stands for.

use std::path::{Path, PathBuf};

use crate::error::InputErrors;
use crate::findings::list;
use crate::source::{unreadable, whole};

/// What files end in until all of them are written: a folder with one was left by a run that was broken off.
pub(crate) const UNFINISHED: &str = ".unfinished";

/// The tables that `path` stands for, in the order of their names: those in a folder, by these endings, or all that a pattern such
/// as `fleet/part-*.parquet` matches. None for the name of a single file, or of what is none, such as `-`.
///
/// # Errors
/// A folder that cannot be read, or has no table; a pattern that is none, or matches no file.
pub fn list_files(path: &str, endings: &[&str]) -> Result<Option<Vec<PathBuf>>, InputErrors> {
    let place = Path::new(path);
    let mut found = if place.is_dir() {
        let entries = std::fs::read_dir(place).map_err(|error| whole(path, unreadable(&error)))?;
        let mut files = Vec::new();
        for entry in entries {
            let file = entry.map_err(|error| whole(path, unreadable(&error)))?.path();
            if file.to_string_lossy().ends_with(UNFINISHED) {
                let error = whole(path, "this folder is not whole: `givens partition` was broken off");
                return Err(error.with_help("remove the folder, and cut the tables again").into());
            }
            let ending = file.extension().map(|ending| ending.to_string_lossy().to_lowercase());
            if file.is_file() && ending.is_some_and(|ending| endings.contains(&ending.as_str())) {
                files.push(file);
            }
        }
        files
    } else if path.contains(['*', '?', '[']) && !place.exists() {
        let wrong = |error: &glob::PatternError| {
            whole(path, format!("this is no pattern of names: {error}"))
                .with_help("`*` stands for any characters")
        };
        glob::glob(path)
            .map_err(|error| wrong(&error))?
            .filter_map(Result::ok)
            .filter(|file| file.is_file())
            .collect()
    } else {
        return Ok(None);
    };
    found.sort();
    if found.is_empty() {
        let endings = list(endings.iter().copied());
        let what = if place.is_dir() {
            format!("there is no table in this folder: none ends in {endings}")
        } else {
            "no file has such a name".to_owned()
        };
        return Err(whole(path, what)
            .with_help("name a file, a folder of tables, or a pattern in quotation marks")
            .into());
    }
    Ok(Some(found))
}
