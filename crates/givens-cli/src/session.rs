//! A plan carried out: the method over every track, in packs and on all the threads it may have.

use crate::failure;
use crate::figure::Shown;
use crate::instants::Instants;
use crate::message::Stop;
use crate::plan::Plan;
use crate::portion::portions;
use crate::progress::Progress;
use crate::report::{Gated, Summary};
use core::num::NonZeroUsize;
use givens::batch::Batch;
use givens::metrics::{Accuracy, Consistency};
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
            let finished = outcome.estimates.len();
            let at = failure::Failed { row: *row, error, set_out: &outcome.failed_at, finished };
            self.failures.push(at.told(plan, choice, i, goal));
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

    /// Errors against the truth, of all tracks together and of each state.
    pub fn accuracy(&self, plan: &Plan) -> Option<Accuracy> {
        plan.truth.as_ref()?;
        let accuracies = (0..self.answers.len()).filter_map(|i| {
            let estimates = &self.answers[i].estimates;
            Some(Accuracy::of(estimates, &plan.truth_at(i, self.goals[i], estimates.time.iter().copied())?))
        });
        Accuracy::pooled(accuracies)
    }

    /// The rows beyond the gate.
    pub fn gated(&self) -> Gated {
        let mut gated = Gated::default();
        for (i, answer) in self.answers.iter().enumerate() {
            gated.add(i, answer.row, &answer.estimates);
        }
        gated
    }

    /// What the rows add up to.
    pub fn summary(&self, plan: &Plan) -> Summary {
        Summary {
            rows: self.estimates().map(Estimates::len).sum(),
            log_likelihood: self.log_likelihood(),
            consistency: Consistency::of(self.estimates()),
            gated: self.gated(),
            accuracy: self.accuracy(plan),
        }
    }

    /// What a figure of it shows.
    pub fn shown(&self) -> Vec<Shown<'_>> {
        let one = |i: usize| Shown {
            goal: self.goals[i],
            rows: &self.answers[i].estimates,
            at: self.at.get(i).map(|answer| &answer.estimates),
            counts: None,
        };
        (0..self.answers.len()).map(one).collect()
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
