//! A table of tracks, and its answers.

use core::num::NonZeroUsize;
use core::ops::Range;
use std::io;
use std::path::Path;
use std::time::Instant;

use arrow_array::ffi_stream::{FFI_ArrowArrayStream, RecordBatchStreamReader};
use arrow_array::{RecordBatch, RecordBatchIterator, RecordBatchReader};
use givens::Goal;
use givens::filter::Gaussian;
use givens_io::{
    Answer, AnswerWriter, Beginning, Destination, FailedTrack, Format, Layout, LentAnswers, Part, Scheme,
    Sensor, Tracks, lent_tracks, read_tracks_apart,
};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict};

use super::portion::{Beginnings, Come, Run, log_likelihood, portions};
use crate::arrow::import::{STREAM, taken};
use crate::choice::Choice;
use crate::crowd::threads;
use crate::errors::{Input, Refusal, Result};
use crate::model::Model;
use crate::numbers::{frozen, numbers};
use crate::rows::goal;

type Numbers<'py> = PyReadonlyArrayDyn<'py, f64>;

/// States, columns of the controls, sensors with their measures, when the prior holds, the length of a step, and what tells
/// the model from others.
type Names = (Vec<String>, Vec<String>, Vec<(String, Vec<String>)>, Option<f64>, Option<f64>, String);

/// A table of tracks that was read for a model; see the stub.
#[pyclass(module = "givens._native", frozen)]
#[derive(Debug)]
pub struct TrackTable {
    tracks: Tracks,
    /// What was lent, to lend on.
    batches: Vec<RecordBatch>,
}

fn scheme(model: &Model, names: Option<Names>) -> Result<Scheme> {
    let Some((states, controls, all, time, step, fingerprint)) = names else {
        return Ok(model.file()?.scheme());
    };
    let (mut sensors, mut next) = (Vec::new(), 0);
    for (name, columns) in all {
        let (measures, angles) = (next..next + columns.len(), vec![None; columns.len()]);
        next = measures.end;
        sensors.push(Sensor { name, measures, columns, angles });
    }
    Ok(Scheme { states, controls, sensors, time, epoch: None, step, fingerprint })
}

#[pymethods]
impl TrackTable {
    /// Reads a table that another library lends; see the stub.
    #[staticmethod]
    #[pyo3(signature = (model, capsule, names=None))]
    fn lent(py: Python<'_>, model: &Model, capsule: &Bound<'_, PyAny>, names: Option<Names>) -> Result<Self> {
        let (stream, scheme) = (taken(capsule)?, scheme(model, names)?);
        py.detach(move || {
            let wrong = |error: &dyn core::fmt::Display| {
                Input::plain(format!("the table could not be read: {error}"))
            };
            let reader = RecordBatchStreamReader::try_new(stream).map_err(|error| wrong(&error))?;
            let schema = reader.schema();
            let batches =
                reader.collect::<core::result::Result<Vec<_>, _>>().map_err(|error| wrong(&error))?;
            let tracks = lent_tracks(batches.iter().cloned().map(Ok), &schema, "the table", &scheme)?;
            Ok(Self { tracks, batches })
        })
    }

    /// Reads a CSV or a Parquet file; see the stub.
    #[staticmethod]
    #[pyo3(signature = (model, path, names=None))]
    fn read(py: Python<'_>, model: &Model, path: &str, names: Option<Names>) -> Result<Self> {
        let scheme = scheme(model, names)?;
        py.detach(|| Ok(Self { tracks: read_tracks_apart(path, &scheme)?, batches: Vec::new() }))
    }

    fn __len__(&self) -> usize {
        self.tracks.tracks.len()
    }

