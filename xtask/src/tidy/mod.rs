//! What the compiler does not check. Each check reads the [`Tree`] and answers with findings.

mod citations;
mod crates;
mod factors;
mod files;
mod length;
mod modules;
mod paths;
mod references;
mod registry;
mod unfinished;
mod unsafe_code;

use crate::finding::Finding;
use crate::say;
use crate::tree::Tree;
use std::path::Path;

/// What is wrong with the files, in one respect.
type Check = fn(&Tree) -> Vec<Finding>;

/// Every check, by name.
const CHECKS: &[(&str, Check)] = &[
    ("order of modules", modules::check),
    ("order of crates", crates::check),
    ("length of files", length::check),
    ("square-root files form no covariance", factors::check),
    ("nothing unfinished", unfinished::check),
    ("files and printing", files::check),
    ("unsafe", unsafe_code::check),
    ("citations", citations::check),
    ("registry and README", registry::check),
];

/// Runs all checks and tells what they found; whether nothing was.
pub fn run(root: &Path) -> bool {
    let tree = match Tree::read(root) {
        Ok(tree) => tree,
        Err(error) => {
            say(&format!("{}: {error}", root.display()));
            return false;
        }
    };
    let mut findings: Vec<Finding> = CHECKS.iter().flat_map(|(_, check)| check(&tree)).collect();
    findings.sort();
    findings.dedup();
    for finding in &findings {
        say(&finding.to_string());
    }
    let files = tree.files().count();
    let names: Vec<&str> = CHECKS.iter().map(|(name, _)| *name).collect();
    match findings.len() {
        0 => say(&format!("tidy: {files} files, nothing found ({})", names.join(", "))),
        1 => say("tidy: 1 finding"),
        n => say(&format!("tidy: {n} findings")),
    }
    findings.is_empty()
}
