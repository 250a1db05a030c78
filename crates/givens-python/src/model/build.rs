//! From what Python gives to models.

use givens::model::Varies;
use givens_expr::{
    Input as Named, ModelError, ModelObservation, ModelSde, ModelTransition, Node, NoiseBlock,
    ObservationParts, Program, SdeParts, TransitionParts,
};
use pyo3::prelude::*;

use super::continuous::{self, Continuous};
use super::discrete::{self, Discrete};
use super::function::Function;
use super::part::{Body, Part};
use super::sensing::{self, Sensing};
use crate::errors::{Input, Refusal, Result, length};
use crate::graph::Graph;
use crate::listed::Listed;

/// A list of nodes of a graph, or a function that is called.
#[derive(FromPyObject)]
pub enum Given {
    /// Numbers of nodes.
    #[pyo3(transparent)]
    Nodes(Listed<u32>),
    /// A function.
    #[pyo3(transparent)]
    Called(Py<Function>),
}

/// A sensor as Python gives it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct SensorParts {
    pub name: String,
    pub columns: Listed<String>,
    pub measures: Given,
    #[pyo3(default)]
    pub angles: Listed<Option<f64>>,
    #[pyo3(default)]
    pub std: Option<Given>,
    #[pyo3(default)]
    pub cov: Option<Given>,
    #[pyo3(default)]
    pub jacobian: Option<Py<Function>>,
}

impl Given {
    fn is_called(&self) -> bool {
        matches!(self, Given::Called(_))
    }
}

/// The parts of a model on the way: sizes, names, and the graph in which the expressions stand.
pub struct Build<'a, 'py> {
    pub py: Python<'py>,
    pub graph: &'a mut Graph,
    pub states: &'a [String],
    pub controls: usize,
    pub parameters: &'a [f64],
}

impl Build<'_, '_> {
    fn nodes(&self, given: &Given) -> Result<Vec<Node>> {
        match given {
            Given::Nodes(numbers) => Ok(self.graph.nodes(numbers)?),
            Given::Called(_) => Ok(Vec::new()),
        }
    }

    /// A function of so many values. What of the inputs its expressions name is checked.
    fn part(
        &mut self,
        what: &'static str,
        given: &Given,
        [rows, columns]: [usize; 2],
        [state, step]: [bool; 2],
    ) -> Result<Part> {
        let outputs = rows.saturating_mul(columns);
        let body = match given {
            Given::Called(function) => Body::Called(function.get().0.again(self.py)),
            Given::Nodes(_) => {
                let nodes = self.nodes(given)?;
                length(what, &format!("`{what}`"), outputs, nodes.len())?;
                let graph = self.graph.inner();
                let there = |input: &Named| match *input {
                    Named::State(i) => state && (i as usize) < self.states.len(),
                    Named::Control(i) => (i as usize) < self.controls,
                    Named::Parameter(i) => (i as usize) < self.parameters.len(),
                    Named::Step => step,
                    Named::Time => true,
                    Named::Measure(_) => false,
                };
                if !graph.inputs_of_all(&nodes).iter().all(there) {
                    let message = format!("`{what}` names a quantity that it may not, or that there is not");
                    return Err(Input::new(what, message).into());
                }
                Body::Program(
                    Program::compile(graph, &nodes).map_err(|error| self.refused(what, error.into()))?,
                )
            }
        };
        Ok(Part { what, body, outputs, rows, jacobian: None })
    }

    /// An error of expressions, in the names of the model.
    fn refused(&self, argument: &'static str, error: ModelError) -> Refusal {
        let name = match &error {
            ModelError::Input { index, .. } if matches!(argument, "drift" | "transition") => {
                self.states.get(*index)
            }
            _ => None,
        };
        let input = Input::new(argument, error.to_string()).of(name);
        match error {
            ModelError::Graph(_) => input.help("shorten the model, or pass trace=False").into(),
            _ => input.into(),
        }
    }

    /// The jacobian of a function that is called.
    fn with_jacobian(&self, part: Part, jacobian: Option<&Py<Function>>) -> Part {
        Part { jacobian: jacobian.map(|function| function.get().0.again(self.py)), ..part }
    }

    /// A continuous model.
    pub fn continuous(
        &mut self,
        drift: &Given,
        diffusion: &Given,
        noises: usize,
        varies: Varies,
        jacobian: Option<&Py<Function>>,
    ) -> Result<Continuous> {
        let n = self.states.len();
        let entries = n.saturating_mul(noises);
        if drift.is_called() || diffusion.is_called() || jacobian.is_some() {
            let drift = self.part("drift", drift, [n, 1], [true, false])?;
            let (drift, nodes) = (self.with_jacobian(drift, jacobian), self.nodes(diffusion)?);
            let found = self.graph.inner().inputs_of_all(&nodes);
            let of = |input: &Named| match input {
                Named::State(_) => Varies::WithState,
                Named::Time => Varies::WithTime,
                _ => Varies::Never,
            };
            let own = found.iter().map(of).max().unwrap_or(Varies::Never);
            let varies = if diffusion.is_called() { varies } else { own };
            let diffusion = self.part("diffusion", diffusion, [n, noises], [true, false])?;
            let (controls, parameters) = (self.controls, self.parameters.len());
            let called =
                continuous::Called { states: n, noises, controls, parameters, drift, diffusion, varies };
            return Ok(Continuous::called(called, self.parameters.to_vec()));
        }
        let (drift, diffusion) = (self.nodes(drift)?, self.nodes(diffusion)?);
        length("diffusion", "the entries of the diffusion", entries, diffusion.len())?;
        let parts = SdeParts {
            states: n,
            controls: self.controls,
            parameters: self.parameters.to_vec(),
            drift,
            diffusion,
            noises,
        };
        let model = ModelSde::new(self.graph.inner(), parts);
        let model = model.map_err(|error| self.refused("drift", error))?;
        Ok(Continuous::traced(model, self.parameters.to_vec()))
    }

