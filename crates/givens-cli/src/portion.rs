//! Portions of the tracks of a plan, run.

use crate::failure;
use crate::instants::Instants;
use crate::message::Stop;
use crate::plan::Plan;
use core::ops::Range;
use givens::batch::{Batch, Track};
use givens::registry::Choice;
use givens::{Data, Outcome};
use givens_io::{Beginning, Dynamics, Portion, Unread};

/// What comes of those tracks of a portion that begin.
pub fn run(
    portion: &Portion,
    plan: &Plan,
    choice: &Choice,
    batch: &Batch,
    at: Option<&Instants>,
) -> Result<Vec<(usize, Outcome)>, Stop> {
    let sensors = &plan.model.observation;
    let begin: Vec<usize> = portion.tracks.clone().filter(|i| !plan.unbegun.contains_key(i)).collect();
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
    track.data((plan.model.measures(), plan.model.controls.len()), begin, rows).map_err(|unread| match unread
    {
        Unread::Lost(error) => error.into(),
        Unread::Wrong(row, error) => {
            Stop::input(format!("{}: {error}", failure::place(&plan.data, track, &row, row.time)))
        }
    })
}
