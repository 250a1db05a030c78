//! A plan carried out: the method over every track, in packs and on all the threads it may have.

use crate::checkpoint::Checkpoint;
use crate::failure;
use crate::figure::Shown;
use crate::instants::Instants;
use crate::message::Stop;
use crate::plan::Plan;
use crate::portion::portions;
use crate::progress::Progress;
use crate::report::{Gated, Summary};
use core::num::NonZeroUsize;
use core::sync::atomic::Ordering;
use givens::batch::Batch;
use givens::metrics::{Accuracy, Consistency, InnovationSums};
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
    /// Whether a report is made, which judges the innovations.
    pub judged: bool,
}

/// What came of a portion of the tracks: answers, those at the times of `--at`, failures, and the innovations so far.
pub type Done = (Vec<Answer>, Vec<Answer>, Vec<String>, Option<InnovationSums>);

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
    /// For a report, if one is made.
    pub innovations: Option<InnovationSums>,
}

impl Session {
    /// Runs `choice` over all tracks; a track that fails does not stop the others.
    pub fn run(plan: &Plan, choice: &Choice, goals: &[Goal], manner: Manner) -> Result<Self, Stop> {
        Self::resume(plan, choice, goals, manner, Vec::new(), None)
    }

    /// The same behind the portions that another run has done; what is `kept` is brought up to date on the way.
    pub fn resume(
        plan: &Plan,
        choice: &Choice,
        goals: &[Goal],
        manner: Manner,
        done: Vec<Done>,
        mut kept: Option<&mut Checkpoint>,
    ) -> Result<Self, Stop> {
        let rows = plan.tracks.tracks.iter().map(|track| track.rows.len()).sum();
        let mut session = Self {
            answers: Vec::new(),
            failures: Vec::new(),
            goals: goals.to_vec(),
            at: Vec::new(),
            innovations: None,
        };
        session.innovations = manner.judged.then(|| InnovationSums::new(plan.model.measures()));
        Progress::new(rows).during(|count| {
            let mut done = done.into_iter();
            for portion in portions(plan, goals) {
                if let Some((answers, at, failures, innovations)) = done.next() {
                    count.fetch_add(
                        answers.iter().map(|answer| answer.estimates.len()).sum(),
                        Ordering::Relaxed,
                    );
                    session.answers.extend(answers);
                    session.at.extend(at);
                    session.failures.extend(failures);
                    session.innovations = innovations;
                    continue;
                }
                let Self { answers, at, failures, .. } = &session;
                let before = (answers.len(), at.len(), failures.len());
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
                if let Some(kept) = &mut kept {
                    let Self { answers, at, failures, .. } = &session;
                    let done =
                        (&answers[before.0..], &at[before.1..], &failures[before.2..], &session.innovations);
                    kept.append(&done)
                        .map_err(|error| Stop::failed(format!("cannot write the output: {error}")))?;
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
        if let Some(sums) = &mut self.innovations {
            sums.add(i, row, &outcome.estimates);
        }
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
