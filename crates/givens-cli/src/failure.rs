//! What failed, in the names of the model.

use crate::message::digits;
use givens::explain::{Explain, Face};
use givens::filter::{Fault, StepError};
use givens::registry::Choice;
use givens_io::{Model, Row, Track};

/// Where something failed: the row of a table, and the track and the time.
pub fn place(data: &str, track: &Track, row: &Row, time: f64) -> String {
    let name = track.id.as_ref().map_or(String::new(), |id| format!("track {id}, "));
    format!("{data}:{}: {name}t = {}", row.line, track.time_text(time))
}

/// Why a step failed, by the names of the model; `what` was at work at `place`, by this method if it has one.
pub fn told(model: &Model, place: &str, what: &str, choice: Option<&Choice>, error: &StepError) -> String {
    let states: Vec<&str> = model.states.iter().map(String::as_str).collect();
    let columns = model.sensors.iter().flat_map(|sensor| &sensor.columns);
    let measures: Vec<&str> = columns.map(String::as_str).collect();
    let kind = crate::method::kind(model);
    let explain = Explain { face: Face::Command, kind, states: &states, measures: &measures };
    format!("{place}, step {}: the {what} failed: {}", error.step, explain.told(choice, &error.fault))
}

/// The mean from which a step set out that failed on a number or in a solver; nothing for other faults.
pub fn set_out(model: &Model, mean: &[f64], fault: &Fault) -> String {
    if mean.is_empty() || !matches!(fault, Fault::NotFinite { .. } | Fault::Solver { .. }) {
        return String::new();
    }
    let values = model.states.iter().zip(mean).map(|(name, x)| format!("{name} = {}", digits(*x)));
    format!("\n  the step set out from {}", values.collect::<Vec<_>>().join(", "))
}
