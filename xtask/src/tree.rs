//! The files that checks read, in memory.

use crate::rust_text::RustText;
use std::path::Path;

/// One file of the repository.
#[derive(Clone, Debug)]
pub struct File {
    /// Path from the root, with `/` between its parts.
    pub path: String,
    pub text: String,
    /// Taken apart, if it is Rust.
    pub rust: RustText,
}

impl File {
    fn new(path: &str, text: String) -> Self {
        let mut file = Self { path: path.to_owned(), text, rust: RustText::default() };
        if file.ending() == "rs" {
            file.rust = RustText::of(&file.text);
        }
        file
    }

    /// What follows the last dot of its name.
    pub fn ending(&self) -> &str {
        ending(&self.path)
    }

    /// The line of byte `at`, from one.
    pub fn line(&self, at: usize) -> usize {
        1 + self.text.as_bytes().iter().take(at).filter(|&&byte| byte == b'\n').count()
    }
}

fn ending(path: &str) -> &str {
    path.rsplit_once('.').map_or("", |(_, ending)| ending)
}

/// The text files of the repository.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    files: Vec<File>,
}

/// Folders that hold what the project wrote; the others are built or borrowed.
const FOLDERS: &[&str] = &["benchmarks", "crates", "docs", "examples", "tests", "xtask"];
/// What checks read.
const ENDINGS: &[&str] = &["rs", "md", "toml"];

impl Tree {
    /// Reads the repository at `root`.
    ///
    /// # Errors
    /// A folder or file that cannot be read.
    pub fn read(root: &Path) -> std::io::Result<Self> {
        let mut tree = Self::default();
        for entry in std::fs::read_dir(root)? {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            let kind = entry.file_type()?;
            if kind.is_file() {
                tree.take(&entry.path(), &name)?;
            } else if kind.is_dir() && FOLDERS.contains(&name.as_str()) {
                tree.walk(&entry.path(), &name)?;
            }
        }
        tree.files.sort_by(|a, b| a.path.cmp(&b.path));
        Ok(tree)
    }

    fn walk(&mut self, folder: &Path, path: &str) -> std::io::Result<()> {
        for entry in std::fs::read_dir(folder)? {
            let entry = entry?;
            let path = format!("{path}/{}", entry.file_name().to_string_lossy());
            let kind = entry.file_type()?;
            if kind.is_dir() && !path.ends_with("/target") {
                self.walk(&entry.path(), &path)?;
            } else if kind.is_file() {
                self.take(&entry.path(), &path)?;
            }
        }
        Ok(())
    }

    fn take(&mut self, file: &Path, path: &str) -> std::io::Result<()> {
        if ENDINGS.contains(&ending(path)) {
            self.files.push(File::new(path, std::fs::read_to_string(file)?));
        }
        Ok(())
    }

    pub fn files(&self) -> impl Iterator<Item = &File> {
        self.files.iter()
    }

    /// The Rust files under a folder (`""`: all).
    pub fn rust<'t>(&'t self, under: &'t str) -> impl Iterator<Item = &'t File> {
        self.files.iter().filter(move |file| file.path.starts_with(under) && file.ending() == "rs")
    }

    pub fn get(&self, path: &str) -> Option<&File> {
        self.files.iter().find(|file| file.path == path)
    }

    /// A repository of these files, for tests.
    #[cfg(test)]
    pub fn of(files: &[(&str, &str)]) -> Self {
        Self { files: files.iter().map(|(path, text)| File::new(path, (*text).to_owned())).collect() }
    }
}
