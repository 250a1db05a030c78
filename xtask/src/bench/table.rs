//! `benchmarks/contestants.toml`: the workloads, and who runs them.

use std::path::Path;
use toml::de::{DeTable, DeValue};

/// A workload.
#[derive(Debug, Default)]
pub struct Workload {
    pub name: String,
    pub title: String,
    /// What is computed, for the page.
    pub about: String,
    /// How far from the reference, in posterior standard deviations, still is the same computation.
    pub tolerance: f64,
}

/// One who runs workloads.
#[derive(Debug, Default)]
pub struct Contestant {
    pub name: String,
    /// What starts it: `ours`, `peers`, `cpp`, or a script under `benchmarks/python`.
    pub program: String,
    /// What it is called with.
    pub word: String,
    pub workloads: Vec<String>,
    /// One of givens; the others are compared with it.
    pub ours: bool,
    /// Many trajectories at once, or less precise numbers: not what a single filter in double precision is compared with.
    pub class: String,
    /// Those of givens with the same method and a model that is compiled with it, for one whose model is not.
    pub native: Vec<String>,
    /// In place of the workload's, where a contestant computes in single precision.
    pub tolerance: Option<f64>,
    /// The environment of a script: a folder, and the requirements of the same name.
    pub environment: String,
    /// What is to be known of it, for the page.
    pub remark: String,
}

impl Contestant {
    pub fn takes_part(&self, workload: &str) -> bool {
        self.workloads.iter().any(|name| name == workload)
    }
}

/// Both lists.
pub struct Table {
    pub workloads: Vec<Workload>,
    pub contestants: Vec<Contestant>,
}

impl Table {
    pub fn read(path: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        Self::parse(&text).map_err(|error| format!("{}: {error}", path.display()))
    }

    fn parse(text: &str) -> Result<Self, String> {
        let table = DeTable::parse(text).map_err(|error| error.message().to_owned())?.into_inner();
        let workload = |row: &DeTable| {
            Ok(Workload {
                name: word(row, "name")?,
                title: word(row, "title")?,
                about: word(row, "about")?,
                tolerance: number(row, "tolerance").ok_or("a workload without `tolerance`")?,
            })
        };
        let contestant = |row: &DeTable| {
            let or_none = |key: &str| word(row, key).unwrap_or_default();
            Ok(Contestant {
                name: word(row, "name")?,
                program: word(row, "program")?,
                word: word(row, "word")?,
                workloads: word(row, "workloads")?.split(' ').map(str::to_owned).collect(),
                ours: word(row, "program")? == "ours" || row.get("ours").is_some(),
                class: or_none("class"),
                native: list(row, "native"),
                tolerance: number(row, "tolerance"),
                environment: or_none("environment"),
                remark: or_none("remark"),
            })
        };
        Ok(Self {
            workloads: rows(&table, "workload", workload)?,
            contestants: rows(&table, "contestant", contestant)?,
        })
    }
}

fn rows<R>(
    table: &DeTable,
    key: &str,
    read: impl Fn(&DeTable) -> Result<R, String>,
) -> Result<Vec<R>, String> {
    let rows = table.get(key).and_then(|rows| rows.get_ref().as_array()).ok_or(format!("no [[{key}]]"))?;
    let tables = rows.iter().filter_map(|row| row.get_ref().as_table());
    tables.map(read).collect()
}

fn word(row: &DeTable, key: &str) -> Result<String, String> {
    let value = row.get(key).and_then(|value| value.get_ref().as_str());
    value.map(str::to_owned).ok_or_else(|| format!("an entry without `{key}`: {:?}", row.get("name")))
}

/// None where there is no list.
fn list(row: &DeTable, key: &str) -> Vec<String> {
    let values = row.get(key).and_then(|value| value.get_ref().as_array());
    let words = values.into_iter().flat_map(|values| values.iter());
    words.filter_map(|value| value.get_ref().as_str().map(str::to_owned)).collect()
}

fn number(row: &DeTable, key: &str) -> Option<f64> {
    match row.get(key)?.get_ref() {
        DeValue::Float(number) => number.as_str().parse().ok(),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn the_table_of_the_repository_is_read_and_every_workload_has_one_of_ours() {
        let table = Table::parse(include_str!("../../../benchmarks/contestants.toml")).unwrap();
        for workload in &table.workloads {
            assert!(workload.tolerance > 0.0, "{}", workload.name);
            let ours = |one: &super::Contestant| one.ours && one.takes_part(&workload.name);
            assert!(table.contestants.iter().any(ours), "{}", workload.name);
        }
        for one in &table.contestants {
            let known = |name: &String| table.workloads.iter().any(|workload| &workload.name == name);
            assert!(one.workloads.iter().all(known), "{}", one.name);
            let runs = |name: &str, workload: &str| {
                table.contestants.iter().any(|other| other.name == name && other.takes_part(workload))
            };
            let compared = |workload: &String| one.native.iter().any(|name| runs(name, workload));
            assert!(one.native.is_empty() || one.workloads.iter().all(compared), "{}", one.name);
        }
    }

    #[test]
    fn an_entry_without_a_word_is_told() {
        let text = "[[workload]]\nname = \"W\"\n[[contestant]]\nname = \"c\"\n";
        assert!(Table::parse(text).err().unwrap().contains("title"));
    }
}
