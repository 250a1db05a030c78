//! What a filter carries from step to step, and what its last measurement said, as a dict.

use givens::filter::Snapshot;
use givens::ode::Work;
use givens::registry::AnyFilter;
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{Input, Result};
use crate::model::Model;
use crate::numbers::{frozen, numbers, shaped};

type Numbers<'py> = PyReadonlyArrayDyn<'py, f64>;

/// What the last measurement said.
#[derive(Clone, Debug)]
pub struct Learnt {
    pub innovation: Vec<f64>,
    pub innovation_cov: Vec<f64>,
    pub nis: f64,
    pub nis_dof: usize,
    pub log_likelihood: f64,
    pub gated: bool,
}

impl Learnt {
    /// Nothing yet, of d measures.
    pub fn nothing(d: usize) -> Self {
        let (innovation, innovation_cov) = (vec![f64::NAN; d], vec![f64::NAN; d * d]);
        Self { innovation, innovation_cov, nis: f64::NAN, nis_dof: 0, log_likelihood: 0.0, gated: false }
    }

    /// Of a filter that was updated.
    pub fn of(filter: &AnyFilter<'_>) -> Self {
        let (innovation, innovation_cov) = filter.whole_innovation();
        let (nis, nis_dof, log_likelihood) = (filter.nis(), filter.dof(), filter.log_likelihood());
        Self { innovation, innovation_cov, nis, nis_dof, log_likelihood, gated: filter.gated() }
    }
}

/// All that a filter carries, as plain data.
pub fn write<'py>(py: Python<'py>, filter: &AnyFilter<'_>, learnt: &Learnt) -> PyResult<Bound<'py, PyDict>> {
    let d = filter.measures();
    let (carried, n) = (filter.snapshot(), filter.states());
    let square = |values: Vec<f64>| match values.len() {
        0 => frozen(py, values, &[0, 0]),
        _ => frozen(py, values, &[n, n]),
    };
    let flat = |values: Vec<f64>| {
        let len = values.len();
        frozen(py, values, &[len])
    };
    let all = PyDict::new(py);
    all.set_item("time", carried.time)?;
    all.set_item("step", carried.step)?;
    all.set_item("mean", flat(carried.mean)?)?;
    all.set_item("factor", square(carried.factor)?)?;
    all.set_item("cov", square(carried.cov)?)?;
    all.set_item("moved", square(carried.moved)?)?;
    all.set_item("floor", flat(carried.floor)?)?;
    all.set_item("controls", carried.controls.map(flat).transpose()?)?;
    all.set_item("parameters", flat(carried.parameters)?)?;
    let Work { calls, jacobians, accepted, rejected } = carried.work;
    all.set_item("work", (calls, jacobians, accepted, rejected))?;
    all.set_item("innovation", flat(learnt.innovation.clone())?)?;
    all.set_item("innovation_cov", frozen(py, learnt.innovation_cov.clone(), &[d, d])?)?;
    all.set_item("nis", learnt.nis)?;
    all.set_item("nis_dof", learnt.nis_dof)?;
    all.set_item("log_likelihood", learnt.log_likelihood)?;
    all.set_item("gated", learnt.gated)?;
    Ok(all)
}

/// A snapshot from its dict.
pub fn read(model: &Model, snapshot: &Bound<'_, PyDict>) -> Result<(Snapshot, Learnt)> {
    let item = |key: &str| -> Result<Bound<'_, PyAny>> {
        let missing = || Input::new("snapshot", format!("the snapshot has no `{key}`"));
        Ok(snapshot.get_item(key)?.ok_or_else(missing)?)
    };
    let array = |key: &str| -> Result<Vec<f64>> { numbers(&item(key)?.extract::<Numbers<'_>>()?) };
    let (d, controls) = (model.measures(), item("controls")?);
    let (calls, jacobians, accepted, rejected) = item("work")?.extract()?;
    let carried = Snapshot {
        time: item("time")?.extract()?,
        step: item("step")?.extract()?,
        mean: array("mean")?,
        factor: array("factor")?,
        cov: array("cov")?,
        moved: array("moved")?,
        floor: array("floor")?,
        controls: if controls.is_none() { None } else { Some(array("controls")?) },
        parameters: array("parameters")?,
        work: Work { calls, jacobians, accepted, rejected },
    };
    let of = |key: &'static str, shape: &[usize]| -> Result<Vec<f64>> {
        shaped(key, &item(key)?.extract::<Numbers<'_>>()?, shape)
    };
    let learnt = Learnt {
        innovation: of("innovation", &[d])?,
        innovation_cov: of("innovation_cov", &[d, d])?,
        nis: item("nis")?.extract()?,
        nis_dof: item("nis_dof")?.extract()?,
        log_likelihood: item("log_likelihood")?.extract()?,
        gated: item("gated")?.extract()?,
    };
    Ok((carried, learnt))
}
