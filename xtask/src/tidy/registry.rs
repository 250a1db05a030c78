//! Every method of the registry has sources, and a row in the README. (That sources resolve is for the citations.)

use super::references::{Reference, references};
use crate::finding::Finding;
use crate::tree::{File, Tree};
use givens::registry::{ENTRIES, Entry};

const README: &str = "README.md";
const REGISTRY: &str = "crates/givens/src/registry/entry.rs";

pub fn check(tree: &Tree) -> Vec<Finding> {
    rows(tree, ENTRIES)
}

fn rows(tree: &Tree, entries: &[Entry]) -> Vec<Finding> {
    entries.iter().flat_map(|entry| row(tree, entry)).collect()
}

fn row(tree: &Tree, entry: &Entry) -> Vec<Finding> {
    let text = |path| tree.get(path).map_or("", |file: &File| file.text.as_str());
    let quoted = format!("\"{}\"", entry.name);
    let line = text(REGISTRY).lines().position(|line| line.contains(&quoted)).map_or(1, |at| at + 1);
    let mut findings = Vec::new();
    let mut find = |path: &str, line, message: String, remedy: &str| {
        findings.push(Finding::new(path, line, format!("`{}` {message}", entry.name), remedy));
    };
    if entry.sources.is_empty() {
        find(REGISTRY, line, "has no source".into(), "cite the papers that the method comes from");
    }
    let mut keys = Vec::new();
    for source in entry.sources {
        let Some(key) = key(source) else {
            find(
                REGISTRY,
                line,
                format!("cites `{source}` without author and year"),
                "begin with them: `Author 2009, …`",
            );
            continue;
        };
        keys.push(key);
    }
    let start = format!("| `{}` ", entry.name);
    let rows = text(README).lines().enumerate();
    let Some((at, row)) = rows.into_iter().find(|(_, line)| line.starts_with(&start)) else {
        find(
            README,
            1,
            "has no row in the table of methods".into(),
            &format!("add one: {start}| rule | form | sources |"),
        );
        return findings;
    };
    let words = entry.aliases.iter().copied().chain([entry.rule.word(), entry.form.word()]);
    for word in words.map(|word| format!("`{word}`")).chain(keys) {
        if !row.contains(&word) {
            find(
                README,
                at + 1,
                format!("stands in the table without {word}"),
                "the registry has it: add it to the row",
            );
        }
    }
    findings
}

/// The last author and year of a source.
fn key(source: &str) -> Option<String> {
    references(source, true).into_iter().find_map(|(_, reference)| match reference {
        Reference::Author(key) => Some(key),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::{README, rows};
    use crate::tree::Tree;
    use givens::filter::predict::Variant;
    use givens::registry::{Entry, FormName, RuleName, TimeName};

    const ENTRY: Entry = Entry {
        name: "ckf",
        aliases: &["cubature"],
        about: "a filter",
        rule: RuleName::Cubature3,
        form: FormName::Covariance,
        time_update: TimeName::Transition,
        variant: Variant::Simplified,
        adaptive: false,
        sources: &["Arasaratnam & Haykin 2009, Cubature Kalman filters"],
    };
    const ROW: &str = "| `ckf` (`cubature`) | `cubature3` | `covariance` | Arasaratnam & Haykin 2009 |\n";

    fn found(entry: Entry, readme: &str) -> usize {
        rows(&Tree::of(&[(README, readme)]), &[entry]).len()
    }

    #[test]
    fn a_method_with_source_and_row_is_in_order() {
        assert_eq!(found(ENTRY, ROW), 0);
    }

    #[test]
    fn each_lack_is_found() {
        assert_eq!(found(ENTRY, ""), 1);
        assert_eq!(found(ENTRY, "| `ckf` | `cubature3` | `covariance` | Haykin 2009 |"), 1);
        assert_eq!(found(ENTRY, &ROW.replace("cubature3", "unscented")), 1);
        assert_eq!(found(ENTRY, &ROW.replace("2009", "")), 1);
        assert_eq!(found(Entry { sources: &[], ..ENTRY }, ROW), 1);
        assert_eq!(found(Entry { sources: &["a book"], ..ENTRY }, ROW), 1);
    }
}
