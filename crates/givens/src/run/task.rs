//! What a run is of, and the rows that it reads.

use super::goal::Goal;
use super::watch::Watch;
use crate::{Data, Row};

/// What is run: all but the rows, and from where.
pub(crate) struct Task<'t, 'm, X, M, H> {
    pub method: X,
    pub model: &'m M,
    pub sensors: &'m H,
    /// In place of the model's, if there are any.
    pub parameters: &'t [f64],
    pub goal: Goal,
    /// The largest NIS that is taken in, by the number of components; empty: any.
    pub limits: &'t [f64],
    /// Once it says stop, no further row is begun, on neither way.
    pub watch: Watch<'t>,
}

impl<X: Copy, M, H> Clone for Task<'_, '_, X, M, H> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<X: Copy, M, H> Copy for Task<'_, '_, X, M, H> {}

/// Rows in order of time, of which any can be read.
pub(crate) trait Rows {
    /// Row `k`, if there is one.
    fn at(&self, k: usize) -> Option<Row<'_>>;
}

impl Rows for &[Row<'_>] {
    fn at(&self, k: usize) -> Option<Row<'_>> {
        self.get(k).copied()
    }
}

impl Rows for Data {
    fn at(&self, k: usize) -> Option<Row<'_>> {
        self.row(k)
    }
}
