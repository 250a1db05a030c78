//! The one place where what went wrong becomes a Python exception: those of `givens.errors`.

use givens::DataError;
use givens::filter::InvalidCovariance;
use givens::registry::SettingError;
use givens_expr::suggest;
use givens_io::InputErrors;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// An argument that cannot serve.
#[derive(Clone, Debug, Default)]
pub struct Input {
    message: String,
    argument: Option<&'static str>,
    row: Option<usize>,
    component: Option<String>,
    remedy: Option<String>,
}

/// Why a function of this module does not do what it was asked for.
#[derive(Debug)]
pub enum Refusal {
    /// `InputError`.
    Input(Box<Input>),
    /// `MethodError`: message, option, remedy.
    Method(String, Option<String>, Option<String>),
    /// `ModelError`.
    File(Box<InputErrors>),
    /// `StepError`, with its fields.
    Step(String, Option<String>, Py<PyDict>),
    /// An exception of Python's own, or of the user's functions.
    Raised(PyErr),
}

/// What the functions of this module give.
pub type Result<T> = core::result::Result<T, Refusal>;

impl Input {
    /// An argument, and what is wrong with it.
    pub fn new(argument: &'static str, message: impl Into<String>) -> Self {
        Self { message: message.into(), argument: Some(argument), ..Self::default() }
    }

    /// Something that is no argument.
    pub fn plain(message: impl Into<String>) -> Self {
        Self { message: message.into(), ..Self::default() }
    }

    /// At this row of the data.
    pub fn row(self, row: usize) -> Self {
        Self { row: Some(row), ..self }
    }

    /// Of this state, measure, control or parameter.
    pub fn of(self, component: Option<&String>) -> Self {
        Self { component: component.cloned(), ..self }
    }

    /// What to do about it.
    pub fn help(self, remedy: impl Into<String>) -> Self {
        Self { remedy: Some(remedy.into()), ..self }
    }
}

impl From<Input> for Refusal {
    fn from(input: Input) -> Self {
        Refusal::Input(Box::new(input))
    }
}

impl From<Input> for PyErr {
    fn from(input: Input) -> Self {
        Refusal::from(input).into()
    }
}

impl From<PyErr> for Refusal {
    fn from(error: PyErr) -> Self {
        Refusal::Raised(error)
    }
}

impl From<InputErrors> for Refusal {
    fn from(errors: InputErrors) -> Self {
        Refusal::File(Box::new(errors))
    }
}

/// An argument of the wrong length.
pub fn length(argument: &'static str, what: &str, expected: usize, found: usize) -> Result<()> {
    if expected == found {
        return Ok(());
    }
    Err(Input::new(argument, format!("{what}: {expected} expected, {found} found")).into())
}

/// A method or an option that the registry refuses; `keys` are those of the settings.
pub fn setting(error: SettingError, keys: &[String]) -> Refusal {
    let nearest = |(word, known): &(String, Vec<&'static str>)| match suggest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("one of: {}", known.join(", ")),
    };
    let remedy = error.help.clone().or_else(|| error.unknown.as_ref().map(nearest));
    let option = error.setting.and_then(|at| keys.get(at).cloned());
    Refusal::Method(error.message, option, remedy)
}

/// A row of the data that cannot serve; the measures by name.
pub fn data(error: DataError, measures: &[&String]) -> Refusal {
    let input = match error {
        DataError::Time { row, time, .. } => {
            Input::new("t", error.to_string()).row(row).help(if time.is_finite() {
                "times increase from `t0` on; sort the rows, or start earlier"
            } else {
                "give its time, or leave the row out"
            })
        }
        DataError::Infinite { row, component } => {
            let name = measures.get(component).copied();
            let shown = name.map_or_else(|| component.to_string(), |name| format!("`{name}`"));
            Input::new("z", format!("row {row}: measure {shown} is infinite"))
                .row(row)
                .of(name)
                .help("a missing component is NaN")
        }
        DataError::Length { row, .. } => Input::new("z", error.to_string()).row(row),
    };
    input.into()
}

/// A matrix that is no covariance, or a mean that is not finite.
pub fn covariance(argument: &'static str, error: InvalidCovariance, states: &[String]) -> Refusal {
    let (at, what) = match error {
        InvalidCovariance::NotFinite { row, column } => {
            (Some(row), format!("is not finite at [{row}, {column}]"))
        }
        InvalidCovariance::Asymmetric { row, column } => {
            (Some(row), format!("is not symmetric: [{row}, {column}] and [{column}, {row}] differ"))
        }
        InvalidCovariance::Indefinite { pivot } => {
            (Some(pivot), format!("is not positive semidefinite at pivot {} of {}", pivot + 1, states.len()))
        }
        InvalidCovariance::Length { .. } => (None, format!("has not the shape of one: {error}")),
    };
    let name = at.and_then(|at| states.get(at));
    let of = name.map_or_else(String::new, |name| format!(" (state `{name}`)"));
    let help = "a covariance is finite and symmetric, has no negative variance and no correlation above one";
    Input::new(argument, format!("the initial covariance {what}{of}")).of(name).help(help).into()
}

impl From<Refusal> for PyErr {
    fn from(refusal: Refusal) -> PyErr {
        let name = match &refusal {
            Refusal::Input(_) => "InputError",
            Refusal::Method(..) => "MethodError",
            Refusal::File(_) => "ModelError",
            Refusal::Step(..) => "StepError",
            Refusal::Raised(_) => "",
        };
        Python::attach(|py| match refusal {
            Refusal::Raised(error) => error,
            other => exception(py, name, other).unwrap_or_else(|error| error),
        })
    }
}

/// Makes the exception of this name.
fn exception(py: Python<'_>, name: &str, refusal: Refusal) -> PyResult<PyErr> {
    let fields = PyDict::new(py);
    let text = match refusal {
        Refusal::Input(input) => {
            fields.set_item(intern!(py, "argument"), input.argument)?;
            fields.set_item(intern!(py, "row"), input.row)?;
            fields.set_item(intern!(py, "component"), input.component)?;
            fields.set_item(intern!(py, "remedy"), input.remedy)?;
            input.message
        }
        Refusal::Method(message, option, remedy) => {
            fields.set_item(intern!(py, "option"), option)?;
            fields.set_item(intern!(py, "remedy"), remedy)?;
            message
        }
        Refusal::File(errors) => {
            if let Some(first) = errors.first() {
                let place = first.place.as_ref();
                fields.set_item(intern!(py, "file"), &first.file)?;
                fields.set_item(intern!(py, "line"), place.map(|place| place.line))?;
                fields.set_item(intern!(py, "column"), place.map(|place| place.column))?;
            }
            errors.to_string()
        }
        Refusal::Step(message, remedy, known) => {
            fields.update(known.bind(py).as_mapping())?;
            fields.set_item(intern!(py, "remedy"), remedy)?;
            message
        }
        Refusal::Raised(error) => return Ok(error),
    };
    let class = py.import(intern!(py, "givens.errors"))?.getattr(name)?;
    Ok(PyErr::from_value(class.call((text,), Some(&fields))?))
}
