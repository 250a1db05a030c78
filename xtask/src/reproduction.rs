//! `docs/reproduction.md`: its head is written by hand, the tables below it are the index that `givens reproduce` wrote.

use crate::say;
use std::fs;
use std::path::Path;

/// Ends the head of the page.
const MARK: &str =
    "<!-- Below: the index that `givens reproduce` wrote, put here by `cargo xtask reproduction PAGES`. -->";

/// Puts the index of a folder of pages under the head; whether that could be done.
pub fn run(root: &Path, pages: &Path) -> bool {
    let (doc, index) = (root.join("docs/reproduction.md"), pages.join("index.md"));
    let read = |path: &Path| {
        fs::read_to_string(path)
            .map_err(|error| say(&format!("cannot read {}: {error}", path.display())))
            .ok()
    };
    let (Some(old), Some(index)) = (read(&doc), read(&index)) else { return false };
    let Some(new) = joined(&old, &index) else {
        say(&format!("{} has no line `{MARK}`, or the index no paper", doc.display()));
        return false;
    };
    fs::write(&doc, new).map_err(|error| say(&format!("cannot write {}: {error}", doc.display()))).is_ok()
}

/// The head of the one, then the papers of the other, its links to pages turned into names of experiments.
fn joined(old: &str, index: &str) -> Option<String> {
    let (head, _) = old.split_once(MARK)?;
    let papers = index.split_once("\n## ")?.1;
    let mut text = format!("{head}{MARK}\n\n## ");
    for line in papers.lines() {
        match linked(line) {
            Some((title, name)) => text += &["### ", title, " (`", name, "`)"].concat(),
            None => text += line,
        }
        text.push('\n');
    }
    Some(text)
}

/// Title and experiment of a heading `### [TITLE](KEY/NAME.md)`.
fn linked(line: &str) -> Option<(&str, &str)> {
    let (title, path) = line.strip_prefix("### [")?.rsplit_once("](")?;
    Some((title, path.strip_suffix(".md)")?.split_once('/')?.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_stays_and_the_tables_are_replaced() {
        let index = "# Five\n\nlegend\n\n## key\n\n### [Table [1]: x](key/table-1.md)\n\n| a |\n";
        let old = format!("# Head\n\n{MARK}\n\n## old\n");
        let new = joined(&old, index).unwrap();
        assert_eq!(new, format!("# Head\n\n{MARK}\n\n## key\n\n### Table [1]: x (`table-1`)\n\n| a |\n"));
        assert_eq!(joined(&new, index).unwrap(), new);
        assert!(joined("no mark", index).is_none());
    }
}
