//! A table of tracks, and where these begin.

use arrow_array::ffi_stream::RecordBatchStreamReader;
use arrow_array::{RecordBatch, RecordBatchReader};
use givens::filter::Gaussian;
use givens_io::{Beginning, FailedTrack, Scheme, Sensor, Tracks, lent_tracks, read_tracks_apart};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

use super::portion::Beginnings;
use crate::arrow::import::taken;
use crate::errors::{Input, Result};
use crate::model::Model;
use crate::numbers::{frozen, numbers};

type Numbers<'py> = PyReadonlyArrayDyn<'py, f64>;

/// States, columns of the controls, sensors with their measures, when the prior holds, the length of a step, and what tells
/// the model from others.
type Names = (Vec<String>, Vec<String>, Vec<(String, Vec<String>)>, Option<f64>, Option<f64>, String);

/// A table of tracks that was read for a model; see the stub.
#[pyclass(module = "givens._native", frozen)]
#[derive(Debug)]
pub struct TrackTable {
    pub tracks: Tracks,
    /// What was lent, to lend on.
    pub batches: Vec<RecordBatch>,
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
    let late = "give a `t0` that is the first row's or earlier, or leave it out";
    Ok(Scheme { states, controls, sensors, time, late, epoch: None, step, fingerprint })
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
                Input::new("table", format!("the table could not be read: {error}"))
            };
            let reader = RecordBatchStreamReader::try_new(stream).map_err(|error| {
                wrong(&error).help("give a table, with columns that have names; an array or a column is none")
            })?;
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
            return Err(PyIndexError::new_err("there are fewer tracks").into());
        };
        let rows = track.rows.read(0..track.rows.len()).map_err(|error| Input::plain(error.to_string()))?;
        let z = rows.iter().flat_map(|row| &row.z).copied().collect();
        let t = frozen(py, rows.iter().map(|row| row.time).collect(), &[rows.len()])?;
        let z = frozen(py, z, &[rows.len(), self.tracks.scheme.measures()])?;
        Ok((t, z).into_pyobject(py)?.into_any())
    }
}

impl TrackTable {
    /// Where the tracks begin: as the file of the model says, or with a belief for all, or one for each.
    pub fn beginnings(
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

    /// Tracks whose rows were wrong, as tracks that failed.
    pub fn refused(&self) -> Vec<FailedTrack> {
        let of = |refused: &givens_io::Refused| {
            let message = format!("input: {}", refused.message);
            FailedTrack { id: refused.id.clone(), time_text: None, message }
        };
        self.tracks.refused.iter().map(of).collect()
    }
}
