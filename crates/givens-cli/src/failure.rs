//! What failed, in the names of the model.

use crate::message::{count, digits};
use crate::plan::Plan;
use givens::Goal;
use givens::explain::{Explain, Face};
use givens::filter::{Fault, StepError};
use givens::registry::Choice;
use givens_io::{Model, Row, Track};

/// Where something failed: the row of a table, and the track and the time.
pub fn place(data: &str, track: &Track, row: &Row, time: f64) -> String {
    let name = track.id.as_ref().map_or(String::new(), |id| format!("track {id}, "));
    format!("{data}:{}: {name}t = {}", row.line, track.time_text(time))
}

/// The same of row `k` of track `i`; without its line, if it cannot be read any more.
pub fn place_of(plan: &Plan, i: usize, k: usize, time: f64) -> String {
    let track = &plan.tracks.tracks[i];
    match track.rows.row(k) {
        Ok(Some(row)) => place(&plan.data, track, &row, time),
        _ => format!("{}: row {}, t = {}", plan.data, k + 1, track.time_text(time)),
    }
}

/// Why a step failed, by the names of the model; `what` was at work at `place`, by this method if it has one.
pub fn told(model: &Model, place: &str, what: &str, choice: Option<&Choice>, error: &StepError) -> String {
    explain(model, |explain| format!("{place}: the {what} failed: {}", explain.told(choice, &error.fault)))
}

/// Says something in the names of the model.
pub fn explain(model: &Model, say: impl FnOnce(&Explain) -> String) -> String {
    let states: Vec<&str> = model.states.iter().map(String::as_str).collect();
    let columns = model.sensors.iter().flat_map(|sensor| &sensor.columns);
    let measures: Vec<&str> = columns.map(String::as_str).collect();
    let kind = crate::method::kind(model);
    say(&Explain { face: Face::Command, kind, states: &states, measures: &measures })
}

/// The mean from which a step set out that failed on a number or in a solver; nothing for other faults.
fn set_out(model: &Model, mean: &[f64], fault: &Fault) -> String {
    if mean.is_empty() || !matches!(fault, Fault::NotFinite { .. } | Fault::Solver { .. }) {
        return String::new();
    }
    let values = model.states.iter().zip(mean).map(|(name, x)| format!("{name} = {}", digits(*x)));
    format!("\n  the step set out from {}", values.collect::<Vec<_>>().join(", "))
}

/// A step that failed on the way over a track.
pub struct Failed<'f> {
    /// The row behind which nothing was finished, counted from where the track begins.
    pub row: usize,
    pub error: &'f StepError,
    /// The mean from which it set out, if it began.
    pub set_out: &'f [f64],
    /// Rows with an estimate.
    pub finished: usize,
}

impl Failed<'_> {
    /// All of it in words, of track `i`.
    pub fn told(&self, plan: &Plan, choice: &Choice, i: usize, goal: Goal) -> String {
        let (track, begin) = (&plan.tracks.tracks[i], &plan.beginnings[i]);
        let row = begin.row + self.row;
        let place = format!("{}, step {}", place_of(plan, i, row, self.error.time), row + 1);
        let what = if goal == Goal::Filter { "filter" } else { "smoother" };
        let told = told(&plan.model, &place, what, Some(choice), self.error);
        let set_out = set_out(&plan.model, self.set_out, &self.error.fault);
        let finished = match self.finished {
            0 => "no row".to_owned(),
            rows => count(rows, "row"),
        };
        let of = track.id.as_ref().map_or(String::new(), |id| format!(" of track {id}"));
        format!("{told}{set_out}\n  {finished}{of} finished before")
    }
}
