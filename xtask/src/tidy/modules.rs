//! Inside givens-core, a module uses only itself and those above it.

use super::paths::{heads, names_after};
use crate::finding::Finding;
use crate::tree::{File, Tree};

const CORE: &str = "crates/givens-core/src/";

/// From the one that uses none of the others to the one that may use all.
const ORDER: &[&str] = &["scalar", "kernels", "model", "rule", "ode", "filter", "smoother"];

pub fn check(tree: &Tree) -> Vec<Finding> {
    tree.rust(CORE).flat_map(file).collect()
}

fn file(file: &File) -> Vec<Finding> {
    let Some(inside) = file.path.strip_prefix(CORE).and_then(|path| path.strip_suffix(".rs")) else {
        return Vec::new();
    };
    let parts: Vec<&str> = inside.split('/').filter(|part| *part != "mod").collect();
    let Some((&own, _)) = parts.split_first() else { return Vec::new() };
    if own == "lib" {
        return Vec::new();
    }
    let Some(rank) = ORDER.iter().position(|module| *module == own) else {
        let remedy =
            "give it its place in ORDER of xtask/src/tidy/modules.rs, or put it into one of the modules";
        return vec![Finding::new(
            &file.path,
            1,
            format!("`{own}` is a module without a place in the order"),
            remedy,
        )];
    };
    let code = &file.rust.code;
    let mut used = names_after(code, "crate::");
    // a chain of `super` that reaches the root of the crate
    let chain = "super::".repeat(parts.len());
    for (at, _) in code.match_indices(&chain) {
        heads(code, at + chain.len(), &mut used);
    }
    let below = used.into_iter().filter(|(_, name)| ORDER.iter().skip(rank + 1).any(|module| module == name));
    below
        .map(|(at, name)| {
            Finding::new(
                &file.path,
                file.line(at),
                format!("`{own}` uses `{name}`, which stands below it ({})", ORDER.join(" → ")),
                format!("move what is shared up to `{own}` or above it, or the user down"),
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tree::Tree;

    #[test]
    fn a_kernel_that_knows_a_filter_is_found_at_its_line() {
        let tree = Tree::of(&[
            (
                "crates/givens-core/src/kernels/tria.rs",
                "use super::Health;\nuse crate::{\n    scalar::Real,\n    filter::Form,\n};\n",
            ),
            ("crates/givens-core/src/rule/mod.rs", "use crate::scalar::Real;\nuse crate::model::Map;\n"),
            ("crates/givens-core/src/model/map.rs", "use super::super::smoother::History;\n"),
        ]);
        let found: Vec<_> = check(&tree).iter().map(|f| (f.path.clone(), f.line)).collect();
        let expected =
            [("crates/givens-core/src/kernels/tria.rs", 4), ("crates/givens-core/src/model/map.rs", 1)];
        assert_eq!(found, expected.map(|(path, line)| (path.to_owned(), line)));
    }

    #[test]
    fn a_module_without_a_place_is_found_and_comments_are_not_uses() {
        let unknown = Tree::of(&[("crates/givens-core/src/utils.rs", "")]);
        assert_eq!(check(&unknown).len(), 1);
        let comment =
            Tree::of(&[("crates/givens-core/src/scalar/mod.rs", "//! See [`f`](crate::filter).\n")]);
        assert!(check(&comment).is_empty());
    }
}
