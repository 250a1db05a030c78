//! What is doubtful about answers, in words.

use crate::failure::{explain, place_of};
use crate::message::count;
use crate::plan::Plan;
use givens::registry::Choice;
use givens::{Doubtful, Doubts, Estimates, Gap};
use givens_io::Dynamics;

/// Looks at rows of track `i`, the first of which is its row `from`, and at the times that were asked for besides.
pub fn add(
    doubts: &mut Doubts,
    plan: &Plan,
    choice: &Choice,
    (i, from): (usize, usize),
    est: &Estimates,
    at: &Estimates,
) {
    let begin = &plan.beginnings[i];
    if from == begin.row {
        doubts.begin(i, begin.time, &begin.prior);
    }
    let halved = &mut |gap: &Gap| halved(plan, choice, i, gap);
    doubts.add(i, from, est, halved);
    doubts.ahead(at, halved);
}

/// How far halved steps move the prediction over a gap of track `i`.
fn halved(plan: &Plan, choice: &Choice, i: usize, gap: &Gap) -> Option<f64> {
    let Dynamics::Continuous(model) = &plan.model.dynamics else { return None };
    // a control holds from its row to the next, the first one also before
    let row = gap.row.saturating_sub(1).max(plan.beginnings[i].row);
    let controls = plan.tracks.tracks[i].rows.row(row).ok()??.u;
    choice.halved(model, &plan.model.observation, &controls, &[], gap)
}

/// What is doubtful about the answers of a run.
pub fn all(plan: &Plan, choice: &Choice, found: &[Doubtful]) -> Vec<String> {
    found.iter().map(|found| told(plan, choice, found)).collect()
}

/// A doubt, the place of the row, and how many there are like it.
fn told(plan: &Plan, choice: &Choice, found: &Doubtful) -> String {
    let place = place_of(plan, found.track, found.row, found.time);
    let more = match found.rows {
        1 => String::new(),
        rows => format!(" (the same of {} that were looked at)", count(rows, "row")),
    };
    explain(&plan.model, |explain| format!("{place}: {}{more}", explain.doubt(choice, found)))
}
