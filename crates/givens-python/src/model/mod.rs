//! Models of any origin, as one type.

mod build;
mod continuous;
mod discrete;
mod evaluate;
mod file;
mod function;
mod part;
mod sensing;
mod serves;
mod shared;

use std::sync::Arc;

use givens::model::{Observation, Sde, Transition, Varies};
use givens::registry::Kind;
use numpy::{PyArray1, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use self::build::{Build, Given, SensorParts};
use crate::errors::{Input, Result, length};
use crate::graph::Graph;
use crate::listed::Listed;
use crate::numbers::numbers;

pub use self::continuous::Continuous;
pub use self::discrete::Discrete;
pub use self::function::Function;
pub use self::sensing::Sensing;

/// How the state moves.
#[derive(Clone, Debug)]
pub enum Moves {
    /// In steps.
    Discrete(Discrete),
    /// In continuous time.
    Continuous(Continuous),
}

/// A sensor of a model: a stretch of the stacked measurement.
#[derive(Clone, Debug)]
pub struct Sensor {
    name: String,
    columns: Vec<String>,
    angles: Vec<Option<f64>>,
}

/// What stays the same when parameters change.
#[derive(Debug, Default)]
pub struct Known {
    /// Names of the states.
    pub states: Vec<String>,
    /// Names of the measures of all sensors.
    pub measures: Vec<String>,
    /// Names of the controls, if they have some.
    controls: Vec<String>,
    /// Names of the parameters, if they have some.
    parameters: Vec<String>,
    sensors: Vec<Sensor>,
    /// The file that it was read from, as read.
    file: Option<givens_io::Model>,
}

/// A model with its sensors; see the stub.
#[pyclass(module = "givens._native", frozen)]
#[derive(Clone, Debug)]
pub struct Model {
    pub known: Arc<Known>,
    pub moves: Moves,
    pub sensing: Sensing,
}

impl Model {
    /// What its time is.
    pub fn kind(&self) -> Kind {
        match self.moves {
            Moves::Discrete(_) => Kind::Discrete,
            Moves::Continuous(_) => Kind::Continuous,
        }
    }

    /// Length n of the state.
    pub fn states(&self) -> usize {
        self.known.states.len()
    }

    /// Length d of the measurement, all sensors together.
    pub fn measures(&self) -> usize {
        self.known.measures.len()
    }

    /// Number of controls.
    pub fn controls(&self) -> usize {
        let moves = match &self.moves {
            Moves::Discrete(model) => model.controls(),
            Moves::Continuous(model) => model.controls(),
        };
        moves.max(self.sensing.controls())
    }

    /// Values of the parameters.
    pub fn parameters(&self) -> &[f64] {
        match &self.moves {
            Moves::Discrete(model) => model.parameters(),
            Moves::Continuous(model) => model.parameters(),
        }
    }

    fn assemble(known: Known, moves: Moves, sensing: Sensing) -> Self {
        let measures = known.sensors.iter().flat_map(|sensor| sensor.columns.iter().cloned()).collect();
        Self { known: Arc::new(Known { measures, ..known }), moves, sensing }
    }
}

/// Names that a model cannot do without.
fn named(states: &[String], parameters: &[f64], sensors: &[SensorParts]) -> Result<()> {
    if states.is_empty() {
        return Err(Input::new("state", "the model has no state").help("name at least one").into());
    }
    if sensors.is_empty() || sensors.iter().any(|sensor| sensor.columns.is_empty()) {
        return Err(Input::new("sensors", "a sensor measures nothing").help("name its measures").into());
    }
    if let Some(i) = parameters.iter().position(|value| !value.is_finite()) {
        let message = format!("`parameters[{i}]` is {}, not a finite number", parameters[i]);
        return Err(Input::new("parameters", message).into());
    }
    Ok(())
}

fn known(states: Vec<String>, sensors: Vec<SensorParts>) -> Known {
    let sensors = sensors.into_iter().map(
        |SensorParts { name, columns: Listed(columns), angles: Listed(mut angles), .. }| {
            angles.resize(columns.len(), None);
            Sensor { name, columns, angles }
        },
    );
    Known { states, sensors: sensors.collect(), ..Known::default() }
}

#[pymethods]
impl Model {
    #[staticmethod]
    #[pyo3(signature = (graph, states, controls, parameters, drift, diffusion, noises, sensors, *, jacobian=None,
        varies="state"))]
    fn continuous(
        py: Python<'_>,
        mut graph: PyRefMut<'_, Graph>,
        states: Listed<String>,
        controls: usize,
        parameters: Listed<f64>,
        drift: Given,
        diffusion: Given,
        noises: usize,
        sensors: Listed<SensorParts>,
        jacobian: Option<Py<Function>>,
        varies: &str,
    ) -> Result<Self> {
        named(&states, &parameters, &sensors)?;
        let varies = match varies {
            "never" => Varies::Never,
            "time" => Varies::WithTime,
            "state" => Varies::WithState,
            other => {
                let message = format!("varies = {other}: one of never, time, state");
                return Err(Input::new("varies", message).into());
            }
        };
        let mut build = Build { py, graph: &mut graph, states: &states, controls, parameters: &parameters };
        let moves = build.continuous(&drift, &diffusion, noises, varies, jacobian.as_ref())?;
        let sensing = build.sensors(&sensors)?;
        Ok(Self::assemble(known(states.0, sensors.0), Moves::Continuous(moves), sensing))
    }

    #[staticmethod]
    #[pyo3(signature = (graph, states, controls, parameters, transition, noise_cov, step, sensors, *, jacobian=None))]
    fn discrete(
        py: Python<'_>,
        mut graph: PyRefMut<'_, Graph>,
        states: Listed<String>,
        controls: usize,
        parameters: Listed<f64>,
        transition: Given,
        noise_cov: Given,
        step: Option<f64>,
        sensors: Listed<SensorParts>,
        jacobian: Option<Py<Function>>,
    ) -> Result<Self> {
        named(&states, &parameters, &sensors)?;
        let mut build = Build { py, graph: &mut graph, states: &states, controls, parameters: &parameters };
        let moves = build.discrete(&transition, &noise_cov, step, jacobian.as_ref())?;
        let sensing = build.sensors(&sensors)?;
        Ok(Self::assemble(known(states.0, sensors.0), Moves::Discrete(moves), sensing))
    }

    /// The same model with other values of its parameters.
    fn with_parameters(&self, values: PyReadonlyArrayDyn<'_, f64>) -> Result<Self> {
        let values = numbers(&values)?;
        length("parameters", "values of the parameters", self.parameters().len(), values.len())?;
        if let Some(i) = values.iter().position(|value| !value.is_finite()) {
            let name = self.known.parameters.get(i);
            let called =
                name.map_or_else(|| format!("`parameters[{i}]`"), |name| format!("parameter `{name}`"));
            let message = format!("{called} is {}, not a finite number", values[i]);
            return Err(Input::new("parameters", message).of(name).into());
        }
        if let Some(file) = &self.known.file {
            return file::again(file, &values);
        }
        let moves = match &self.moves {
            Moves::Discrete(model) => Moves::Discrete(model.with(values)),
            Moves::Continuous(model) => Moves::Continuous(model.with(values)),
        };
        Ok(Self { moves, known: Arc::clone(&self.known), sensing: self.sensing.clone() })
    }

    #[getter(kind)]
    fn get_kind(&self) -> &'static str {
        self.kind().word()
    }

    #[getter(states)]
    fn get_states(&self) -> Vec<String> {
        self.known.states.clone()
    }

    #[getter(measures)]
    fn get_measures(&self) -> Vec<String> {
        self.known.measures.clone()
    }

    #[getter(controls)]
    fn get_controls(&self) -> usize {
        self.controls()
    }

    #[getter]
    fn control_names(&self) -> Vec<String> {
        self.known.controls.clone()
    }

    #[getter(parameters)]
    fn get_parameters<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.parameters())
    }

    #[getter]
    fn parameter_names(&self) -> Vec<String> {
        self.known.parameters.clone()
    }

    /// The fixed length of a step, or None.
    #[getter]
    fn step(&self) -> Option<f64> {
        match &self.moves {
            Moves::Discrete(model) => model.period(),
            Moves::Continuous(_) => None,
        }
    }

    /// Columns of the diffusion that are not zero throughout; None for a discrete model.
    #[getter]
    fn noises(&self) -> Option<usize> {
        match &self.moves {
            Moves::Discrete(_) => None,
            Moves::Continuous(model) => Some(model.noises()),
        }
    }

    #[getter]
    fn sensors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let all = PyList::empty(py);
        for sensor in &self.known.sensors {
            let one = PyDict::new(py);
            one.set_item("name", &sensor.name)?;
            one.set_item("columns", &sensor.columns)?;
            one.set_item("angles", &sensor.angles)?;
            all.append(one)?;
        }
        Ok(all)
    }
}
