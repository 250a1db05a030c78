//! The answers of a table of tracks.

use core::fmt::Display;
use core::num::NonZeroUsize;
use core::ops::Range;
use std::path::Path;
use std::time::Instant;

use arrow_array::RecordBatchIterator;
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use givens::Goal;
use givens_io::{
    Answer, AnswerWriter, Destination, FailedTrack, Format, Layout, LentAnswers, Part, portions,
};
use numpy::PyReadonlyArrayDyn;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict};

use super::TrackTable;
use super::portion::{Beginnings, Come, Run, log_likelihood};
use crate::arrow::import::STREAM;
use crate::choice::Choice;
use crate::crowd::threads;
use crate::errors::{Input, Refusal, Result};
use crate::model::Model;
use crate::rows::goal;

type Numbers<'py> = PyReadonlyArrayDyn<'py, f64>;

#[pymethods]
impl TrackTable {
    /// The answers as a stream of record batches, or in a file, and what there is to say of them; see the stub.
    #[pyo3(signature = (model, choice, goal, goal_value, layout, prior=None, unbegun=None, threads=None, path=None))]
    fn answers<'py>(
        &self,
        py: Python<'py>,
        model: &Model,
        choice: &Choice,
        goal: &str,
        goal_value: Option<f64>,
        layout: &str,
        prior: Option<(Numbers<'py>, Numbers<'py>)>,
        unbegun: Option<Vec<(usize, String)>>,
        threads: Option<usize>,
        path: Option<&str>,
    ) -> Result<(Option<Bound<'py, PyCapsule>>, Bound<'py, PyDict>)> {
        model.serves(&choice.0)?;
        let goal = self::goal(goal, goal_value, &[], f64::NAN)?;
        let threads = self::threads(threads)?;
        let beginnings = self.beginnings(model, prior, unbegun.unwrap_or_default())?;
        let run = Run { model, choice: choice.0, goal, threads };
        let mut sum = Sum::new();
        let writer = self.writer(&run, layout, path)?;
        let refused: Vec<FailedTrack> = self.refused();
        let stream = match path {
            None => Some(self.lend(py, &run, &beginnings, writer, &refused, &mut sum)?),
            Some(path) => {
                self.write(py, &run, &beginnings, writer, path, &mut sum)?;
                None
            }
        };
        sum.failed.splice(0..0, refused);
        let said = sum.said(py, self.tracks.tracks.len() + self.tracks.refused.len())?;
        Ok((stream, said))
    }
}

impl TrackTable {
    fn writer(&self, run: &Run, layout: &str, path: Option<&str>) -> Result<AnswerWriter<'_>> {
        let layout = match layout {
            "wide" => Layout::Wide,
            "covariances" => Layout::Covariances,
            "tidy" => Layout::Tidy,
            other => return Err(Input::new("output", format!("output = {other}")).into()),
        };
        let ending = path.and_then(|path| Path::new(path).extension()).and_then(|ending| ending.to_str());
        let format = match ending {
            Some("csv") => Format::Csv,
            Some("jsonl") => Format::Jsonl,
            _ => Format::Parquet,
        };
        let (smoothed, gated) = (run.goal != Goal::Filter, run.choice.gate.is_some());
        let threads = NonZeroUsize::new(run.threads);
        Ok(AnswerWriter { format, layout, tracks: &self.tracks, smoothed, gated, threads })
    }

    /// The portions: all at once where the rows of tracks do not stand together.
    fn portions(&self, goal: Goal) -> Vec<Range<usize>> {
        if self.tracks.in_turn() {
            let all = portions(&self.tracks.tracks, |_| goal);
            return all.into_iter().map(|portion| portion.tracks).collect();
        }
        vec![Range { start: 0, end: self.tracks.tracks.len() }]
    }

    fn parts<'a>(&'a self, tracks: Range<usize>, answers: &'a [Answer]) -> Vec<Part<'a>> {
        let tracks = self.tracks.tracks[tracks].iter();
        tracks.zip(answers).map(|(track, answer)| answer.part(track)).collect()
    }

    /// A stream of the answers, those of tracks that were `refused` last but for other failures.
    fn lend<'py>(
        &self,
        py: Python<'py>,
        run: &Run,
        beginnings: &Beginnings,
        writer: AnswerWriter,
        refused: &[FailedTrack],
        sum: &mut Sum,
    ) -> Result<Bound<'py, PyCapsule>> {
        let answers = LentAnswers::new(writer, &self.batches);
        let mut batches = Vec::new();
        for portion in self.portions(run.goal) {
            let come = run.portion(py, &self.tracks.tracks[portion.clone()], &beginnings[portion.clone()])?;
            let parts = self.parts(portion, &come.answers);
            batches.push(py.detach(|| answers.rows(&parts)).map_err(unwritten)?);
            sum.add(come);
        }
        if !(refused.is_empty() && sum.failed.is_empty()) {
            let all: Vec<FailedTrack> = refused.iter().chain(&sum.failed).cloned().collect();
            batches.push(answers.failed(&all).map_err(unwritten)?);
        }
        let reader = RecordBatchIterator::new(batches.into_iter().map(Ok), answers.schema());
        // a stream that nobody takes out of the capsule is released with it
        Ok(PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(reader)), STREAM)?)
    }

    /// A file of the answers, as the command would write it.
    fn write(
        &self,
        py: Python<'_>,
        run: &Run,
        beginnings: &Beginnings,
        writer: AnswerWriter,
        path: &str,
        sum: &mut Sum,
    ) -> Result<()> {
        let failed = |error: &dyn Display| Refusal::Raised(PyOSError::new_err(error.to_string()));
        let mut out = Destination::shared(path).map_err(|error| failed(&error))?;
        let mut answers = writer.begin(&mut out).map_err(|error| failed(&error))?;
        for portion in self.portions(run.goal) {
            let come = run.portion(py, &self.tracks.tracks[portion.clone()], &beginnings[portion.clone()])?;
            let parts = self.parts(portion, &come.answers);
            py.detach(|| answers.rows(&mut out, &parts)).map_err(|error| failed(&error))?;
            sum.add(come);
        }
        answers.end(&mut out).map_err(|error| failed(&error))?;
        out.finish().map_err(|error| failed(&error))
    }
}

fn unwritten(error: impl Display) -> Input {
    Input::plain(format!("the answers cannot be written: {error}"))
}

/// What is said of a run.
struct Sum {
    rows: usize,
    log_likelihood: f64,
    failed: Vec<FailedTrack>,
    doubts: Vec<(String, bool)>,
    begun: Instant,
}

impl Sum {
    fn new() -> Self {
        Self { rows: 0, log_likelihood: 0.0, failed: Vec::new(), doubts: Vec::new(), begun: Instant::now() }
    }

    fn add(&mut self, come: Come) {
        self.rows += come.answers.iter().map(|answer| answer.estimates.len()).sum::<usize>();
        self.log_likelihood += log_likelihood(&come.answers);
        self.failed.extend(come.failed);
        self.doubts.extend(come.doubts);
    }

    fn said(self, py: Python<'_>, tracks: usize) -> PyResult<Bound<'_, PyDict>> {
        let said = PyDict::new(py);
        said.set_item("tracks", tracks)?;
        said.set_item("rows", self.rows)?;
        said.set_item("log_likelihood", self.log_likelihood)?;
        said.set_item("seconds", self.begun.elapsed().as_secs_f64())?;
        let failed = self.failed.into_iter().map(|track| (track.id, track.time_text, track.message));
        said.set_item("failed", failed.collect::<Vec<_>>())?;
        said.set_item("doubts", self.doubts)?;
        Ok(said)
    }
}
