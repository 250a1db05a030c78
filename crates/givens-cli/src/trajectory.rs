//! The rows of a table's only track, as a stream asks for them.

use crate::message::Stop;
use crate::plan::Plan;
use crate::portion;
use core::ops::Range;
use givens::{Source, Stretch};
use std::sync::{Mutex, PoisonError};

/// The rows from the beginning of the track on.
pub struct Trajectory<'p> {
    plan: &'p Plan,
    /// Why rows could not be read.
    stop: Mutex<Option<Stop>>,
}

impl<'p> Trajectory<'p> {
    pub fn new(plan: &'p Plan) -> Self {
        Self { plan, stop: Mutex::new(None) }
    }

    /// Why the stream ended before its rows did, if it could not read them.
    pub fn stop(self) -> Option<Stop> {
        self.stop.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Source for Trajectory<'_> {
    fn start(&self) -> f64 {
        self.plan.beginnings[0].time
    }

    fn len(&self) -> usize {
        self.plan.tracks.tracks[0].rows.len() - self.plan.beginnings[0].row
    }

    fn read(&self, rows: Range<usize>) -> Option<Stretch<'_>> {
        let first = rows.start;
        match portion::stretch(self.plan, 0, rows) {
            Ok(data) => Some(Stretch::new(data, first)),
            Err(stop) => {
                self.stop.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(stop);
                None
            }
        }
    }
}
