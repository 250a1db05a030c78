//! A plan of one track carried out: its rows are written as they are finished, and memory does not grow with them.

use crate::checkpoint::Checkpoint;
use crate::failure::Failed;
use crate::figure::Shown;
use crate::files::Output;
use crate::instants::Instants;
use crate::message::{Stop, say};
use crate::plan::Plan;
use crate::session::{Manner, shown};
use crate::sums::Sums;
use crate::thin::Thinned;
use crate::trajectory::Trajectory;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use givens::batch::Track;
use givens::{Estimates, Finished, Goal, Mark, Sink, Source, Stream};
use givens_io::{AnswerWriter, Answers, Dynamics, Format, Layout, Part, Tracks, Written};
use serde::{Deserialize, Serialize};
use std::io::{self, ErrorKind, Write};

/// The records of a smoother may take so much memory; where they would take more, it goes over its rows three times.
const MEMORY: usize = 128 << 20;
/// A run that may be broken off holds so many rows at once, and a smoother as many for each thread: it begins again with them.
const KEPT: usize = 1024;

/// A run over one track.
pub struct Streaming<'p> {
    plan: &'p Plan,
    goal: Goal,
    manner: Manner<'p>,
    at: Option<&'p Instants>,
    writer: AnswerWriter<'p>,
    come: Come,
    failure: Option<String>,
    stop: Option<Stop>,
}

/// Of all rows so far.
#[derive(Clone, Default, Serialize, Deserialize)]
struct Come {
    /// What stands in the output: whether any row of the table, and how many times of `--at`.
    written: (bool, usize),
    /// What figures are drawn through, if any are.
    thinned: Option<(Thinned, Estimates)>,
    sums: Sums,
}

/// What a checkpoint keeps: the output, what was found, and how far the stream has come.
#[derive(Serialize, Deserialize)]
pub struct Stand {
    pub output: Written,
    come: Come,
    marks: Vec<Mark>,
}

impl<'p> Streaming<'p> {
    /// Ready to run; `drawn` if its figure will be.
    pub fn new(
        plan: &'p Plan,
        goal: Goal,
        manner: Manner<'p>,
        (format, layout): (Format, Layout),
        drawn: bool,
    ) -> Result<Self, Stop> {
        let (rows, begin) = (&plan.tracks.tracks[0].rows, &plan.beginnings[0]);
        let mut thinned = None;
        if drawn {
            let mut measured = 0;
            // what `start` has read is not used again
            for row in rows.iter().skip(begin.row + usize::from(begin.started)) {
                measured += usize::from(row?.measured());
            }
            thinned = Some((Thinned::new(rows.len() - begin.row, measured), Estimates::default()));
        }
        let (smoothed, threads) = (goal != Goal::Filter, manner.threads);
        let (tracks, gated) = (&plan.tracks, plan.choice.gate.is_some());
        let writer = AnswerWriter { format, layout, tracks, smoothed, gated, threads };
        let come = Come { thinned, sums: Sums::new(plan, &plan.choice, manner.judged), ..Come::default() };
        Ok(Self { plan, goal, manner, at: manner.at, writer, come, failure: None, stop: None })
    }

    /// Runs, from where another run stands if one does, and writes the answers; what is `kept` is brought up to date on the way.
    ///
    /// # Errors
    /// What the writer says. If nobody reads any more the run goes on, for what is told and drawn of it.
    pub fn run(
        &mut self,
        out: &mut dyn Output,
        from: Option<Stand>,
        kept: Option<&mut Checkpoint>,
    ) -> io::Result<()> {
        let plan = self.plan;
        let (n, d) = (plan.model.states.len(), plan.model.measures());
        let data = Trajectory::new(plan);
        let hold = self.hold(n, d, data.len(), kept.is_some());
        let at = self.at.map_or(Vec::new(), |at| at.of(0));
        let tracks = self.at.map(|at| at.tracks(plan));
        let mut marks = Vec::new();
        let writer = AnswerWriter { tracks: tracks.as_ref().unwrap_or(&plan.tracks), ..self.writer };
        let mut answers = match from {
            Some(stand) => {
                (self.come, marks) = (stand.come, stand.marks);
                writer.behind()
            }
            None => writer.begin(out)?,
        };
        let (model, sensors, prior) = (&plan.model, &plan.model.observation, &plan.beginnings[0].prior);
        let (goal, threads, manner) = (self.goal, self.writer.threads, self.manner);
        let mut desk = Desk {
            run: self,
            out,
            answers: &mut answers,
            tracks: tracks.as_ref(),
            kept,
            marks: marks.clone(),
            done: Ok(()),
        };
        let ended = shown(data.len(), manner, |count| {
            let by = Stream { goal, hold, threads, cancel: None, rows: Some(count), from: &marks };
            match &model.dynamics {
                Dynamics::Discrete(model) => {
                    let track = Track { at: &at, ..Track::new(model, sensors, &data, prior) };
                    plan.choice.stream(&track, &by, &mut desk)
                }
                Dynamics::Continuous(model) => {
                    let track = Track { at: &at, ..Track::new(model, sensors, &data, prior) };
                    plan.choice.stream_continuous(&track, &by, &mut desk)
                }
            }
        });
        let mut done = desk.done;
        self.stop = data.stop();
        if let Some((row, error)) = &ended.failure {
            let failed =
                Failed { row: *row, error, set_out: &ended.failed_at, finished: self.come.sums.rows };
            self.failure = Some(failed.told(plan, &plan.choice, 0, self.goal));
        }
        if self.come.sums.rows == 0 && done.is_ok() {
            // the rows before the belief holds have their empty lines all the same
            let nothing = Estimates::default();
            let none = Finished { first: 0, estimates: &nothing, at: &nothing };
            done = self.write(&mut answers, out, &none, tracks.as_ref());
        }
        done.and_then(|()| answers.end(out))
    }

