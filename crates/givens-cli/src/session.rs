//! A plan carried out: the method over every track, in packs and on all the threads it may have.

use crate::checkpoint::Checkpoint;
use crate::failure;
use crate::figure::Shown;
use crate::instants::Instants;
use crate::message::Stop;
use crate::plan::Plan;
use crate::portion;
use crate::progress::Progress;
use crate::sums::Sums;
use core::num::NonZeroUsize;
use core::ops::{ControlFlow, Range};
use core::sync::atomic::{AtomicUsize, Ordering};
use core::time::Duration;
use givens::batch::Batch;
use givens::registry::Choice;
use givens::{Estimates, Goal, Outcome};
use givens_io::{Answer, Portion, portions};
use std::time::Instant;

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
    /// Where the rows of several tables are counted, in place of a progress of its own.
    pub counted: Option<&'a AtomicUsize>,
}

/// What came of a portion of the tracks: answers, those at the times of `--at`, failures, and the sums so far.
pub type Done = (Vec<Answer>, Vec<Answer>, Vec<String>, Sums);

/// Takes the answers of tracks that follow each other, and those at the times of `--at`.
pub type Take<'a> = &'a mut dyn FnMut(Range<usize>, &[Answer], &[Answer]) -> ControlFlow<()>;

/// What came of a plan.
pub struct Session {
    /// One for each track, if they are held.
    pub answers: Vec<Answer>,
    /// Tracks that failed, in words.
    pub failures: Vec<String>,
    /// What each track was run for.
    goals: Vec<Goal>,
    /// The answers at the times of `--at`, one for each track; empty without it.
    pub at: Vec<Answer>,
    pub sums: Sums,
    /// How long the methods were at work.
    pub took: Duration,
}

impl Session {
    /// Runs `choice` over the tracks behind the portions that another run has done, and holds all answers; what is `kept` is
    /// brought up to date on the way. A track that fails does not stop the others.
    pub fn hold(
        plan: &Plan,
        choice: &Choice,
        goals: &[Goal],
        manner: Manner,
        done: Vec<Done>,
        mut kept: Option<&mut Checkpoint>,
    ) -> Result<Self, Stop> {
        let mut session = Self::new(plan, choice, goals, manner);
        shown(rows(plan), manner, |count| {
            let mut done = done.into_iter();
            for portion in portions(&plan.tracks.tracks, |i| goals[i]) {
                if let Some((answers, at, failures, sums)) = done.next() {
                    let rows = answers.iter().map(|answer| answer.estimates.len()).sum();
                    count.fetch_add(rows, Ordering::Relaxed);
                    session.answers.extend(answers);
                    session.at.extend(at);
                    session.failures.extend(failures);
                    session.sums = sums;
                    continue;
                }
                let Self { answers, at, failures, .. } = &session;
                let before = (answers.len(), at.len(), failures.len());
                session.portion(plan, choice, portion, manner, count)?;
                if let Some(kept) = &mut kept {
                    let Self { answers, at, failures, sums, .. } = &session;
                    let done = (&answers[before.0..], &at[before.1..], &failures[before.2..], sums);
                    kept.append(&done)
                        .map_err(|error| Stop::failed(format!("cannot write the output: {error}")))?;
                }
            }
            Ok::<(), Stop>(())
        })?;
        Ok(session)
    }

    /// Runs `choice` over all tracks, with the answers of a portion of them handed over as soon as they are there, and not held.
    pub fn hand_over(
        plan: &Plan,
        choice: &Choice,
        goals: &[Goal],
        manner: Manner,
        take: Take,
    ) -> Result<Self, Stop> {
        let mut session = Self::new(plan, choice, goals, manner);
        shown(rows(plan), manner, |count| {
            for portion in portions(&plan.tracks.tracks, |i| goals[i]) {
                let tracks = portion.tracks.clone();
                session.portion(plan, choice, portion, manner, count)?;
                let [answers, at] = [&mut session.answers, &mut session.at].map(core::mem::take);
                if take(tracks, &answers, &at).is_break() {
                    break;
                }
            }
            Ok::<(), Stop>(())
        })?;
        Ok(session)
    }

    fn new(plan: &Plan, choice: &Choice, goals: &[Goal], manner: Manner) -> Self {
        Self {
            answers: Vec::new(),
            failures: Vec::new(),
            goals: goals.to_vec(),
            at: Vec::new(),
            sums: Sums::new(plan, choice, manner.judged),
            took: Duration::ZERO,
        }
    }

    /// Runs some of the tracks, and takes in what comes of them.
    fn portion(
        &mut self,
        plan: &Plan,
        choice: &Choice,
        portion: Portion,
        manner: Manner,
        count: &AtomicUsize,
    ) -> Result<(), Stop> {
        let Manner { at, threads, .. } = manner;
        let batch = Batch { goal: portion.goal, threads, rows: Some(count), ..Batch::default() };
        let begun = Instant::now();
        let outcomes = portion::run(&portion, plan, choice, &batch, at)?;
        self.took += begun.elapsed();
        let mut outcomes = outcomes.into_iter().peekable();
        for i in portion.tracks {
            match outcomes.next_if(|(track, _)| *track == i) {
                Some((_, outcome)) => self.take(plan, choice, i, outcome, manner),
                None => self.unbegun(plan, i, manner),
            }
        }
        Ok(())
    }

    /// Track `i` cannot begin, and has no row.
    fn unbegun(&mut self, plan: &Plan, i: usize, manner: Manner) {
        self.failures.extend(plan.unbegun.get(&i).cloned());
        self.answers.push(Answer::default());
        if manner.at.is_some() {
            self.at.push(Answer::default());
        }
    }

    /// Takes in what came of track `i`.
    fn take(&mut self, plan: &Plan, choice: &Choice, i: usize, outcome: Outcome, manner: Manner) {
        let (track, begin, goal) = (&plan.tracks.tracks[i], &plan.beginnings[i], self.goals[i]);
        if let Some((row, error)) = &outcome.failure {
            let finished = outcome.estimates.len();
            let at = failure::Failed { row: *row, error, set_out: &outcome.failed_at, finished };
            self.failures.push(at.told(plan, choice, i, goal));
        }
        let mut row = begin.row;
        let from_first = matches!(goal, Goal::Point(_));
        if from_first {
            // a fixed point has no estimate before its time
            let ran = outcome.failure.as_ref().map_or(track.rows.len() - begin.row, |(row, _)| *row);
            row += ran.saturating_sub(outcome.estimates.len());
        }
        let started = begin.started && row == begin.row;
        self.sums.add(plan, choice, (i, row), goal, &outcome.estimates, &outcome.at);
        if manner.at.is_some() {
            let estimates = kept(outcome.at, manner.whole);
            self.at.push(Answer { estimates, ..Answer::default() });
        }
        let estimates = kept(outcome.estimates, manner.whole);
        self.answers.push(Answer { estimates, row, started, from_first });
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

/// Does work that counts its rows, and shows how many there are, unless they are counted elsewhere.
pub fn shown<T>(rows: usize, manner: Manner, work: impl FnOnce(&AtomicUsize) -> T) -> T {
    match manner.counted {
        Some(count) => work(count),
        None => Progress::new(rows).during(work),
    }
}

fn rows(plan: &Plan) -> usize {
    plan.tracks.tracks.iter().map(|track| track.rows.len()).sum()
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
