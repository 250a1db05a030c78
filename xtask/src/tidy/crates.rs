//! The crates of the project depend on each other in one direction.

use crate::finding::Finding;
use crate::tree::{File, Tree};
use toml::de::DeTable;

/// A crate may depend on those of the ranks before its own.
const RANKS: &[&[&str]] = &[
    &["givens-core"],
    &["givens-expr", "givens"],
    &["givens-io"],
    &["givens-papers"],
    &["givens-cli", "givens-python"],
];

/// The tables of a manifest whose crates end in what a user builds.
const TABLES: &[&str] = &["dependencies", "build-dependencies"];

fn rank(name: &str) -> Option<usize> {
    RANKS.iter().position(|names| names.contains(&name))
}

pub fn check(tree: &Tree) -> Vec<Finding> {
    let manifests = tree.files().filter(|f| f.path.starts_with("crates/") && f.path.ends_with("/Cargo.toml"));
    manifests.flat_map(manifest).collect()
}

fn manifest(file: &File) -> Vec<Finding> {
    let found = |at: usize, message: String, remedy: &str| {
        vec![Finding::new(&file.path, file.line(at), message, remedy)]
    };
    let table = match DeTable::parse(&file.text) {
        Ok(table) => table.into_inner(),
        Err(error) => return found(0, format!("not TOML: {}", error.message()), "mend it"),
    };
    let section = |key: &str| table.get(key).and_then(|value| value.get_ref().as_table());
    let name = section("package").and_then(|package| package.get("name"));
    let (at, name) = name.map_or((0, ""), |name| (name.span().start, name.get_ref().as_str().unwrap_or("")));
    let Some(own) = rank(name) else {
        let message = format!("the crate `{name}` has no place in the order of crates");
        return found(at, message, "give it one in RANKS of xtask/src/tidy/crates.rs");
    };
    let used = TABLES.iter().filter_map(|key| section(key)).flat_map(DeTable::keys);
    used.filter(|used| rank(used.get_ref()).is_some_and(|other| other >= own))
        .flat_map(|used| {
            let order: Vec<String> = RANKS.iter().map(|names| names.join(", ")).collect();
            let message =
                format!("`{name}` depends on `{}`, against the order {}", used.get_ref(), order.join(" ← "));
            found(used.span().start, message, "move what is shared into a crate that both may use")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tree::Tree;

    fn found(text: &str) -> Vec<(usize, String)> {
        let tree = Tree::of(&[("crates/x/Cargo.toml", text)]);
        check(&tree).into_iter().map(|finding| (finding.line, finding.message)).collect()
    }

    #[test]
    fn a_dependency_against_the_order_is_found_at_its_line() {
        let wrong = "[package]\nname = \"givens-expr\"\n[dependencies]\ngivens-core.workspace = true\ngivens = { path = \"..\" }\n";
        assert_eq!(found(wrong)[0].0, 5);
        let right =
            "[package]\nname = \"givens-io\"\n[dependencies]\ngivens.workspace = true\ntoml = \"1\"\n";
        assert!(found(right).is_empty());
        let tests_only = "[package]\nname = \"givens-core\"\n[dev-dependencies]\ngivens.workspace = true\n";
        assert!(found(tests_only).is_empty());
    }

    #[test]
    fn a_crate_without_a_place_is_found() {
        assert!(found("[package]\nname = \"givens-utils\"\n")[0].1.contains("no place"));
    }
}
