//! Models from files.

use givens_io::{BeginError, Dynamics, Model as File, Row, Rows, SettingValue, Track};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use std::collections::HashMap;

use super::{Continuous, Discrete, Known, Model, Moves, Sensing, Sensor};
use crate::errors::{Input, Refusal, Result};
use crate::numbers::{frozen, numbers, shaped};

/// A model from the same file with all parameters set anew.
pub(super) fn again(file: &File, values: &[f64]) -> Result<Model> {
    let named = file.parameters.iter().zip(values).map(|((name, _), value)| (name.as_str(), *value));
    Ok(from_file(file.again_with(&named.collect::<Vec<_>>())?))
}

fn from_file(file: File) -> Model {
    let values = || file.parameters.iter().map(|(_, value)| *value).collect();
    let moves = match &file.dynamics {
        Dynamics::Discrete(model) => Moves::Discrete(Discrete::traced(model.clone(), values())),
        Dynamics::Continuous(model) => Moves::Continuous(Continuous::traced(model.clone(), values())),
    };
    let sensing = Sensing::traced(file.observation.clone());
    let sensors = file.sensors.iter().map(|sensor| Sensor {
        name: sensor.name.clone(),
        columns: sensor.columns.clone(),
        angles: sensor.angles.clone(),
    });
    let known = Known {
        states: file.states.clone(),
        controls: file.controls.clone(),
        parameters: file.parameters.iter().map(|(name, _)| name.clone()).collect(),
        sensors: sensors.collect(),
        file: Some(file),
        ..Known::default()
    };
    Model::assemble(known, moves, sensing)
}

impl Model {
    /// What it was read from.
    pub fn file(&self) -> Result<&File> {
        let none = || Input::plain("the model is not from a file");
        Ok(self.known.file.as_ref().ok_or_else(none)?)
    }
}

fn pairs(parameters: Option<&HashMap<String, f64>>) -> Vec<(&str, f64)> {
    let mut pairs: Vec<_> = parameters.into_iter().flatten().map(|(name, x)| (name.as_str(), *x)).collect();
    pairs.sort_by(|a, b| a.0.cmp(b.0));
    pairs
}

fn finite(parameters: &[(&str, f64)]) -> Result<()> {
    match parameters.iter().find(|(_, value)| !value.is_finite()) {
        None => Ok(()),
        Some((name, value)) => {
            let message = format!("parameter `{name}` is {value}, not a finite number");
            Err(Input::new("parameters", message).of(Some(&(*name).to_owned())).into())
        }
    }
}

#[pymethods]
impl Model {
    /// Reads a model file with other values for some of its parameters.
    #[staticmethod]
    #[pyo3(signature = (path, parameters=None))]
    fn read(path: &str, parameters: Option<HashMap<String, f64>>) -> Result<Self> {
        let parameters = pairs(parameters.as_ref());
        finite(&parameters)?;
        Ok(from_file(File::read_with(path, &parameters)?))
    }

    /// Reads a model from text; errors call it `name`.
    #[staticmethod]
    #[pyo3(signature = (text, name="model", parameters=None))]
    fn parse(text: &str, name: &str, parameters: Option<HashMap<String, f64>>) -> Result<Self> {
        let parameters = pairs(parameters.as_ref());
        finite(&parameters)?;
        Ok(from_file(File::parse_with(text, name, &parameters)?))
    }

    /// The file as it was named; None for a model that is from none.
    #[getter(file)]
    fn get_file(&self) -> Option<&str> {
        self.known.file.as_ref().map(|file| file.file.as_str())
    }

    /// The initial belief of the file, (mean, covariance): NaN and zero for states that `start` finds. None for a model
    /// that is from no file.
    #[getter]
    fn prior<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let Some(file) = &self.known.file else { return Ok(None) };
        let n = self.states();
        let mean = file.prior.mean.iter().map(|mean| mean.unwrap_or(f64::NAN)).collect();
        let both = (frozen(py, mean, &[n])?, frozen(py, file.prior.cov.clone(), &[n, n])?);
        Ok(Some(both.into_pyobject(py)?.into_any()))
    }

    /// When the initial belief of the file holds; None: at the first row.
    #[getter]
    fn time(&self) -> Option<f64> {
        self.known.file.as_ref().and_then(|file| file.time)
    }

    /// The states that `start` finds, by name.
    #[getter]
    fn start(&self) -> Vec<String> {
        let start = self.known.file.as_ref().and_then(|file| file.start.as_ref());
        let of = |&i: &usize| self.known.states.get(i).cloned();
        start.map_or_else(Vec::new, |start| start.states.iter().filter_map(of).collect())
    }

    /// The method that the file names.
    #[getter]
    fn method(&self) -> Option<&str> {
        let method = self.known.file.as_ref().and_then(|file| file.filter.method.as_ref());
        method.map(|(name, _)| name.as_str())
    }

    /// Parts and options beside it.
    #[getter]
    fn options<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let options = PyDict::new(py);
        for setting in self.known.file.iter().flat_map(|file| &file.filter.options) {
            match &setting.value {
                SettingValue::Text(text) => options.set_item(&setting.key, PyString::new(py, text))?,
                SettingValue::Number(number) => options.set_item(&setting.key, number)?,
                SettingValue::Truth(truth) => options.set_item(&setting.key, truth)?,
            }
        }
        Ok(options)
    }

    /// Where a track of these rows begins: the time, mean and covariance of the initial belief, the row at which it holds
    /// or the first after, and whether `start` has read that row, which must not be used again then.
    #[pyo3(signature = (time, z, u=None))]
    fn begin<'py>(
        &self,
        py: Python<'py>,
        time: PyReadonlyArrayDyn<'py, f64>,
        z: PyReadonlyArrayDyn<'py, f64>,
        u: Option<PyReadonlyArrayDyn<'py, f64>>,
    ) -> Result<Bound<'py, PyAny>> {
        let (file, d, c) = (self.file()?, self.measures(), self.controls());
        let rows = time.len();
        let (time, z) = (numbers(&time)?, shaped("z", &z, &[rows, d])?);
        let u = match u {
            Some(u) => shaped("u", &u, &[rows, c])?,
            None if c == 0 => Vec::new(),
            None => return Err(Input::new("u", format!("the model has {c} controls: give `u`")).into()),
        };
        let row = |(k, &time): (usize, &f64)| Row {
            line: k,
            index: k,
            time,
            time_text: String::new(),
            sensor: None,
            z: z[k * d..(k + 1) * d].to_vec(),
            u: u[k * c..(k + 1) * c].to_vec(),
        };
        let rows: Vec<Row> = time.iter().enumerate().map(row).collect();
        let start = file.time.or(time.first().copied()).unwrap_or(0.0);
        let track = Track { id: None, start, rows: Rows::from(rows), origin: None };
        let begun = file.begin(&track).map_err(no_beginning)?;
        let n = self.states();
        let mean = frozen(py, begun.prior.mean().to_vec(), &[n])?;
        let cov = frozen(py, begun.prior.cov().to_vec(), &[n, n])?;
        Ok((begun.time, mean, cov, begun.row, begun.started).into_pyobject(py)?.into_any())
    }
}

/// A track that cannot begin; its lines are rows of the arrays.
fn no_beginning(error: BeginError) -> Refusal {
    let at = error.line.map_or_else(String::new, |row| format!("row {row}: "));
    let input = Input::new("z", format!("{at}{}", error.message)).help(error.help);
    match error.line {
        Some(row) => input.row(row).into(),
        None => input.into(),
    }
}
