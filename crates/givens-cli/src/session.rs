//! A plan carried out: the method over every track.

use crate::failure;
use crate::instants::Instants;
use crate::message::count;
use crate::plan::Plan;
use crate::progress::Progress;
use givens::metrics::{Accuracy, Truth};
use givens::registry::Choice;
use givens::{Estimates, Goal, Row};
use givens_io::{Answer, Dynamics};

/// What came of a plan.
pub struct Session {
    /// One for each track.
    pub answers: Vec<Answer>,
    /// Tracks that failed, in words.
    pub failures: Vec<String>,
    /// What each track was run for.
    goals: Vec<Goal>,
    /// The answers at the times of `--at`, one for each track; empty without it.
    pub at: Vec<Answer>,
}

impl Session {
    /// Runs `choice` over all tracks; a track that fails does not stop the others.
    pub fn run(plan: &Plan, choice: &Choice, goals: &[Goal], at: Option<&Instants>) -> Self {
        let rows = plan.tracks.tracks.iter().map(|track| track.rows.len()).sum();
        let progress = Progress::new(rows);
        let (mut answers, mut failures, mut there) = (Vec::new(), Vec::new(), Vec::new());
        let empty = vec![f64::NAN; plan.model.measures()];
        let tracks = plan.tracks.tracks.iter().zip(&plan.beginnings).zip(goals).enumerate();
        for (i, ((track, begin), goal)) in tracks {
            let times = at.map_or(Vec::new(), |at| at.of(i));
            let rows = track.rows[begin.row..].iter().enumerate().map(|(k, row)| {
                // what `start` has read is not used again
                let z = if begin.started && k == 0 { &empty } else { &row.z };
                Row { time: row.time, z, u: &row.u }
            });
            let rows = progress.counting(rows);
            let (sensors, t0, prior) = (&plan.model.observation, begin.time, &begin.prior);
            let outcome = match &plan.model.dynamics {
                Dynamics::Discrete(model) => choice.run(model, sensors, rows, t0, prior, *goal, &times),
                Dynamics::Continuous(model) => {
                    choice.run_continuous(model, sensors, rows, t0, prior, *goal, &times)
                }
            };
            if let Some((row, error)) = &outcome.failure {
                let at = &track.rows[begin.row + row];
                let place = failure::place(&plan.data, track, at, error.time);
                let what = if *goal == Goal::Filter { "filter" } else { "smoother" };
                let told = failure::told(&plan.model, &place, what, Some(choice), error);
                let told =
                    format!("{told}{}", failure::set_out(&plan.model, &outcome.failed_at, &error.fault));
                let finished = match outcome.estimates.len() {
                    0 => "no row".to_owned(),
                    rows => count(rows, "row"),
                };
                let of = track.id.as_ref().map_or(String::new(), |id| format!(" of track {id}"));
                failures.push(format!("{told}\n  {finished}{of} finished before"));
            }
            if at.is_some() {
                there.push(Answer { estimates: outcome.at, ..Answer::default() });
            }
            let finished = outcome.estimates;
            let mut row = begin.row;
            let from_first = matches!(goal, Goal::Point(_));
            if from_first {
                // a fixed point has no estimate before its time
                let ran = outcome.failure.as_ref().map_or(track.rows.len() - begin.row, |(row, _)| *row);
                row += ran.saturating_sub(finished.len());
            }
            let started = begin.started && row == begin.row;
            answers.push(Answer { estimates: finished, row, started, from_first });
        }
        progress.finish();
        Self { answers, failures, goals: goals.to_vec(), at: there }
    }

    /// All estimates.
    pub fn estimates(&self) -> impl Iterator<Item = &Estimates> {
        self.answers.iter().map(|answer| &answer.estimates)
    }

    /// Log-likelihood of all tracks.
    pub fn log_likelihood(&self) -> f64 {
        self.estimates().map(Estimates::total_log_likelihood).fold(0.0, core::ops::Add::add)
    }

    /// The truth that the rows of track `i` estimate, NaN where there is none.
    fn truth_at_rows(&self, plan: &Plan, i: usize) -> Option<Truth> {
        self.truth_at(plan, i, self.answers[i].estimates.time.iter().copied())
    }

    /// The truth that the estimates of track `i` at these times are of, NaN where there is none.
    pub fn truth_at(&self, plan: &Plan, i: usize, times: impl Iterator<Item = f64>) -> Option<Truth> {
        let truth = plan.truth.as_ref()?;
        let mut states = Vec::new();
        for t in times {
            // a fixed point is of one time, whatever the row
            let t = if let Goal::Point(t) = self.goals[i] { t } else { t };
            let row = truth.row(i, t);
            let of = |column: &Vec<f64>| row.map_or(f64::NAN, |k| column[k]);
            states.extend(truth.states.iter().map(|column| column.as_ref().map_or(f64::NAN, of)));
        }
        Some(Truth { states })
    }

    /// Errors against the truth, of all tracks together and of each state.
    pub fn accuracy(&self, plan: &Plan) -> Option<Accuracy> {
        plan.truth.as_ref()?;
        let accuracies = (0..self.answers.len())
            .filter_map(|i| Some(Accuracy::of(&self.answers[i].estimates, &self.truth_at_rows(plan, i)?)));
        Accuracy::pooled(accuracies)
    }
}
