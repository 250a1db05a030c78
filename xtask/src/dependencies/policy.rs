//! What `deny.toml` allows.

use serde_json::Value;
use spdx::{Expression, Licensee, ParseMode};
use std::path::Path;
use toml::de::DeTable;

pub struct Policy {
    licences: Vec<Licensee>,
    registries: Vec<String>,
}

impl Policy {
    pub fn read(path: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        Self::parse(&text).map_err(|error| format!("{}: {error}", path.display()))
    }

    fn parse(text: &str) -> Result<Self, String> {
        let table = DeTable::parse(text).map_err(|error| error.to_string())?;
        let list = |section: &str, key: &str| -> Result<Vec<String>, String> {
            let found = table.get_ref().get(section).and_then(|section| section.get_ref().get(key));
            let found = found.and_then(|list| list.get_ref().as_array());
            let found = found.ok_or_else(|| format!("no list `{key}` in [{section}]"))?;
            Ok(found.iter().filter_map(|name| name.get_ref().as_str()).map(str::to_owned).collect())
        };
        let licences = list("licenses", "allow")?;
        let licences = licences.iter().map(|name| Licensee::parse(name).map_err(|error| error.to_string()));
        Ok(Self {
            licences: licences.collect::<Result<_, _>>()?,
            registries: list("sources", "allow-registry")?,
        })
    }

    /// What is wrong with a package of `cargo metadata`, if something is.
    pub fn judge(&self, package: &Value) -> Option<String> {
        let text = |key: &str| package[key].as_str().unwrap_or_default();
        let name = format!("{} {}", text("name"), text("version"));
        let source = text("source");
        if !source
            .strip_prefix("registry+")
            .is_some_and(|from| self.registries.iter().any(|known| known == from))
        {
            return Some(format!("{name} comes from {source}: only the registries of deny.toml are allowed"));
        }
        let licence = text("license");
        if licence.is_empty() {
            return Some(format!("{name} names no licence: choose another crate"));
        }
        // older crates write a slash for OR
        match Expression::parse_mode(licence, ParseMode::LAX) {
            Err(error) => Some(format!("{name}: the licence `{licence}` cannot be read: {}", error.reason)),
            Ok(expression) => {
                let allowed =
                    expression.evaluate(|asked| self.licences.iter().any(|licence| licence.satisfies(asked)));
                (!allowed).then(|| format!("{name}: the licence `{licence}` is not among those of deny.toml"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Policy;
    use serde_json::json;

    const POLICY: &str = "[licenses]\nallow = [\"MIT\", \"Unicode-3.0\", \"Apache-2.0 WITH LLVM-exception\"]\n[sources]\n\
                          allow-registry = [\"https://known\"]\n";

    fn judged(licence: Option<&str>, source: &str) -> Option<String> {
        let policy = Policy::parse(POLICY).unwrap();
        policy.judge(&json!({ "name": "x", "version": "1.0.0", "license": licence, "source": source }))
    }

    #[test]
    fn a_licence_is_allowed_by_one_of_its_choices_and_by_all_that_it_demands() {
        let known = |licence| judged(Some(licence), "registry+https://known");
        for good in [
            "MIT",
            "GPL-3.0-only OR MIT",
            "Unlicense/MIT",
            "(MIT OR Apache-2.0) AND Unicode-3.0",
            "Apache-2.0 WITH LLVM-exception",
        ] {
            assert_eq!(known(good), None, "{good}");
        }
        for bad in ["GPL-3.0-only", "MIT AND MPL-2.0", "Apache-2.0"] {
            assert_eq!(
                known(bad).unwrap(),
                format!("x 1.0.0: the licence `{bad}` is not among those of deny.toml")
            );
        }
        assert!(known("a word").unwrap().starts_with("x 1.0.0: the licence `a word` cannot be read"));
    }

    #[test]
    fn a_crate_without_a_licence_or_of_another_source_is_refused() {
        assert!(judged(None, "registry+https://known").unwrap().contains("names no licence"));
        for source in ["git+https://known", "registry+https://other"] {
            assert!(judged(Some("MIT"), source).unwrap().contains(source));
        }
    }
}
