//! A square-root algorithm computes factors from factors: it never forms a covariance.

use crate::finding::Finding;
use crate::tree::Tree;

/// Files of square-root algorithms, beside those that say so in their name.
const FILES: &[&str] = &[
    "crates/givens-core/src/filter/update/joint.rs",
    "crates/givens-core/src/filter/update/separate.rs",
    "crates/givens-core/src/filter/update/square_root.rs",
    "crates/givens-core/src/filter/predict/gain.rs",
];

pub fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for path in FILES.iter().filter(|path| tree.get(path).is_none()) {
        let message = "a square-root file of xtask/src/tidy/factors.rs that is not there";
        findings.push(Finding::new(path, 1, message, "mend the list FILES: where has the algorithm gone?"));
    }
    for file in tree.rust("crates/") {
        let name = file.path.rsplit('/').next().unwrap_or_default();
        if !(FILES.contains(&file.path.as_str()) || name.contains("sqrt") || name.contains("square_root")) {
            continue;
        }
        let code = &file.rust.code;
        let calls = code
            .match_indices("square(")
            .filter(|(at, _)| !code[..*at].ends_with(|c: char| c.is_alphanumeric() || c == '_'));
        findings.extend(calls.map(|(at, _)| {
            let message = "a square-root algorithm forms a covariance with `square`";
            Finding::new(
                &file.path,
                file.line(at),
                message,
                "triangularise instead: `tria`, `sweep` or `downdate`",
            )
        }));
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::{FILES, check};
    use crate::tree::Tree;

    #[test]
    fn a_square_in_a_factor_file_is_found() {
        let good = "use crate::kernels::tria;\nfn f() { let sum_of_square = not_square(2); }\n";
        let mut files: Vec<(&str, &str)> = FILES.iter().map(|path| (*path, good)).collect();
        assert!(check(&Tree::of(&files)).is_empty());
        files[1].1 = "fn f() {\n    square(p, n, s, n, n);\n}\n";
        files.push(("crates/givens-core/src/filter/predict/moment_sqrt.rs", "fn f() { kernels::square(p) }"));
        let found: Vec<usize> = check(&Tree::of(&files)).iter().map(|finding| finding.line).collect();
        assert_eq!(found, [2, 1]);
    }

    #[test]
    fn a_list_that_names_a_lost_file_is_found() {
        assert_eq!(check(&Tree::default()).len(), FILES.len());
    }
}
