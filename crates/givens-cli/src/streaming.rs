//! A plan of one track carried out: its rows are written as they are finished, and memory does not grow with them.

use crate::failure::Failed;
use crate::figure::Shown;
use crate::instants::Instants;
use crate::message::{Stop, say};
use crate::plan::Plan;
use crate::portion;
use crate::progress::Progress;
use crate::report::{Gated, Summary};
use crate::session::Manner;
use crate::thin::Thinned;
use core::ops::ControlFlow;
use givens::batch::Track;
use givens::metrics::{AccuracySums, ConsistencySums};
use givens::{Data, Estimates, Finished, Goal, Stream};
use givens_io::{AnswerWriter, Dynamics, Format, Part};
use std::io::{self, ErrorKind, Write};

/// The records of a smoother may take so much memory; where they would take more, it goes over its rows three times.
const MEMORY: usize = 128 << 20;

/// A run over one track.
pub struct Streaming<'p> {
    plan: &'p Plan,
    goal: Goal,
    at: Option<&'p Instants>,
    data: Data,
    writer: AnswerWriter<'p>,
    /// What figures are drawn through, if any are.
    thinned: Option<(Thinned, Estimates)>,
    /// What stands in the output so far: rows of the table, and times of `--at`.
    written: (bool, usize),
    sums: Sums,
    accuracy: Option<AccuracySums>,
    failure: Option<String>,
}

/// Of all rows.
#[derive(Default)]
struct Sums {
    rows: usize,
    log_likelihood: f64,
    consistency: ConsistencySums,
    gated: Gated,
}

impl<'p> Streaming<'p> {
    /// Ready to run; `drawn` if its figure will be.
    pub fn new(
        plan: &'p Plan,
        goal: Goal,
        manner: Manner<'p>,
        format: Format,
        drawn: bool,
    ) -> Result<Self, Stop> {
        let data = portion::data(plan, 0)?;
        let measured = data.rows().filter(|row| row.z.iter().any(|z| !z.is_nan())).count();
        let thinned = drawn.then(|| (Thinned::new(data.len(), measured), Estimates::default()));
        let accuracy = plan.truth.as_ref().map(|_| AccuracySums::new(plan.model.states.len()));
        let (smoothed, threads) = (goal != Goal::Filter, manner.threads);
        let (model, tracks, gated) = (&plan.model, &plan.tracks, plan.choice.gate.is_some());
        let writer = AnswerWriter { format, model, tracks, smoothed, gated, threads };
        let (written, sums) = ((false, 0), Sums::default());
        Ok(Self { plan, goal, at: manner.at, data, writer, thinned, written, sums, accuracy, failure: None })
    }

    /// Runs, and writes the answers.
    ///
    /// # Errors
    /// What the writer says. If nobody reads any more the run goes on, for what is told and drawn of it.
    pub fn run(&mut self, out: &mut dyn Write) -> io::Result<()> {
        let plan = self.plan;
        let (n, d) = (plan.model.states.len(), plan.model.measures());
        let data = core::mem::replace(&mut self.data, Data::new(0));
        let bytes = Stream::bytes_per_row(self.goal, n, d);
        let hold = (MEMORY / bytes).max(64);
        if self.goal == Goal::Interval && data.len() > hold {
            say(&format!(
                "{} rows are smoothed in segments, three times over the data: at once they would take {} of memory",
                data.len(),
                size(bytes.saturating_mul(data.len()))
            ));
        }
        let at = self.at.map_or(Vec::new(), |at| at.of(0));
        let tracks = self.at.map(|at| at.tracks(plan));
        AnswerWriter { tracks: tracks.as_ref().unwrap_or(&plan.tracks), ..self.writer }.header(out)?;
        let (model, sensors, prior) = (&plan.model, &plan.model.observation, &plan.beginnings[0].prior);
        let mut done = Ok(());
        let mut finished_rows = 0;
        let ended = Progress::new(data.len()).during(|count| {
            let threads = self.writer.threads;
            let by = Stream { goal: self.goal, hold, threads, cancel: None, rows: Some(count) };
            let mut sink = |finished: Finished| {
                finished_rows += finished.estimates.len();
                self.add(&finished);
                if done.is_ok() {
                    done = self.write(out, &finished, tracks.as_ref());
                }
                match &done {
                    Err(error) if error.kind() != ErrorKind::BrokenPipe => ControlFlow::Break(()),
                    _ => ControlFlow::Continue(()),
                }
            };
            match &model.dynamics {
                Dynamics::Discrete(model) => {
                    let track = Track { at: &at, ..Track::new(model, sensors, &data, prior) };
                    plan.choice.stream(&track, &by, &mut sink)
                }
                Dynamics::Continuous(model) => {
                    let track = Track { at: &at, ..Track::new(model, sensors, &data, prior) };
                    plan.choice.stream_continuous(&track, &by, &mut sink)
                }
            }
        });
        if let Some((row, error)) = &ended.failure {
            let failed = Failed { row: *row, error, set_out: &ended.failed_at, finished: finished_rows };
            self.failure = Some(failed.told(plan, &plan.choice, 0, self.goal));
        }
        if finished_rows == 0 && done.is_ok() {
            // the rows before the belief holds have their empty lines all the same
            let nothing = Estimates::default();
            done =
                self.write(out, &Finished { first: 0, estimates: &nothing, at: &nothing }, tracks.as_ref());
        }
        done.and_then(|()| out.flush())
    }