    /// How many of its rows a run of n states and d measures holds at once.
    fn hold(&self, n: usize, d: usize, rows: usize, is_kept: bool) -> usize {
        let bytes = Stream::bytes_per_row(self.goal, n, d);
        let hold = (MEMORY / bytes).max(64);
        if self.goal == Goal::Interval && rows > hold {
            say(&format!(
                "{rows} rows are smoothed in segments, three times over the data: at once they would take {} of memory",
                size(bytes.saturating_mul(rows))
            ));
        }
        let cores = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let together = match self.goal {
            Goal::Interval => KEPT * (1 + self.writer.threads.map_or_else(cores, NonZeroUsize::get)),
            _ => KEPT,
        };
        if is_kept { hold.min(together) } else { hold }
    }

    fn write(
        &mut self,
        answers: &mut Answers,
        out: &mut dyn Write,
        finished: &Finished,
        at: Option<&Tracks>,
    ) -> io::Result<()> {
        let (begun, times) = self.come.written;
        if let Some(tracks) = at {
            let part = Part {
                track: &tracks.tracks[0],
                from: times,
                row: times,
                started: false,
                estimates: finished.at,
            };
            self.come.written.1 += finished.at.len();
            return answers.rows(out, &[part]);
        }
        let begin = &self.plan.beginnings[0];
        let row = begin.row + finished.first;
        let is_point = matches!(self.goal, Goal::Point(_));
        let from = if begun || is_point { row } else { 0 };
        self.come.written.0 |= !finished.estimates.is_empty();
        let started = begin.started && row == begin.row;
        let (track, nothing) = (&self.plan.tracks.tracks[0], Estimates::default());
        // the rows before the belief holds may be many
        let mut empty = (from..row).step_by(KEPT).map(|from| (from, (from + KEPT).min(row)));
        empty.try_for_each(|(from, row)| {
            answers.rows(out, &[Part { track, from, row, started: false, estimates: &nothing }])
        })?;
        answers.rows(out, &[Part { track, from: row, row, started, estimates: finished.estimates }])
    }

    /// Adds rows to what is told of them, and drawn.
    fn add(&mut self, finished: &Finished) {
        let Finished { first, estimates: est, at } = *finished;
        let from = self.plan.beginnings[0].row + first;
        let truth = self.come.sums.add(self.plan, &self.plan.choice, (0, from), self.goal, est, at);
        if let Some((rows, times)) = &mut self.come.thinned {
            rows.add(est, truth.as_ref());
            for row in 0..at.len() {
                let kept = times.push(at, row);
                debug_assert!(kept, "rows of one run");
            }
        }
    }

    /// What the rows add up to.
    pub fn sums(&self) -> &Sums {
        &self.come.sums
    }

    /// What a figure of it shows.
    pub fn shown(&self) -> Option<Shown<'_>> {
        let (rows, at) = self.come.thinned.as_ref()?;
        let (goal, at) = (self.goal, self.at.map(|_| at));
        Some(Shown { goal, rows: &rows.kept, at, counts: rows.counts() })
    }

    /// Why it ended before its rows did, if they could not be read.
    pub fn stop(&mut self) -> Option<Stop> {
        self.stop.take()
    }

    /// The failure that ended it, in words.
    pub fn failure(&self) -> Option<&String> {
        self.failure.as_ref()
    }
}

/// Where the rows of a run are taken in.
struct Desk<'d, 'p, 'a> {
    run: &'d mut Streaming<'p>,
    out: &'d mut dyn Output,
    answers: &'d mut Answers<'a>,
    tracks: Option<&'d Tracks>,
    kept: Option<&'d mut Checkpoint>,
    marks: Vec<Mark>,
    done: io::Result<()>,
}

impl Sink for Desk<'_, '_, '_> {
    fn take(&mut self, finished: Finished) -> ControlFlow<()> {
        self.run.add(&finished);
        if self.done.is_ok() {
            self.done = self.run.write(self.answers, self.out, &finished, self.tracks);
        }
        match &self.done {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    }

    fn mark(&mut self, mark: Mark) {
        let Some(kept) = &mut self.kept else { return };
        if mark.is_enough() {
            self.marks.clear();
        }
        self.marks.push(mark);
        if self.done.is_ok() && kept.is_due() {
            let (come, marks) = (self.run.come.clone(), self.marks.clone());
            self.done = self.out.settle().and_then(|output| kept.replace(&Stand { output, come, marks }));
        }
    }
}

/// Bytes, to two digits.
fn size(bytes: usize) -> String {
    match bytes as f64 {
        bytes if bytes >= 1e9 => format!("{:.1} GB", bytes / 1e9),
        bytes => format!("{:.0} MB", bytes / 1e6),
    }
}
