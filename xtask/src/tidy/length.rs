//! No Rust file is longer than can be read at a sitting.

use crate::finding::Finding;
use crate::tree::Tree;

/// Lines of a Rust file, at most.
const LIMIT: usize = 300;

pub fn check(tree: &Tree) -> Vec<Finding> {
    let long =
        tree.rust("").map(|file| (file, file.text.lines().count())).filter(|(_, lines)| *lines > LIMIT);
    long.map(|(file, lines)| {
        let remedy = "split it: one idea to a file";
        Finding::new(&file.path, LIMIT + 1, format!("{lines} lines, more than {LIMIT}"), remedy)
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::{LIMIT, check};
    use crate::tree::Tree;

    #[test]
    fn one_line_too_many_is_found() {
        let (just, over) = ("\n".repeat(LIMIT), "\n".repeat(LIMIT + 1));
        let tree = Tree::of(&[("crates/a/src/just.rs", &just), ("crates/a/src/over.rs", &over)]);
        let found = check(&tree);
        assert_eq!(found.len(), 1);
        assert!(found[0].path.ends_with("over.rs"));
    }
}