    /// Times (rows,) and measurements (rows, d) of a track.
    fn track<'py>(&self, py: Python<'py>, index: usize) -> Result<Bound<'py, PyAny>> {
        let Some(track) = self.tracks.tracks.get(index) else {
            return Err(pyo3::exceptions::PyIndexError::new_err("there are fewer tracks").into());
        };
        let rows = track.rows.read(0..track.rows.len()).map_err(|error| Input::plain(error.to_string()))?;
        let z = rows.iter().flat_map(|row| &row.z).copied().collect();
        let t = frozen(py, rows.iter().map(|row| row.time).collect(), &[rows.len()])?;
        let z = frozen(py, z, &[rows.len(), self.tracks.scheme.measures()])?;
        Ok((t, z).into_pyobject(py)?.into_any())
    }

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
    /// Where the tracks begin: as the file of the model says, or with a belief for all, or one for each.
    fn beginnings(
        &self,
        model: &Model,
        prior: Option<(Numbers<'_>, Numbers<'_>)>,
        unbegun: Vec<(usize, String)>,
    ) -> Result<Beginnings> {
        let (tracks, n) = (&self.tracks.tracks, model.states());
        let Some((mean, cov)) = prior else {
            let file = model.file()?;
            let told = |error: givens_io::BeginError| {
                let row = error.line.map_or_else(String::new, |line| format!("row {line}: "));
                format!("{row}{}; {}", error.message, error.help)
            };
            return Ok(tracks.iter().map(|track| file.begin(track).map_err(told)).collect());
        };
        let (means, covs) = (numbers(&mean)?, numbers(&cov)?);
        let each = mean.ndim() == 2;
        let count = if each { tracks.len() } else { 1 };
        if means.len() != count * n || covs.len() != count * n * n {
            return Err(Input::new("prior", "the beliefs have other lengths than tracks and states").into());
        }
        let one =
            |k: usize| Gaussian::from_cov(&means[k * n..(k + 1) * n], &covs[k * n * n..(k + 1) * n * n]);
        let common = if each { None } else { Some(one(0)) };
        let mut beginnings: Beginnings = Vec::with_capacity(tracks.len());
        for (k, track) in tracks.iter().enumerate() {
            let prior = common.clone().unwrap_or_else(|| one(k));
            let prior = prior.map_err(|error| format!("its initial covariance is none: {error}"));
            beginnings.push(prior.map(|prior| Beginning {
                time: track.start,
                prior,
                row: 0,
                started: false,
            }));
        }
        for (k, why) in unbegun {
            if let Some(beginning) = beginnings.get_mut(k) {
                *beginning = Err(why);
            }
        }
        Ok(beginnings)
    }

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

    /// Tracks whose rows were wrong, as tracks that failed.
    fn refused(&self) -> Vec<FailedTrack> {
        let of = |refused: &givens_io::Refused| {
            let message = format!("input: {}", refused.message);
            FailedTrack { id: refused.id.clone(), time_text: None, message }
        };
        self.tracks.refused.iter().map(of).collect()
    }

    /// The portions: all at once where the rows of tracks do not stand together.
    fn portions(&self) -> Vec<Range<usize>> {
        if self.tracks.in_turn() {
            return portions(&self.tracks);
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
        for portion in self.portions() {
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
        let failed = |error: &dyn core::fmt::Display| {
            Refusal::Raised(pyo3::exceptions::PyOSError::new_err(error.to_string()))
        };
        let mut out = Destination::shared(path).map_err(|error| failed(&error))?;
        let mut answers = writer.begin(&mut out).map_err(|error| failed(&error))?;
        for portion in self.portions() {
            let come = run.portion(py, &self.tracks.tracks[portion.clone()], &beginnings[portion.clone()])?;
            let parts = self.parts(portion, &come.answers);
            py.detach(|| answers.rows(&mut out, &parts)).map_err(|error| failed(&error))?;
            sum.add(come);
        }
        answers.end(&mut out).map_err(|error| failed(&error))?;
        out.finish().map_err(|error| failed(&error))
    }
}

fn unwritten(error: io::Error) -> Input {
    Input::plain(format!("the answers cannot be written: {error}"))
}

/// What is said of a run.
struct Sum {
    rows: usize,
    log_likelihood: f64,
    failed: Vec<FailedTrack>,
    begun: Instant,
}

impl Sum {
    fn new() -> Self {
        Self { rows: 0, log_likelihood: 0.0, failed: Vec::new(), begun: Instant::now() }
    }

    fn add(&mut self, come: Come) {
        self.rows += come.answers.iter().map(|answer| answer.estimates.len()).sum::<usize>();
        self.log_likelihood += log_likelihood(&come.answers);
        self.failed.extend(come.failed);
    }

    fn said(self, py: Python<'_>, tracks: usize) -> PyResult<Bound<'_, PyDict>> {
        let said = PyDict::new(py);
        said.set_item("tracks", tracks)?;
        said.set_item("rows", self.rows)?;
        said.set_item("log_likelihood", self.log_likelihood)?;
        said.set_item("seconds", self.begun.elapsed().as_secs_f64())?;
        let failed = self.failed.into_iter().map(|track| (track.id, track.time_text, track.message));
        said.set_item("failed", failed.collect::<Vec<_>>())?;
        Ok(said)
    }
}
