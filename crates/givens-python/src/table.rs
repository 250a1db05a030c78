//! Tables of measurements, as arrays.

use givens_io::{Track, read_tracks as read};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::errors::{Input, Result};
use crate::model::Model;
use crate::numbers::{counts, frozen};

/// Reads the measurements for a model that is from a file; see the stub.
#[pyfunction]
pub fn read_tracks<'py>(py: Python<'py>, model: &Model, path: &str) -> Result<Bound<'py, PyDict>> {
    let file = model.file()?;
    let tracks = py.detach(|| read(path, file))?;
    let all = PyDict::new(py);
    let each = PyList::empty(py);
    for track in &tracks.tracks {
        each.append(arrays(py, model, track)?)?;
    }
    all.set_item("tracks", each)?;
    all.set_item("ignored", tracks.ignored)?;
    all.set_item("has_track_id", tracks.has_track_id)?;
    all.set_item("has_sensor", tracks.has_sensor)?;
    Ok(all)
}

/// One track, and where it begins.
fn arrays<'py>(py: Python<'py>, model: &Model, track: &Track) -> Result<Bound<'py, PyDict>> {
    let (k, d, c) = (track.rows.len(), model.measures(), model.controls());
    let file = model.file()?;
    let begun = file.begin(track).map_err(|error| {
        let at = error.line.map_or_else(String::new, |line| format!("line {line}: "));
        let of = track.id.as_ref().map_or_else(String::new, |id| format!("track {id}: "));
        Input::new("data", format!("{at}{of}{}", error.message)).help(error.help)
    })?;
    let n = model.states();
    let all = PyDict::new(py);
    let rows = track.rows.read(0..k).map_err(|error| Input::new("data", error.to_string()))?;
    let gather = |of: fn(&givens_io::Row) -> &[f64]| rows.iter().flat_map(of).copied().collect();
    all.set_item("id", &track.id)?;
    all.set_item("origin", track.origin.map(|_| track.time_text(0.0)))?;
    all.set_item("time", frozen(py, rows.iter().map(|row| row.time).collect(), &[k])?)?;
    all.set_item("z", frozen(py, gather(|row| &row.z), &[k, d])?)?;
    all.set_item("u", frozen(py, gather(|row| &row.u), &[k, c])?)?;
    // one beyond the last sensor: a row that names none
    let of = |row: &givens_io::Row| row.sensor.unwrap_or(file.sensors.len());
    all.set_item("sensor", counts(py, rows.iter().map(of)))?;
    all.set_item("line", counts(py, rows.iter().map(|row| row.line)))?;
    all.set_item("t0", begun.time)?;
    all.set_item("mean", frozen(py, begun.prior.mean().to_vec(), &[n])?)?;
    all.set_item("cov", frozen(py, begun.prior.cov().to_vec(), &[n, n])?)?;
    all.set_item("row", begun.row)?;
    all.set_item("started", begun.started)?;
    Ok(all)
}
