//! Runs that failed, counted by kind.

use givens::filter::{Fault, StepError};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// How many runs of one method failed, and of what.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Failures {
    kinds: BTreeMap<Cow<'static, str>, usize>,
}

impl Failures {
    /// Counts a run that stopped.
    pub fn note(&mut self, error: &StepError) {
        let kind = match error.fault {
            Fault::NotPositive { matrix, .. } => {
                return self.add_one(format!("{} not positive definite", matrix.name()).into());
            }
            Fault::SingularInnovation { .. } => "singular innovation",
            Fault::Unresolved { .. } => "steps too long for the smoother",
            Fault::SingularFactor { .. } => "singular factor",
            Fault::NotFinite { .. } => "not a number",
            Fault::Unrepresentable { .. } => "beyond f32",
            Fault::Indistinct { .. } => "points that coincide",
            Fault::Solver { .. } => "the solver's steps",
            _ => "other",
        };
        self.note_kind(kind);
    }

    /// Counts a run that was lost in another way, such as an error beyond a threshold.
    pub fn note_kind(&mut self, kind: &'static str) {
        self.add_one(kind.into());
    }

    fn add_one(&mut self, kind: Cow<'static, str>) {
        *self.kinds.entry(kind).or_default() += 1;
    }

    /// Counts all of another's too.
    pub fn add(&mut self, other: &Self) {
        other.kinds.iter().for_each(|(kind, count)| *self.kinds.entry(kind.clone()).or_default() += count);
    }

    /// All of them.
    pub fn count(&self) -> usize {
        self.kinds.values().sum()
    }
}

impl core::fmt::Display for Failures {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let kinds: Vec<_> = self.kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        if kinds.is_empty() { f.write_str("none") } else { f.write_str(&kinds.join(", ")) }
    }
}
