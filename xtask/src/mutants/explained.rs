//! tests/mutants.toml: mutants that no test sees, each with the reason why none needs to.

use std::collections::BTreeMap;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// A reason, and the mutants of each group that survive for it.
#[derive(Debug, PartialEq, Eq)]
pub struct Reason {
    pub why: String,
    pub mutants: BTreeMap<String, Vec<String>>,
}

/// The reasons, in the order of the file.
pub fn read(root: &Path) -> Result<Vec<Reason>, String> {
    let path = root.join("tests/mutants.toml");
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    parse(&text).map_err(|message| format!("{}: {message}", path.display()))
}

fn parse(text: &str) -> Result<Vec<Reason>, String> {
    let table = DeTable::parse(text).map_err(|error| error.message().to_owned())?.into_inner();
    let reasons = table.get("reason").and_then(|value| value.get_ref().as_array()).ok_or("no [[reason]]")?;
    reasons.iter().map(|value| reason(value.get_ref())).collect()
}

fn reason(value: &DeValue) -> Result<Reason, String> {
    let table = value.as_table().ok_or("a reason is a table")?;
    let mut reason = Reason { why: String::new(), mutants: BTreeMap::new() };
    for (key, value) in table {
        let key: &str = AsRef::<str>::as_ref(key.get_ref());
        match value.get_ref() {
            DeValue::String(why) if key == "why" => reason.why = why.to_string(),
            DeValue::Array(names) => {
                let name = |name: &toml::Spanned<DeValue>| name.get_ref().as_str().map(str::to_owned);
                let names: Option<Vec<String>> = names.iter().map(name).collect();
                reason.mutants.insert(key.to_owned(), names.ok_or("mutants are strings")?);
            }
            _ => return Err(format!("{key:?} is neither why nor a group's list")),
        }
    }
    if reason.why.is_empty() { Err("a reason without why".to_owned()) } else { Ok(reason) }
}

#[cfg(test)]
mod tests {
    #[test]
    fn reasons_are_read() {
        let read = super::parse("[[reason]]\nwhy = \"the same\"\nrules = ['a.rs f: x']\n").unwrap();
        assert_eq!((read[0].why.as_str(), read[0].mutants["rules"].len()), ("the same", 1));
        assert!(super::parse("[[reason]]\nrules = []\n").is_err());
    }
}
