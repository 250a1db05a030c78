//! Nothing is left for later without a word.

use crate::finding::Finding;
use crate::tree::{File, Tree};

pub fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for file in tree.rust("") {
        for (mark, remedy) in [
            ("todo!", "write it, or return an error that says what is missing"),
            ("unimplemented!", "write it, or return an error that says what is missing"),
            ("#[ignore]", "give the reason: #[ignore = \"…\"]"),
        ] {
            found(file, &file.rust.code, mark, remedy, &mut findings);
        }
        for mark in ["TODO", "FIXME"] {
            let remedy = "mend it, or open an issue and describe the limit where users read it";
            found(file, &file.rust.comments, mark, remedy, &mut findings);
        }
    }
    findings
}

fn found(file: &File, text: &str, mark: &str, remedy: &str, findings: &mut Vec<Finding>) {
    findings.extend(
        text.match_indices(mark)
            .map(|(at, _)| Finding::new(&file.path, file.line(at), format!("`{mark}` is left in"), remedy)),
    );
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tree::Tree;

    #[test]
    fn every_mark_is_found_where_it_counts_and_only_there() {
        let bad = "// TODO later\nfn f() { todo!() }\nfn g() { unimplemented!(\"x\") }\n// FIXME\n#[ignore]\nfn t() {}\n";
        let good = "#[ignore = \"takes an hour\"]\nfn t() { let word = \"TODO\"; }\n";
        let lines =
            |text| check(&Tree::of(&[("tests/a.rs", text)])).iter().map(|f| f.line).collect::<Vec<_>>();
        let mut found = lines(bad);
        found.sort_unstable();
        assert_eq!(found, [1, 2, 3, 4, 5]);
        assert!(lines(good).is_empty());
    }
}
