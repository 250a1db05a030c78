//! What others see of a run at work, and have to say to it.

use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// What others see of a run at work, and have to say to it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Watch<'t> {
    /// Cancels the run when it is set.
    pub cancel: Option<&'t AtomicBool>,
    /// Counts the rows that are taken in.
    pub rows: Option<&'t AtomicUsize>,
}

impl Watch<'_> {
    pub fn stopped(&self) -> bool {
        self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed))
    }

    pub fn count(&self, rows: usize) {
        if let Some(count) = self.rows {
            count.fetch_add(rows, Ordering::Relaxed);
        }
    }
}
