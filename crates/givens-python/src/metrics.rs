//! Whether estimates are as good as they say, and how good they are.

use givens::Estimates;
use givens::metrics::{Accuracy, Consistency, Verdict};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{Input, Result, length};
use crate::numbers::{aligned, frozen, numbers, shaped};

/// The NIS of rows against its χ² band; see the stub.
#[pyfunction]
pub fn consistency<'py>(
    py: Python<'py>,
    nis: PyReadonlyArrayDyn<'py, f64>,
    nis_dof: PyReadonlyArrayDyn<'py, i64>,
) -> Result<Bound<'py, PyDict>> {
    length("nis_dof", "degrees of freedom", nis.len(), nis_dof.len())?;
    if !aligned(&nis_dof) {
        return Err(Input::new("nis_dof", "an array that is not aligned in memory")
            .help("give a copy of it")
            .into());
    }
    let mut rows = Estimates::default();
    rows.nis = numbers(&nis)?;
    for &dof in nis_dof.as_array() {
        let negative = |_| Input::new("nis_dof", format!("{dof} degrees of freedom"));
        rows.nis_dof.push(usize::try_from(dof).map_err(negative)?);
    }
    let of = Consistency::of([&rows]);
    let verdict = match of.verdict() {
        Verdict::Unknown => "unknown",
        Verdict::Consistent => "consistent",
        Verdict::Overconfident => "overconfident",
        Verdict::Underconfident => "underconfident",
    };
    let all = PyDict::new(py);
    all.set_item("verdict", verdict)?;
    all.set_item("ratio", of.ratio)?;
    all.set_item("band", of.band)?;
    all.set_item("dof", of.dof)?;
    all.set_item("text", of.to_string())?;
    Ok(all)
}

/// Estimates against a truth, NaN where that is not known; see the stub.
#[pyfunction]
pub fn accuracy<'py>(
    py: Python<'py>,
    mean: PyReadonlyArrayDyn<'py, f64>,
    cov: PyReadonlyArrayDyn<'py, f64>,
    truth: PyReadonlyArrayDyn<'py, f64>,
) -> Result<Bound<'py, PyDict>> {
    let &[k, n] = mean.shape() else {
        return Err(Input::new("mean", "`mean` has rows and states: two dimensions").into());
    };
    let cov = shaped("cov", &cov, &[k, n, n])?;
    let truth = shaped("truth", &truth, &[k, n])?;
    let of = Accuracy::of_rows(n, &numbers(&mean)?, &cov, &truth);
    let all = PyDict::new(py);
    all.set_item("rmse", frozen(py, of.rmse, &[n])?)?;
    all.set_item("coverage", frozen(py, of.coverage, &[n])?)?;
    all.set_item("rows", of.rows)?;
    all.set_item("nees", of.nees)?;
    all.set_item("nees_dof", of.nees_dof)?;
    all.set_item("nees_rows", of.nees_rows)?;
    Ok(all)
}
