//! The published numbers, as data with their source.

use core::fmt;

/// The numbers of one `expected/*.toml`.
#[derive(Clone, Debug)]
pub struct Expected {
    /// Where they stand in print.
    pub source: String,
    table: toml::Table,
}

/// A number that a file of expected numbers lacks, or a file that is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpectedError(String);

impl fmt::Display for ExpectedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "expected numbers: {}", self.0)
    }
}

impl core::error::Error for ExpectedError {}

impl Expected {
    /// Reads a file.
    ///
    /// # Errors
    /// What is no TOML, or names no source.
    pub fn read(text: &str) -> Result<Self, ExpectedError> {
        let table: toml::Table =
            text.parse().map_err(|error: toml::de::Error| ExpectedError(error.to_string()))?;
        let source = table.get("source").and_then(toml::Value::as_str);
        let source = source.ok_or_else(|| ExpectedError("no `source`".to_owned()))?.to_owned();
        Ok(Self { source, table })
    }

    /// The number at a path of keys; `None` where print has none.
    pub fn number(&self, path: &[&str]) -> Option<f64> {
        number(self.at(path)?)
    }

    /// The numbers at a path of keys; empty where print has none.
    pub fn numbers(&self, path: &[&str]) -> Vec<f64> {
        let array = self.at(path).and_then(toml::Value::as_array);
        array.map(|array| array.iter().filter_map(number).collect()).unwrap_or_default()
    }

    /// The words at a path of keys.
    pub fn word(&self, path: &[&str]) -> Option<&str> {
        self.at(path)?.as_str()
    }

    fn at(&self, path: &[&str]) -> Option<&toml::Value> {
        let (first, rest) = path.split_first()?;
        rest.iter().try_fold(self.table.get(*first)?, |value, key| value.get(key))
    }
}

fn number(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|x| x as f64))
}
