//! Methods by name.

use givens::filter::Block;
use givens::registry::{
    Choice as Chosen, ENTRIES, FormName, Kind, OPTIONS, RuleName, Setting, Value, default_method, resolve,
};
use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString};

use crate::errors::{Input, Refusal, Result, setting};
use crate::model::Model;

/// A method with its parts and options; see the stub.
#[pyclass(module = "givens._native", frozen)]
#[derive(Clone, Copy, Debug)]
pub struct Choice(pub Chosen);

/// The value of an option.
fn value(key: &str, given: &Bound<'_, PyAny>) -> Result<Value> {
    if given.is_instance_of::<PyBool>() {
        return Ok(Value::Word(given.extract::<bool>()?.to_string()));
    }
    if let Ok(word) = given.cast::<PyString>() {
        return Ok(Value::Word(word.to_string_lossy().into_owned()));
    }
    let is_number = given.is_instance_of::<PyInt>() || given.is_instance_of::<PyFloat>();
    match given.extract::<f64>() {
        Ok(number) if is_number || given.hasattr("__float__").unwrap_or(false) => Ok(Value::Number(number)),
        Err(error) if error.is_instance_of::<PyOverflowError>(given.py()) => {
            let message = format!("`{key}` is a number beyond 1.8e308");
            Err(Refusal::Method(message, Some(key.to_owned()), Some("give a smaller one".to_owned())))
        }
        _ => {
            let found = given.get_type().name()?.to_string();
            let message = format!("`{key}` is a number or a word, not {found}");
            Err(Refusal::Method(message, Some(key.to_owned()), None))
        }
    }
}

/// What the time of a model is, by its word.
pub fn kind(word: &str) -> Result<Kind> {
    let unknown = || Input::new("kind", format!("kind = {word}: discrete or continuous"));
    Ok(Kind::parse(word).ok_or_else(unknown)?)
}

#[pymethods]
impl Choice {
    #[new]
    #[pyo3(signature = (method, options, kind))]
    fn new(method: Option<&str>, options: &Bound<'_, PyDict>, kind: &str) -> Result<Self> {
        let kind = self::kind(kind)?;
        let mut settings = Vec::new();
        for (key, given) in options {
            let key: String = key.extract()?;
            let value = value(&key, &given)?;
            settings.push(Setting { key, value });
        }
        let keys: Vec<String> = settings.iter().map(|setting| setting.key.clone()).collect();
        let method = method.unwrap_or(default_method(kind));
        let choice = resolve(method, &settings).map_err(|error| setting(error, &keys))?;
        choice.serves(kind).map_err(|error| setting(error, &keys))?;
        Ok(Self(choice))
    }

    /// The name of the registry.
    #[getter]
    fn name(&self) -> &'static str {
        self.0.name
    }

    /// The name, and the parts that were set otherwise.
    #[getter]
    fn title(&self) -> String {
        self.0.title()
    }

    /// The probability of its gate, if it has one.
    #[getter]
    fn gate(&self) -> Option<f64> {
        self.0.gate
    }

    #[getter(kind)]
    fn get_kind(&self) -> &'static str {
        self.0.kind().word()
    }

    /// Parts and options with their values, for a model of so many states.
    fn parts<'py>(&self, py: Python<'py>, states: usize) -> PyResult<Bound<'py, PyDict>> {
        let choice = &self.0;
        let parts = PyDict::new(py);
        parts.set_item("rule", choice.rule.word())?;
        match choice.rule {
            RuleName::Unscented => {
                let rule = choice.unscented;
                parts.set_item("alpha", rule.alpha)?;
                parts.set_item("beta", rule.beta)?;
                parts.set_item("kappa", rule.kappa.unwrap_or(3.0 - states as f64))?;
            }
            RuleName::GaussHermite => parts.set_item("points", choice.gauss_hermite.points)?,
            RuleName::CentralDifference => parts.set_item("eta", choice.central_difference.eta)?,
            RuleName::Cubature3 | RuleName::Cubature5 | RuleName::Taylor => {}
        }
        parts.set_item("form", choice.form.word())?;
        if choice.form == FormName::SquareRoot {
            let update = if choice.block == Block::Joint { "joint" } else { "separate" };
            parts.set_item("update", update)?;
        }
        parts.set_item("precision", choice.precision.word())?;
        if let Some(gate) = choice.gate {
            parts.set_item("gate", gate)?;
        }
        parts.set_item("time_update", choice.time_update.word())?;
        for (key, value) in choice.time_options() {
            match value.parse::<f64>() {
                Ok(number) if key == "substeps" => parts.set_item(key, number as usize)?,
                Ok(number) => parts.set_item(key, number)?,
                Err(_) => parts.set_item(key, value)?,
            }
        }
        Ok(parts)
    }

    /// Refuses the method if it does not go with the model.
    fn check(&self, model: &Model) -> Result<()> {
        model.serves(&self.0)
    }

    fn __repr__(&self) -> String {
        format!("Choice({})", self.0.name)
    }
}

/// The registry: one dict for each method.
#[pyfunction]
pub fn methods(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
    let all = PyList::empty(py);
    for entry in ENTRIES {
        let one = PyDict::new(py);
        one.set_item("name", entry.name)?;
        one.set_item("aliases", entry.aliases)?;
        one.set_item("about", entry.about)?;
        one.set_item("kind", entry.kind().word())?;
        one.set_item("rule", entry.rule.word())?;
        one.set_item("form", entry.form.word())?;
        one.set_item("time_update", entry.time_update.word())?;
        one.set_item("sources", entry.sources)?;
        let preset = resolve(entry.name, &[]).ok();
        let read = OPTIONS.iter().filter(|info| preset.is_some_and(|choice| info.reader.reads(&choice)));
        one.set_item("options", read.map(|info| info.key).collect::<Vec<_>>())?;
        all.append(one)?;
    }
    Ok(all)
}

/// Every part and option: (name, what it is, who reads it).
#[pyfunction]
pub fn options() -> Vec<(&'static str, &'static str, &'static str)> {
    OPTIONS.iter().map(|info| (info.key, info.about, info.reader.word())).collect()
}
