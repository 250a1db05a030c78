//! What the peers' programs wrote.

use super::{Answered, Asks, Moments};
use crate::{lower, numbers};
use serde_json::Value;

/// A filter of another program: by case, its answer on each rung.
pub struct Peer {
    /// Program and filter.
    pub name: String,
    /// Whether it computes in `f32`.
    pub single: bool,
    /// How it asks the model.
    pub asks: Asks,
    cases: Value,
}

impl Peer {
    /// Its answers on the rungs of a case, if it runs it.
    #[must_use]
    pub fn answers(&self, case: &str) -> Option<Vec<Answered>> {
        Some(self.cases.get(case)?.as_array()?.iter().map(answered).collect())
    }
}

fn answered(of: &Value) -> Answered {
    let row = |row: &Value| -> Moments { (numbers(&row["mean"]), lower(&numbers(&row["cov"]))) };
    Answered {
        rows: of["rows"].as_array().unwrap().iter().map(row).collect(),
        refused: of["error"].as_str().map(str::to_owned),
    }
}

/// The filters of a file that a peer's program wrote.
///
/// # Panics
/// If it is no such file.
#[must_use]
pub fn read_peers(text: &str) -> Vec<Peer> {
    let file: Value = serde_json::from_str(text).unwrap();
    let peer = |of: &Value| Peer {
        name: of["name"].as_str().unwrap().to_owned(),
        single: of["precision"].as_str() == Some("f32"),
        asks: if of["points"].as_bool().unwrap() { Asks::Points } else { Asks::Slopes },
        cases: of["cases"].clone(),
    };
    file.as_array().unwrap().iter().map(peer).collect()
}
