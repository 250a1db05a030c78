//! Where the rows of a stream come from.

use crate::run::Rows;
use crate::{Data, Row};
use core::ops::Range;
use std::borrow::Cow;

/// The rows of one trajectory, of which a stream asks for a stretch at a time: [`Data`], or what reads them from where they
/// lie.
///
/// ```
/// use core::ops::Range;
/// use givens::{Data, Source, Stretch};
///
/// /// A clock that is read a thousand million times.
/// struct Ticks;
///
/// impl Source for Ticks {
///     fn start(&self) -> f64 {
///         0.0
///     }
///     fn len(&self) -> usize {
///         1_000_000_000
///     }
///     fn read(&self, rows: Range<usize>) -> Option<Stretch<'_>> {
///         let mut data = Data::new(1);
///         for k in rows.clone() {
///             data.push(k as f64, &[1.0]).ok()?;
///         }
///         Some(Stretch::new(data, rows.start))
///     }
/// }
/// ```
pub trait Source: Sync {
    /// The time at which the initial belief holds.
    fn start(&self) -> f64;

    /// Number of rows.
    fn len(&self) -> usize;

    /// No rows.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// These rows, and perhaps others beside them; several threads may ask at once. None where they cannot be read: a stream
    /// ends there as if it was cancelled, and the source tells its owner why.
    fn read(&self, rows: Range<usize>) -> Option<Stretch<'_>>;
}

/// Rows of a trajectory that are in memory.
#[derive(Clone, Debug)]
pub struct Stretch<'a> {
    data: Cow<'a, Data>,
    first: usize,
}

impl Stretch<'_> {
    /// Of a trajectory the rows from row `first` on.
    pub fn new(data: Data, first: usize) -> Self {
        Self { data: Cow::Owned(data), first }
    }
}

impl Rows for Stretch<'_> {
    fn at(&self, k: usize) -> Option<Row<'_>> {
        self.data.row(k.checked_sub(self.first)?)
    }
}

impl Source for Data {
    fn start(&self) -> f64 {
        self.start()
    }

    fn len(&self) -> usize {
        self.len()
    }

    fn read(&self, _: Range<usize>) -> Option<Stretch<'_>> {
        Some(Stretch { data: Cow::Borrowed(self), first: 0 })
    }
}

impl<S: Source + ?Sized> Source for &S {
    fn start(&self) -> f64 {
        (**self).start()
    }

    fn len(&self) -> usize {
        (**self).len()
    }

    fn read(&self, rows: Range<usize>) -> Option<Stretch<'_>> {
        (**self).read(rows)
    }
}
