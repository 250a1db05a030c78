//! `unsafe` stands where it must, each with its reason, and docs/reliability.md tells how often.

use crate::finding::Finding;
use crate::tree::{File, Tree};

/// Where it may stand.
const FOLDERS: &[&str] = &["crates/givens-core/src/scalar/", "crates/givens-python/src/"];
/// Where its number is told.
const TOLD: &str = "docs/reliability.md";
/// The reason stands so many lines before it, at most: attributes and the rest of a reason may stand between.
const BEFORE: usize = 5;

pub fn check(tree: &Tree) -> Vec<Finding> {
    let (mut findings, mut count) = (Vec::new(), 0);
    for file in tree.rust("crates/") {
        for line in places(file) {
            count += 1;
            if !FOLDERS.iter().any(|folder| file.path.starts_with(folder)) {
                let help = format!("keep it to {}", FOLDERS.join(" and "));
                findings.push(Finding::new(&file.path, line, "`unsafe` in a crate that has none", &help));
            }
            let comments = file.rust.comments.lines().skip(line.saturating_sub(BEFORE + 1));
            let reason = comments.take(BEFORE + 1).any(|text| text.to_lowercase().contains("safety"));
            if !reason {
                let message = "`unsafe` without its reason";
                findings.push(Finding::new(&file.path, line, message, "say why it is sound: // SAFETY: …"));
            }
        }
    }
    let sentence = format!("`unsafe` stands {count} times");
    if tree.get(TOLD).is_some_and(|file| !file.text.contains(&sentence)) {
        findings.push(Finding::new(
            TOLD,
            1,
            "it tells another number of `unsafe`",
            format!("write: {sentence}"),
        ));
    }
    findings
}

/// The lines of blocks, functions and implementations; the types of functions elsewhere are none.
fn places(file: &File) -> Vec<usize> {
    let code = &file.rust.code;
    let is_place = |(at, word): &(usize, &str)| {
        let begins = !code[..*at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let rest = code[at + word.len()..].trim_start();
        begins && (rest.starts_with('{') || rest.starts_with("fn ") || rest.starts_with("impl"))
    };
    code.match_indices("unsafe").filter(is_place).map(|(at, _)| file.line(at)).collect()
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tree::Tree;

    fn found(files: &[(&str, &str)]) -> Vec<(String, usize)> {
        check(&Tree::of(files)).into_iter().map(|finding| (finding.path, finding.line)).collect()
    }

    #[test]
    fn reasons_and_places_are_asked_for() {
        let good = "// SAFETY: it is there.\nunsafe { f() }\ntype F = unsafe extern \"C\" fn();\n";
        let bad = "fn f() {\n    let unsafe_code = 1;\n    unsafe { g() }\n}\n";
        let scalar = "crates/givens-core/src/scalar/a.rs";
        assert!(found(&[(scalar, good)]).is_empty());
        assert_eq!(found(&[(scalar, bad)]), [(scalar.to_owned(), 3)]);
        let elsewhere = "crates/givens/src/a.rs";
        assert_eq!(found(&[(elsewhere, good)]), [(elsewhere.to_owned(), 2)]);
    }

    #[test]
    fn the_number_is_told() {
        let scalar = ("crates/givens-core/src/scalar/a.rs", "// SAFETY: so.\nunsafe { f() }\n");
        let right = ("docs/reliability.md", "- `unsafe` stands 1 times, …\n");
        assert!(found(&[scalar, right]).is_empty());
        let wrong = ("docs/reliability.md", "- `unsafe` stands 2 times, …\n");
        assert_eq!(found(&[scalar, wrong]), [("docs/reliability.md".to_owned(), 1)]);
    }
}
