//! What is doubtful about answers, for the Python half to warn of.

use givens::explain::Told;
use givens::registry::Choice;
use givens::{Doubtful, Doubts, Gap, Outcome};
use pyo3::exceptions::PyException;
use pyo3::prelude::*;

use core::cell::Cell;
use core::time::Duration;
use std::time::Instant;

use crate::errors::Result;
use crate::failure::explained;
use crate::model::Moves;
use crate::run::Job;
use crate::watch::{detached, go_on};

/// Track, row, time, what is doubtful, how many rows are for that reason, and whether it is grave.
pub type Doubt = (usize, usize, f64, String, usize, bool);

thread_local! {
    /// How long this thread has looked for doubts.
    static SPENT: Cell<Duration> = const { Cell::new(Duration::ZERO) };
}

/// Seconds that this thread has looked for doubts since it was last asked; see the stub.
#[pyfunction]
pub fn looked_for() -> f64 {
    SPENT.take().as_secs_f64()
}

/// What is doubtful about the outcomes of jobs.
pub fn of(py: Python<'_>, jobs: &[Job], outcomes: &[Outcome]) -> Result<Vec<Doubt>> {
    let begun = Instant::now();
    let found = all(py, jobs, outcomes);
    SPENT.set(SPENT.get() + begun.elapsed());
    found
}

fn all(py: Python<'_>, jobs: &[Job], outcomes: &[Outcome]) -> Result<Vec<Doubt>> {
    let mut all: Vec<(Choice, Doubts)> = Vec::new();
    for (track, (job, outcome)) in jobs.iter().zip(outcomes).enumerate() {
        let known = all.iter().position(|(choice, _)| *choice == job.choice);
        let at = known.unwrap_or(all.len());
        if known.is_none() {
            all.push((job.choice, Doubts::new(&job.choice)));
        }
        let doubts = &mut all[at].1;
        let ((), raised) = detached(py, || look(doubts, track, job, outcome));
        // what a function of the user's says to other steps than those of the run is nothing to the run
        if let Some(raised) = raised.filter(|raised| !raised.is_instance_of::<PyException>(py)) {
            return Err(raised.into());
        }
    }
    let told = |(choice, doubts): &(Choice, Doubts)| -> Vec<Doubt> {
        doubts.found().map(|found| told(&jobs[found.track], choice, found)).collect()
    };
    Ok(all.iter().flat_map(told).collect())
}

fn look(doubts: &mut Doubts, track: usize, job: &Job, outcome: &Outcome) {
    let Job { model, choice, prior, data, .. } = job;
    let ran = outcome.failure.as_ref().map_or(data.len(), |(row, _)| *row);
    // a fixed point has no estimate before its time
    let first = ran.saturating_sub(outcome.estimates.len());
    if first == 0 {
        doubts.begin(track, data.start(), prior);
    }
    let halved = &mut |gap: &Gap| {
        let Moves::Continuous(moves) = &model.moves else { return None };
        // a control holds from its row to the next, the first one also before
        let controls = data.row(gap.row.saturating_sub(1))?.u;
        // what a function of the user's raises at other times than those of the run says nothing
        choice.halved(moves, &model.sensing, controls, &[], gap).filter(|_| go_on())
    };
    doubts.add(track, first, &outcome.estimates, halved);
    doubts.ahead(&outcome.at, halved);
}

fn told(job: &Job, choice: &Choice, found: &Doubtful) -> Doubt {
    let Told { what, remedy, .. } = explained(&job.model, |explain| explain.doubt(choice, found));
    let message = remedy.map_or_else(|| what.clone(), |remedy| format!("{what}; {remedy}"));
    (found.track, found.row, found.time, message, found.rows, found.doubt.is_grave())
}