    fn write(
        &mut self,
        out: &mut dyn Write,
        finished: &Finished,
        at: Option<&givens_io::Tracks>,
    ) -> io::Result<()> {
        let (begun, times) = self.written;
        if let Some(tracks) = at {
            let part = Part {
                track: &tracks.tracks[0],
                from: times,
                row: times,
                started: false,
                estimates: finished.at,
            };
            self.written.1 += finished.at.len();
            return AnswerWriter { tracks, ..self.writer }.rows(out, &[part]);
        }
        let begin = &self.plan.beginnings[0];
        let row = begin.row + finished.first;
        let is_point = matches!(self.goal, Goal::Point(_));
        let from = if begun || is_point { row } else { 0 };
        self.written.0 |= !finished.estimates.is_empty();
        let started = begin.started && row == begin.row;
        let track = &self.plan.tracks.tracks[0];
        self.writer.rows(out, &[Part { track, from, row, started, estimates: finished.estimates }])
    }

    /// Adds rows to what is told of them, and drawn.
    fn add(&mut self, finished: &Finished) {
        let Finished { first, estimates: est, at } = *finished;
        self.sums.rows += est.len();
        est.log_likelihood.iter().for_each(|x| self.sums.log_likelihood += x);
        self.sums.consistency.add(est);
        self.sums.gated.add(0, self.plan.beginnings[0].row + first, est);
        let truth = self.plan.truth_at(0, self.goal, est.time.iter().copied());
        if let (Some(sums), Some(truth)) = (&mut self.accuracy, &truth) {
            sums.add(&est.mean, &est.cov, &truth.states);
        }
        if let Some((rows, times)) = &mut self.thinned {
            rows.add(est, truth.as_ref());
            for row in 0..at.len() {
                let kept = times.push(at, row);
                debug_assert!(kept, "rows of one run");
            }
        }
    }

    /// What the rows add up to.
    pub fn summary(&mut self) -> Summary {
        let Sums { rows, log_likelihood, consistency, gated } = core::mem::take(&mut self.sums);
        let accuracy = self.accuracy.as_ref().map(AccuracySums::accuracy);
        Summary { rows, log_likelihood, consistency: consistency.consistency(), gated, accuracy }
    }

    /// What a figure of it shows.
    pub fn shown(&self) -> Option<Shown<'_>> {
        let (rows, at) = self.thinned.as_ref()?;
        let (goal, at) = (self.goal, self.at.map(|_| at));
        Some(Shown { goal, rows: &rows.kept, at, counts: rows.counts() })
    }

    /// The failure that ended it, in words.
    pub fn failure(&self) -> Option<&String> {
        self.failure.as_ref()
    }
}

/// Bytes, to two digits.
fn size(bytes: usize) -> String {
    match bytes as f64 {
        bytes if bytes >= 1e9 => format!("{:.1} GB", bytes / 1e9),
        bytes => format!("{:.0} MB", bytes / 1e6),
    }
}
