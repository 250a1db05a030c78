//! Portions of the tracks, as the batches that run them: all numbers of a portion are in memory at once, of those that are done
//! only the ones that are written.

use core::ops::Range;
use std::io;

use givens::{Data, DataError, Goal};

use crate::model_file::Beginning;
use crate::table::{Row, Track};

/// Rows and tracks that are run and written together, at least: enough tracks for packs of equal lengths.
const LEAST: (usize, usize) = (1 << 17, 256);

/// Tracks that are run together, for one goal.
#[derive(Clone, Debug)]
pub struct Portion {
    /// Which.
    pub tracks: Range<usize>,
    /// What for.
    pub goal: Goal,
    rows: usize,
}

/// The tracks in portions, in their order; of each the goal.
#[must_use]
pub fn portions(tracks: &[Track], goal: impl Fn(usize) -> Goal) -> Vec<Portion> {
    let mut portions: Vec<Portion> = Vec::new();
    for (i, track) in tracks.iter().enumerate() {
        let (goal, rows) = (goal(i), track.rows.len());
        match portions.last_mut().filter(|last| last.goal == goal && !last.is_full()) {
            Some(last) => {
                last.tracks.end = i + 1;
                last.rows += rows;
            }
            None => portions.push(Portion { tracks: i..i + 1, goal, rows }),
        }
    }
    portions
}

impl Portion {
    fn is_full(&self) -> bool {
        self.rows >= LEAST.0 && self.tracks.len() >= LEAST.1
    }
}

/// Why the rows of a track could not be handed to a filter.
#[derive(Debug)]
pub enum Unread {
    /// They lie on a disk, and cannot be read any more.
    Lost(io::Error),
    /// One of them is no row of the data.
    Wrong(Box<Row>, DataError),
}

impl Track {
    /// These rows, counted from where the track begins, with d measures and so many controls. What `start` has read of the
    /// first one is not in them.
    ///
    /// # Errors
    /// A row that cannot be read, or taken in.
    pub fn data(
        &self,
        (d, controls): (usize, usize),
        begin: &Beginning,
        rows: Range<usize>,
    ) -> Result<Data, Unread> {
        let mut data = Data::with_controls(d, controls).starting_at(begin.time);
        let empty = vec![f64::NAN; d];
        let of_track = rows.start + begin.row..rows.end.saturating_add(begin.row);
        let read = self.rows.read(of_track).map_err(Unread::Lost)?;
        for (k, row) in rows.zip(read.iter()) {
            let z = if begin.started && k == 0 { &empty } else { &row.z };
            data.push_controlled(row.time, z, &row.u)
                .map_err(|error| Unread::Wrong(Box::new(row.clone()), error))?;
        }
        Ok(data)
    }
}

#[cfg(test)]
mod tests {
    use super::{LEAST, portions};
    use crate::table::{Row, Rows, Track};
    use givens::Goal;

    fn track(rows: usize) -> Track {
        let row = Row {
            line: 1,
            index: 0,
            time: 0.0,
            time_text: String::new(),
            sensor: None,
            z: vec![],
            u: vec![],
        };
        Track { id: None, start: 0.0, rows: Rows::from(vec![row; rows]), origin: None }
    }

    #[test]
    fn a_portion_has_enough_rows_and_tracks_and_one_goal() {
        let ranges = |tracks: &[Track], goal: &dyn Fn(usize) -> Goal| -> Vec<_> {
            portions(tracks, goal).into_iter().map(|portion| (portion.tracks, portion.goal)).collect()
        };
        let few = vec![track(1); 1000];
        assert_eq!(ranges(&few, &|_| Goal::Filter), [(0..1000, Goal::Filter)]);
        let long = vec![track(LEAST.0 / LEAST.1); 2 * LEAST.1 + 3];
        let expected = [0..LEAST.1, LEAST.1..2 * LEAST.1, 2 * LEAST.1..2 * LEAST.1 + 3];
        assert_eq!(ranges(&long, &|_| Goal::Interval), expected.map(|range| (range, Goal::Interval)));
        let goal = |i: usize| if i < 3 { Goal::Filter } else { Goal::Interval };
        assert_eq!(ranges(&few[..5], &goal), [(0..3, Goal::Filter), (3..5, Goal::Interval)]);
    }
}
