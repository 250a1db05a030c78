//! A plan carried out: the method over every track, in packs and on all the threads it may have.

use crate::failure;
use crate::instants::Instants;
use crate::message::{Stop, count};
use crate::plan::Plan;
use crate::portion::portions;
use crate::progress::Progress;
use core::num::NonZeroUsize;
use givens::batch::Batch;
use givens::metrics::{Accuracy, Truth};
use givens::registry::Choice;
use givens::{Estimates, Goal, Outcome};
use givens_io::Answer;

/// How a plan is carried out.
#[derive(Clone, Copy)]
pub struct Manner<'a> {
    /// The times of `--at`.
    pub at: Option<&'a Instants>,
    /// All cores where it is not said.
    pub threads: Option<NonZeroUsize>,
    /// Whether the predictions, the innovations and the filtered covariances of a smoother are kept too.
    pub whole: bool,
}

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
    pub fn run(plan: &Plan, choice: &Choice, goals: &[Goal], manner: Manner) -> Result<Self, Stop> {
        let rows = plan.tracks.tracks.iter().map(|track| track.rows.len()).sum();
        let mut session =
            Self { answers: Vec::new(), failures: Vec::new(), goals: goals.to_vec(), at: Vec::new() };
        Progress::new(rows).during(|count| {
            for portion in portions(plan, goals) {
                let batch = Batch {
                    goal: portion.goal,
                    threads: manner.threads,
                    rows: Some(count),
                    ..Batch::default()
                };
                let outcomes = portion.run(plan, choice, &batch, manner.at)?;
                for (i, outcome) in portion.tracks.zip(outcomes) {
                    session.take(plan, choice, i, outcome, manner);
                }
            }
            Ok::<(), Stop>(())
        })?;
        Ok(session)
    }

    /// Takes in what came of track `i`.
    fn take(&mut self, plan: &Plan, choice: &Choice, i: usize, outcome: Outcome, manner: Manner) {
        let (track, begin, goal) = (&plan.tracks.tracks[i], &plan.beginnings[i], self.goals[i]);
        if let Some((row, error)) = &outcome.failure {
            let at = &track.rows[begin.row + row];
            let place = failure::place(&plan.data, track, at, error.time);
            let what = if goal == Goal::Filter { "filter" } else { "smoother" };
            let told = failure::told(&plan.model, &place, what, Some(choice), error);
            let set_out = failure::set_out(&plan.model, &outcome.failed_at, &error.fault);
            let finished = match outcome.estimates.len() {
                0 => "no row".to_owned(),
                rows => count(rows, "row"),
            };
            let of = track.id.as_ref().map_or(String::new(), |id| format!(" of track {id}"));
            self.failures.push(format!("{told}{set_out}\n  {finished}{of} finished before"));
        }
        if manner.at.is_some() {
            let estimates = kept(outcome.at, manner.whole);
            self.at.push(Answer { estimates, ..Answer::default() });
        }
        let mut row = begin.row;
        let from_first = matches!(goal, Goal::Point(_));
        if from_first {
            // a fixed point has no estimate before its time
            let ran = outcome.failure.as_ref().map_or(track.rows.len() - begin.row, |(row, _)| *row);
            row += ran.saturating_sub(outcome.estimates.len());
        }
        let started = begin.started && row == begin.row;
        let estimates = kept(outcome.estimates, manner.whole);
        self.answers.push(Answer { estimates, row, started, from_first });
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

/// Leaves the numbers that the command goes on to use; without the `whole` of them those of a CSV, a figure and a verdict.
fn kept(mut estimates: Estimates, whole: bool) -> Estimates {
    estimates.factor = Vec::new();
    if !whole {
        estimates.filtered_cov = Vec::new();
        estimates.predicted_mean = Vec::new();
        estimates.predicted_cov = Vec::new();
        estimates.innovation = Vec::new();
        estimates.innovation_cov = Vec::new();
    }
    estimates
}
