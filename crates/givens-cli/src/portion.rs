//! Portions of the tracks, as the batches that run them: all numbers of a portion are in memory at once, of those that are done
//! only the ones that are written.

use crate::failure;
use crate::instants::Instants;
use crate::message::Stop;
use crate::plan::Plan;
use core::ops::Range;
use givens::batch::{Batch, Track};
use givens::registry::Choice;
use givens::{Data, DataError, Goal, Outcome};
use givens_io::{Beginning, Dynamics, PORTION};

/// Tracks that are run together, for one goal.
pub struct Portion {
    /// Which.
    pub tracks: Range<usize>,
    /// What for.
    pub goal: Goal,
    rows: usize,
}

/// The tracks of a plan in portions, in their order.
pub fn portions(plan: &Plan, goals: &[Goal]) -> Vec<Portion> {
    let mut portions: Vec<Portion> = Vec::new();
    for (i, (track, &goal)) in plan.tracks.tracks.iter().zip(goals).enumerate() {
        let rows = track.rows.len();
        match portions.last_mut().filter(|last| last.goal == goal && !last.full()) {
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
    fn full(&self) -> bool {
        self.rows >= PORTION.0 && self.tracks.len() >= PORTION.1
    }

    /// What comes of those of its tracks that begin.
    pub fn run(
        &self,
        plan: &Plan,
        choice: &Choice,
        batch: &Batch,
        at: Option<&Instants>,
    ) -> Result<Vec<(usize, Outcome)>, Stop> {
        let sensors = &plan.model.observation;
        let begin: Vec<usize> = self.tracks.clone().filter(|i| !plan.unbegun.contains_key(i)).collect();
        let data = begin.iter().map(|&i| data(plan, i)).collect::<Result<Vec<_>, _>>()?;
        let at: Vec<_> = begin.iter().map(|&i| at.map_or(Vec::new(), |at| at.of(i))).collect();
        let begun: Vec<_> = begin.iter().map(|&i| &plan.beginnings[i]).collect();
        let outcomes = match &plan.model.dynamics {
            Dynamics::Discrete(model) => choice.run_batch(&tracks(model, sensors, &data, &begun, &at), batch),
            Dynamics::Continuous(model) => {
                choice.run_batch_continuous(&tracks(model, sensors, &data, &begun, &at), batch)
            }
        };
        // none was cancelled
        Ok(begin.into_iter().zip(outcomes.into_iter().flatten()).collect())
    }
}

fn tracks<'a, M, H>(
    model: &'a M,
    sensors: &'a H,
    data: &'a [Data],
    beginnings: &[&'a Beginning],
    at: &'a [Vec<f64>],
) -> Vec<Track<'a, M, H>> {
    let each = data.iter().zip(beginnings).zip(at);
    each.map(|((data, begin), at)| Track { at, ..Track::new(model, sensors, data, &begin.prior) }).collect()
}

/// The rows of track `i` from its beginning on.
fn data(plan: &Plan, i: usize) -> Result<Data, Stop> {
    stretch(plan, i, 0..plan.tracks.tracks[i].rows.len())
}

/// These rows of track `i`, counted from its beginning.
pub fn stretch(plan: &Plan, i: usize, rows: Range<usize>) -> Result<Data, Stop> {
    let (track, begin) = (&plan.tracks.tracks[i], &plan.beginnings[i]);
    let (d, controls) = (plan.model.measures(), plan.model.controls.len());
    let mut data = Data::with_controls(d, controls).starting_at(begin.time);
    let empty = vec![f64::NAN; d];
    let of_track = rows.start + begin.row..rows.end.saturating_add(begin.row);
    for (k, row) in rows.zip(track.rows.read(of_track)?.iter()) {
        // what `start` has read is not used again
        let z = if begin.started && k == 0 { &empty } else { &row.z };
        data.push_controlled(row.time, z, &row.u).map_err(|error: DataError| {
            Stop::input(format!("{}: {error}", failure::place(&plan.data, track, row, row.time)))
        })?;
    }
    Ok(data)
}
