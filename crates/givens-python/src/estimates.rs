//! What a run has learnt, as arrays of NumPy.

use givens::filter::StepError;
use givens::registry::Choice;
use givens::{Estimates as Rows, Outcome};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::doubts::Doubt;
use crate::failure::{self, At};
use crate::model::Model;
use crate::numbers::{counts, frozen};

type Array = Py<PyArrayDyn<f64>>;

/// The estimates of a trajectory, row by row; see the stub.
///
/// The arrays are made once, from the memory in which the run has left them, and cannot be written to.
#[pyclass(module = "givens._native", frozen, get_all)]
#[derive(Debug)]
pub struct Estimates {
    time: Array,
    mean: Array,
    cov: Array,
    factor: Array,
    filtered_mean: Array,
    filtered_cov: Array,
    predicted_mean: Array,
    predicted_cov: Array,
    innovation: Array,
    innovation_cov: Array,
    nis: Array,
    nis_dof: Py<PyArray1<i64>>,
    log_likelihood: Array,
    gated: Py<PyArray1<bool>>,
    total_log_likelihood: f64,
    smoothed: bool,
    at: Option<Py<Estimates>>,
    failure: Option<Py<PyDict>>,
    doubts: Vec<Doubt>,
}

impl Estimates {
    fn of_rows(py: Python<'_>, rows: Rows, n: usize, d: usize) -> PyResult<Self> {
        let (k, smoothed) = (rows.len(), rows.is_smoothed());
        let total_log_likelihood = rows.total_log_likelihood();
        let array = |values: Vec<f64>, shape: &[usize]| frozen(py, values, shape).map(Bound::unbind);
        let mean = array(rows.mean, &[k, n])?;
        let cov = array(rows.cov, &[k, n, n])?;
        let (filtered_mean, filtered_cov) = if smoothed {
            (array(rows.filtered_mean, &[k, n])?, array(rows.filtered_cov, &[k, n, n])?)
        } else {
            (mean.clone_ref(py), cov.clone_ref(py))
        };
        let nis_dof = counts(py, rows.nis_dof.iter().copied());
        let gated = PyArray1::from_vec(py, rows.gated);
        gated.readwrite().make_nonwriteable();
        Ok(Self {
            time: array(rows.time, &[k])?,
            mean,
            cov,
            factor: array(rows.factor, &[k, n, n])?,
            filtered_mean,
            filtered_cov,
            predicted_mean: array(rows.predicted_mean, &[k, n])?,
            predicted_cov: array(rows.predicted_cov, &[k, n, n])?,
            innovation: array(rows.innovation, &[k, d])?,
            innovation_cov: array(rows.innovation_cov, &[k, d, d])?,
            nis: array(rows.nis, &[k])?,
            nis_dof: nis_dof.unbind(),
            log_likelihood: array(rows.log_likelihood, &[k])?,
            gated: gated.unbind(),
            total_log_likelihood,
            smoothed,
            at: None,
            failure: None,
            doubts: Vec::new(),
        })
    }

    /// What came of a run, and what is doubtful about it; with `at` if other times were asked for.
    pub fn of(
        py: Python<'_>,
        outcome: Outcome,
        doubts: Vec<Doubt>,
        (model, choice): (&Model, &Choice),
        at: bool,
    ) -> PyResult<Self> {
        let (n, d) = (model.states(), model.measures());
        let Outcome { estimates, failure, at: there, log_likelihood, failed_at } = outcome;
        let failure = failure.as_ref().map(|(row, error): &(usize, StepError)| {
            let at = At { row: Some(*row), mean: &failed_at };
            failure::dict(py, model, Some(choice), error, at).map(Bound::unbind)
        });
        let there = at.then(|| Py::new(py, Self::of_rows(py, there, n, d)?));
        let own = Self::of_rows(py, estimates, n, d)?;
        let (at, failure) = (there.transpose()?, failure.transpose()?);
        Ok(Self { at, failure, doubts, total_log_likelihood: log_likelihood, ..own })
    }
}

#[pymethods]
impl Estimates {
    fn __len__(&self, py: Python<'_>) -> usize {
        self.time.bind(py).len()
    }
}
