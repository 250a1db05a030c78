//! A step that failed, in the names of the model and the words of Python.

use givens::explain::{Explain, Face, Told};
use givens::filter::{Fault, StepError};
use givens::registry::Choice;
use givens::scalar::Shown;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::Refusal;
use crate::model::Model;

/// Where and from where a step failed.
#[derive(Clone, Copy, Default)]
pub struct At<'a> {
    pub row: Option<usize>,
    /// The mean from which it set out.
    pub mean: &'a [f64],
}

pub fn told(model: &Model, choice: Option<&Choice>, fault: &Fault) -> Told {
    explained(model, |explain| explain.told(choice, fault))
}

/// Says something in the names of the model.
pub fn explained<'a>(model: &'a Model, say: impl FnOnce(&Explain) -> Told) -> Told {
    let names = |of: &'a [String]| -> Vec<&str> { of.iter().map(String::as_str).collect() };
    let (states, measures) = (names(&model.known.states), names(&model.known.measures));
    say(&Explain { face: Face::Python, kind: model.kind(), states: &states, measures: &measures })
}

/// The kind of a fault, in a word.
pub fn word(fault: &Fault) -> &'static str {
    match fault {
        Fault::NotPositive { .. } => "not-positive",
        Fault::SingularInnovation { .. } => "singular-innovation",
        Fault::NotFinite { .. } => "not-finite",
        Fault::Unrepresentable { .. } => "unrepresentable",
        Fault::Indistinct { .. } => "indistinct",
        Fault::Backwards { .. } => "backwards",
        Fault::NotWholeSteps { .. } => "not-whole-steps",
        Fault::Length { .. } => "length",
        Fault::ControlsNotSet { .. } => "controls-not-set",
        Fault::StateDependentDiffusion => "state-dependent-diffusion",
        Fault::SingularFactor { .. } => "singular-factor",
        Fault::Unresolved { .. } => "unresolved",
        Fault::Solver { .. } => "solver",
        Fault::Option(_) => "option",
        Fault::Mismatch { .. } => "mismatch",
    }
}

/// The fields of a failure, as `StepError` takes them, without words.
fn fields<'py>(
    py: Python<'py>,
    error: &StepError,
    at: At,
    component: Option<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    let (matrix, pivot, quantity) = match error.fault {
        Fault::NotPositive { matrix, pivot } => (Some(matrix.name()), Some(pivot), None),
        Fault::SingularInnovation { measure } => (Some("innovation covariance"), Some(measure), None),
        Fault::SingularFactor { pivot } => (Some("predicted covariance"), Some(pivot), None),
        Fault::NotFinite { quantity, .. } | Fault::Unrepresentable { quantity, .. } => {
            (None, None, Some(quantity.name()))
        }
        _ => (None, None, None),
    };
    fields.set_item("time", error.time)?;
    fields.set_item("row", at.row)?;
    fields.set_item("step", error.step)?;
    fields.set_item("fault", word(&error.fault))?;
    fields.set_item("matrix", matrix)?;
    fields.set_item("pivot", pivot)?;
    fields.set_item("quantity", quantity)?;
    fields.set_item("component", component)?;
    let mean = (!at.mean.is_empty()).then(|| PyArray1::from_slice(py, at.mean));
    fields.set_item("mean", mean)?;
    Ok(fields)
}

/// All about a failure, with `message` and `remedy`.
pub fn dict<'py>(
    py: Python<'py>,
    model: &Model,
    choice: Option<&Choice>,
    error: &StepError,
    at: At,
) -> PyResult<Bound<'py, PyDict>> {
    let Told { what, remedy, component } = told(model, choice, &error.fault);
    let all = fields(py, error, at, component)?;
    all.set_item("message", what)?;
    all.set_item("remedy", remedy)?;
    Ok(all)
}

/// A failure as an exception.
pub fn refusal(py: Python<'_>, model: &Model, choice: Option<&Choice>, error: &StepError, at: At) -> Refusal {
    let Told { what, remedy, component } = told(model, choice, &error.fault);
    let row = at.row.map_or_else(String::new, |row| format!("row {row}, "));
    let message = format!("{row}t = {}: {what}", Shown(error.time));
    match fields(py, error, at, component) {
        Ok(fields) => Refusal::Step(message, remedy, fields.unbind()),
        Err(error) => Refusal::Raised(error),
    }
}

/// Notes on an exception of the user's where the run was.
pub fn noted(py: Python<'_>, raised: PyErr, row: Option<usize>, error: Option<&StepError>) -> PyErr {
    if let Some(error) = error {
        let row = row.map_or_else(String::new, |row| format!("row {row}, "));
        let note = format!("raised in a function of the model at {row}t = {}", Shown(error.time));
        // an exception that takes no note is raised as it is
        let _ = raised.add_note(py, note);
    }
    raised
}