    /// A discrete model.
    pub fn discrete(
        &mut self,
        transition: &Given,
        noise_cov: &Given,
        period: Option<f64>,
        jacobian: Option<&Py<Function>>,
    ) -> Result<Discrete> {
        let n = self.states.len();
        if period.is_some_and(|period| !(period > 0.0 && period.is_finite())) {
            return Err(Input::new("step", "the step is not a positive number").into());
        }
        let none = matches!(noise_cov, Given::Nodes(nodes) if nodes.is_empty());
        if transition.is_called() || noise_cov.is_called() || jacobian.is_some() {
            let next = self.part("transition", transition, [n, 1], [true, true])?;
            let next = self.with_jacobian(next, jacobian);
            let zeros =
                Given::Nodes(Listed(vec![self.graph.inner().constant(0.0).number(); n.saturating_mul(n)]));
            let noise_cov = if none { &zeros } else { noise_cov };
            let noise_cov = self.part("noise_cov", noise_cov, [n, n], [false, true])?;
            let (controls, parameters) = (self.controls, self.parameters.len());
            let called = discrete::Called { states: n, controls, parameters, period, next, noise_cov };
            return Ok(Discrete::called(called, self.parameters.to_vec()));
        }
        let parts = TransitionParts {
            states: n,
            controls: self.controls,
            parameters: self.parameters.to_vec(),
            period,
            next: self.nodes(transition)?,
            noise_cov: self.nodes(noise_cov)?,
        };
        let model = ModelTransition::new(self.graph.inner(), parts);
        let model = model.map_err(|error| self.refused("transition", error))?;
        Ok(Discrete::traced(model, self.parameters.to_vec()))
    }

    /// What all sensors measure.
    pub fn sensors(&mut self, sensors: &[SensorParts]) -> Result<Sensing> {
        let mut angles = Vec::new();
        for sensor in sensors {
            let (k, name) = (sensor.columns.len(), &sensor.name);
            if sensor.std.is_some() == sensor.cov.is_some() {
                let message = format!("sensor `{name}` needs its noise: `std` or `cov`, and not both");
                return Err(Input::new("sensors", message).into());
            }
            if !sensor.angles.is_empty() {
                length("angles", &format!("the angles of sensor `{name}`"), k, sensor.angles.len())?;
            }
            let own = (0..k).map(|i| sensor.angles.get(i).copied().flatten());
            for (period, column) in own.clone().zip(sensor.columns.iter()) {
                if period.is_some_and(|period| !(period > 0.0 && period.is_finite())) {
                    let message = format!("the period of the angle `{column}` is not a positive number");
                    return Err(Input::new("angles", message).of(Some(column)).into());
                }
            }
            angles.extend(own);
        }
        let called = |sensor: &SensorParts| {
            let noise = sensor.std.as_ref().or(sensor.cov.as_ref());
            sensor.measures.is_called() || noise.is_some_and(Given::is_called) || sensor.jacobian.is_some()
        };
        if sensors.iter().any(called) {
            let mut own = Vec::new();
            for sensor in sensors {
                let k = sensor.columns.len();
                let measures = self.part("measures", &sensor.measures, [k, 1], [true, false])?;
                let measures = self.with_jacobian(measures, sensor.jacobian.as_ref());
                let (noise, is_cov) = match (&sensor.std, &sensor.cov) {
                    (Some(std), _) => (self.part("std", std, [k, 1], [false, false])?, false),
                    (None, Some(cov)) => (self.part("cov", cov, [k, k], [false, false])?, true),
                    (None, None) => continue,
                };
                own.push(sensing::Sensor { measures, noise, is_cov });
            }
            let (states, controls, parameters) = (self.states.len(), self.controls, self.parameters.len());
            let called = sensing::Called { states, controls, parameters, sensors: own, angles };
            return Ok(Sensing::called(called));
        }
        let mut parts = ObservationParts {
            states: self.states.len(),
            controls: self.controls,
            parameters: self.parameters.len(),
            angles,
            ..ObservationParts::default()
        };
        for sensor in sensors {
            let measures = self.nodes(&sensor.measures)?;
            let name = &sensor.name;
            length(
                "measures",
                &format!("the measures of sensor `{name}`"),
                sensor.columns.len(),
                measures.len(),
            )?;
            parts.measures.extend(measures);
            let (k, nodes, block) = match (&sensor.std, &sensor.cov) {
                (Some(std), _) => {
                    let nodes = self.nodes(std)?;
                    (sensor.columns.len(), nodes.len(), NoiseBlock::Std(nodes))
                }
                (None, Some(cov)) => {
                    let (k, nodes) = (sensor.columns.len(), self.nodes(cov)?);
                    (k.saturating_mul(k), nodes.len(), NoiseBlock::Cov(nodes))
                }
                (None, None) => continue,
            };
            length("sensors", &format!("the noise of sensor `{name}`"), k, nodes)?;
            parts.noise.push(block);
        }
        let model = ModelObservation::new(self.graph.inner(), parts);
        Ok(Sensing::traced(model.map_err(|error| self.refused("sensors", error))?))
    }
}
