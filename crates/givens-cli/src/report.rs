//! What stderr says at the end: how much was done, how likely it was, how right.

use crate::doubts;
use crate::message::{count, digits, doubt, say};
use crate::plan::Plan;
use givens::metrics::{Accuracy, Consistency};
use givens::scalar::Shown;
use givens::{Doubtful, Estimates};
use givens_io::Model;
use serde::{Deserialize, Serialize};

/// What the rows of a run add up to.
pub struct Summary {
    pub rows: usize,
    pub log_likelihood: f64,
    pub consistency: Consistency,
    pub gated: Gated,
    /// What is doubtful about the answers.
    pub doubts: Vec<Doubtful>,
    /// Against a truth, if there is one.
    pub accuracy: Option<Accuracy>,
}

/// Rows beyond the gate.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Gated {
    count: usize,
    /// The first of them: track, and row of it.
    first: Vec<(usize, usize)>,
}

impl Gated {
    /// So many are named.
    const NAMED: usize = 8;

    /// Adds those of the estimates of a track, the first of which is of its row `from`.
    pub fn add(&mut self, track: usize, from: usize, est: &Estimates) {
        for (k, _) in est.gated.iter().enumerate().filter(|(_, gated)| **gated) {
            self.count += 1;
            if self.first.len() < Self::NAMED {
                self.first.push((track, from + k));
            }
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The same in words, and where they are, if there is a gate.
    fn told(&self, plan: &Plan, rows: usize) -> Option<String> {
        let gate = plan.choice.gate?;
        let places = self.first.iter().map(|&(i, k)| {
            let track = &plan.tracks.tracks[i];
            let name = track.id.as_ref().map_or(String::new(), |id| format!("track {id}, "));
            match track.rows.row(k) {
                Ok(Some(row)) => {
                    format!("{}:{} ({name}t = {})", plan.data, row.line, track.time_text(row.time))
                }
                _ => format!("{} ({name}row {})", plan.data, k + 1),
            }
        });
        let named = match places.collect::<Vec<_>>() {
            none if none.is_empty() => String::new(),
            places => format!(", not taken in: {}", places.join(", ")),
        };
        let more = match self.count - self.first.len() {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let rows = count(rows, "row");
        Some(format!("{} of {rows} beyond the gate ({}){named}{more}", self.count, Shown(gate)))
    }
}

/// The closing lines of a run.
pub fn closing(plan: &Plan, summary: &Summary) {
    let tracks = plan.tracks.tracks.len();
    let of = if tracks == 1 { String::new() } else { format!(" of {tracks} tracks") };
    let (title, counted) = (plan.choice.title(), count(summary.rows, "row"));
    if summary.rows == 0 {
        say(&format!("{title}: no row{of} was finished"));
        return;
    }
    let Summary { log_likelihood, consistency, .. } = summary;
    say(&format!("{title}: {counted}{of}, log-likelihood {:.3}, {consistency}", Shown(*log_likelihood)));
    if let Some(told) = summary.gated.told(plan, summary.rows) {
        say(&told);
    }
    doubt(&doubts::all(plan, &plan.choice, &summary.doubts));
    if let Some(accuracy) = &summary.accuracy {
        for line in accuracy_lines(&plan.model, accuracy) {
            say(&line);
        }
    }
}

/// RMSE, coverage and NEES, a line for each state.
fn accuracy_lines(model: &Model, accuracy: &Accuracy) -> Vec<String> {
    let width = model.states.iter().map(|name| name.chars().count()).max().unwrap_or(0).max(5);
    let mut lines = vec![format!(
        "against the truth:\n  {:width$} {:>12} {:>12} {:>8}",
        "state", "RMSE", "within 2σ", "rows"
    )];
    for (i, name) in model.states.iter().enumerate() {
        if accuracy.rows[i] > 0 {
            let percent = 100.0 * accuracy.coverage[i];
            lines.push(format!(
                "  {name:width$} {:>12} {percent:>10.1} % {:>8}",
                digits(accuracy.rmse[i]),
                accuracy.rows[i]
            ));
        }
    }
    if accuracy.rows.iter().all(|&rows| rows == 0) {
        lines.push("  the truth has no value at the rows that were finished".into());
    } else {
        let per = Shown(accuracy.nees / accuracy.nees_dof);
        lines.push(format!(
            "  mean NEES {:.3} of {:.1} states known, {per:.3} per state (1 if the covariances are right; 2σ holds 95.4 %)",
            Shown(accuracy.nees),
            accuracy.nees_dof
        ));
    }
    lines
}
