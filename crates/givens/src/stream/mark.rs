//! Where a stream stands.

use crate::filter::Snapshot;
use crate::run::{Crossing, Start};

/// How far a stream has come: what it must know to go on from there, besides the marks before.
///
/// A [`Sink`](super::Sink) is given marks on the way, and may keep them, in their order; with the feature `serde` they can be written
/// down. A stream of the same method over the same track that is given them as [`Stream::from`](super::Stream::from) goes on with the same
/// numbers, to the bit, behind what had been handed over.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mark(pub(super) Kind);

impl Mark {
    /// Whether a stream can go on from it without the marks before.
    pub fn is_enough(&self) -> bool {
        matches!(self.0, Kind::Rows { .. })
    }
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) enum Kind {
    /// Once over the data: from here on it is gone over again, but for what was handed over.
    Rows { stand: Stand, handed: usize, at: usize },
    /// In segments of this length: one more begins.
    Segment { length: usize, stand: Stand },
    /// All rows were filtered, so many without a fault.
    Filtered { finished: usize, log_likelihood: f64 },
    /// The way back has crossed one more segment, from the last to the first.
    Back(Option<Crossing<f64>>),
    /// One more segment was handed over.
    Handed,
}

/// The filter before a row.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Stand {
    pub row: usize,
    pub filter: Snapshot,
    /// Of the rows before.
    pub log_likelihood: f64,
}

impl Stand {
    /// How a recorder starts here.
    pub fn start(&self) -> Start<'_> {
        Start::Snapshot(&self.filter)
    }
}
