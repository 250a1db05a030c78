//! Only givens-io and the command touch files; only the command prints.

use super::paths::names_after;
use crate::finding::Finding;
use crate::tree::{File, Tree};

/// Crates that may open files.
const OPEN: &[&str] = &["givens-io", "givens-cli"];
/// Crates that may print.
const PRINT: &[&str] = &["givens-cli"];

pub fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for file in tree.rust("crates/") {
        let mut parts = file.path.split('/').skip(1);
        let (Some(name), Some("src")) = (parts.next(), parts.next()) else { continue };
        if !OPEN.contains(&name) {
            opens(file, name, &mut findings);
        }
        if !PRINT.contains(&name) {
            prints(file, name, &mut findings);
        }
    }
    findings
}

fn opens(file: &File, name: &str, findings: &mut Vec<Finding>) {
    let used =
        names_after(&file.rust.code, "std::").into_iter().filter(|(_, part)| matches!(*part, "fs" | "io"));
    findings.extend(used.map(|(at, part)| {
        let message = format!("{name} names `std::{part}`, but only {} touch files", OPEN.join(" and "));
        Finding::new(
            &file.path,
            file.line(at),
            message,
            "take and give data; let givens-io read and write it",
        )
    }));
}

fn prints(file: &File, name: &str, findings: &mut Vec<Finding>) {
    let code = &file.rust.code;
    for mark in ["print!", "println!", "eprint!", "eprintln!", "dbg!", "stdout()", "stderr()"] {
        let whole = |at: usize| !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        findings.extend(code.match_indices(mark).filter(|(at, _)| whole(*at)).map(|(at, _)| {
            let message = format!("{name} prints (`{mark}`), but only {} does", PRINT.join(" and "));
            Finding::new(
                &file.path,
                file.line(at),
                message,
                "return what is to be said, or count it in a record",
            )
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tree::Tree;

    fn lines(path: &str, text: &str) -> Vec<usize> {
        check(&Tree::of(&[(path, text)])).iter().map(|finding| finding.line).collect()
    }

    #[test]
    fn files_are_for_the_crates_that_own_them() {
        let text = "use std::{fmt, fs};\nuse std::io::Write;\n";
        assert_eq!(lines("crates/givens/src/data.rs", text), [1, 2]);
        assert!(lines("crates/givens-io/src/source.rs", text).is_empty());
        assert!(lines("crates/givens/tests/data.rs", text).is_empty());
    }

    #[test]
    fn printing_is_for_the_command() {
        let text = "fn f() {\n    eprintln!(\"x\");\n    let s = \"println!\"; // println!\n}\n";
        assert_eq!(lines("crates/givens-io/src/a.rs", text), [2]);
        assert!(lines("crates/givens-cli/src/a.rs", text).is_empty());
    }
}
