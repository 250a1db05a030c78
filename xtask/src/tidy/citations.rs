//! What the code cites can be looked up: papers in docs/notation.md, equations in docs/algorithms.md.

use super::references::{Reference, references};
use crate::finding::Finding;
use crate::tree::{File, Tree};

pub const NOTATION: &str = "docs/notation.md";
pub const ALGORITHMS: &str = "docs/algorithms.md";

pub fn check(tree: &Tree) -> Vec<Finding> {
    let text = |path| tree.get(path).map_or("", |file: &File| file.text.as_str());
    let (notation, algorithms) = (text(NOTATION), text(ALGORITHMS));
    let mut findings = Vec::new();
    for (path, text) in [(NOTATION, notation), (ALGORITHMS, algorithms)] {
        if text.is_empty() {
            findings.push(Finding::new(path, 1, "the page is missing", "write it: citations resolve there"));
        }
    }
    for file in tree.files() {
        let texts: &[(&str, bool)] = match file.ending() {
            // the checks quote what they look for
            "rs" if !file.path.starts_with("xtask/") => {
                &[(&file.rust.comments, true), (&file.rust.strings, true)]
            }
            "md" if file.path != NOTATION => &[(&file.text, false)],
            _ => continue,
        };
        for (at, reference) in texts.iter().flat_map(|(text, authors)| references(text, *authors)) {
            if let Some((message, remedy)) = unresolved(&reference, notation, algorithms) {
                findings.push(Finding::new(&file.path, file.line(at), message, remedy));
            }
        }
    }
    findings
}

/// What is wrong with a reference, and the remedy, if anything is.
fn unresolved(reference: &Reference, notation: &str, algorithms: &str) -> Option<(String, String)> {
    let in_notation = |key: &str, there: bool| {
        let remedy = format!("list it in {NOTATION}, or cite the right place");
        (!there).then(|| (format!("`{key}` does not resolve"), remedy))
    };
    match reference {
        Reference::Place(key) | Reference::Year(key) => {
            in_notation(key, notation.contains(&format!("`{key}`")))
        }
        Reference::Author(key) => in_notation(key, notation.contains(key.as_str())),
        Reference::Label(label) => {
            let there = match label.strip_prefix('§') {
                Some(number) => algorithms.lines().any(|line| line.starts_with(&format!("## {number} "))),
                None => algorithms.contains(&format!("({label})")),
            };
            let remedy = "cite a label or section that the page has".to_owned();
            (!there).then(|| (format!("{ALGORITHMS} has no `{label}`"), remedy))
        }
        Reference::Foreign(text) => {
            let remedy = format!("cite {ALGORITHMS} or a paper");
            Some((format!("`{}` is no part of the project", text.trim_matches('`')), remedy))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ALGORITHMS, NOTATION, check};
    use crate::tree::Tree;

    const PAGES: [(&str, &str); 2] = [
        (NOTATION, "| `2010` | …\n| `2010 eq 36` | the update |\nJia, Xin & Cheng 2013\n"),
        (ALGORITHMS, "## 1 Rules\n\nm = … **(R1)**\n"),
    ];

    fn lines(path: &str, text: &str) -> Vec<usize> {
        let files = [PAGES[0], PAGES[1], (path, text)];
        check(&Tree::of(&files)).iter().map(|finding| finding.line).collect()
    }

    #[test]
    fn what_the_pages_list_resolves() {
        let text = "//! (2010 eq 36; Jia, Xin & Cheng 2013)\n/// docs/algorithms.md R1, §1\nconst A: &str = \"2010 eq 36\";\n";
        assert!(lines("crates/a/src/lib.rs", text).is_empty());
    }

    #[test]
    fn each_reference_that_leads_nowhere_is_found() {
        let text = "//! (2010 eq 37)\n//! (2009)\n//! Jia 2013\n/// docs/algorithms.md R2\n/// docs/algorithms.md §2\n/// (`spec` §0)\n\
                    const A: &str = \"2011 Table 3\";\n";
        let mut found = lines("crates/a/src/lib.rs", text);
        found.sort_unstable();
        assert_eq!(found, [1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(lines("tests/README.md", "by 2010 eq 1\n"), [1]);
    }

    #[test]
    fn missing_pages_are_found() {
        assert_eq!(check(&Tree::default()).len(), 2);
    }
}
