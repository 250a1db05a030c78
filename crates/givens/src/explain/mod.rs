//! Why a step failed, in the names of a model: what every face of the package tells its users.

mod doubt;
mod not_finite;
mod remedy;
mod single;

use crate::filter::{Fault, Halt, Matrix};
use crate::ode::Solver;
use crate::registry::{Choice, FormName, Kind};

/// Who speaks: options are set in one way on the command line and in another in Python.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// `--set substeps=…`, `--method sr-ckf`.
    Command,
    /// `substeps=…`, `method="sr-ckf"`.
    Python,
}

impl Face {
    /// How an option is set.
    fn set(self, key: &str, value: &str) -> String {
        match self {
            Face::Command => format!("--set {key}={value}"),
            Face::Python if value == "…" => format!("{key}=…"),
            Face::Python => format!("{key}=\"{value}\""),
        }
    }

    /// How a method is named.
    fn method(self, name: &str) -> String {
        match self {
            Face::Command => format!("--method {name}"),
            Face::Python => self.set("method", name),
        }
    }
}

/// What is told of a failed step.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Told {
    /// What went wrong.
    pub what: String,
    /// What to do about it.
    pub remedy: Option<String>,
    /// The state or measure concerned.
    pub component: Option<String>,
}

impl core::fmt::Display for Told {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.what.fmt(f)?;
        self.remedy.as_ref().map_or(Ok(()), |remedy| write!(f, "; {remedy}"))
    }
}

/// A model's names, and how its users speak.
///
/// ```
/// use givens::explain::{Explain, Face};
/// use givens::filter::{Fault, Matrix};
/// use givens::registry::Kind;
///
/// let explain = Explain { face: Face::Python, kind: Kind::Discrete, states: &["x", "vx"], measures: &["range"] };
/// let told = explain.told(None, &Fault::NotPositive { matrix: Matrix::Innovation, pivot: 0 });
/// assert_eq!(told.what, "the innovation covariance is not positive definite at pivot 1 (measure `range`)");
/// assert!(told.remedy.is_some_and(|remedy| remedy.contains("method=\"sr-ckf\"")));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Explain<'a> {
    /// Who speaks.
    pub face: Face,
    /// What the model's time is.
    pub kind: Kind,
    /// The names of the states.
    pub states: &'a [&'a str],
    /// The names of the measures of all sensors.
    pub measures: &'a [&'a str],
}

impl Explain<'_> {
    /// A fault with the model's own names, of this method if it has one.
    pub fn told(&self, choice: Option<&Choice>, fault: &Fault) -> Told {
        let component = self.component(fault).map(str::to_owned);
        let (what, remedy) = match *fault {
            Fault::Unrepresentable { quantity, component, value } => {
                (self.unrepresentable(quantity, component, value), Some("choose other units".to_owned()))
            }
            _ => self.words(choice, fault),
        };
        let remedy = if single::rounded(choice, fault) { Some(self.or_in_double(remedy)) } else { remedy };
        Told { what, remedy, component }
    }

    /// The name of the state or measure concerned.
    fn component(&self, fault: &Fault) -> Option<&str> {
        let (names, i) = match *fault {
            Fault::NotPositive { matrix, pivot } if of_measures(matrix) => (self.measures, pivot),
            Fault::SingularInnovation { measure } => (self.measures, measure),
            Fault::NotFinite { quantity, component } | Fault::Unrepresentable { quantity, component, .. } => {
                match not_finite::of_what(quantity)? {
                    not_finite::Of::State => (self.states, component),
                    not_finite::Of::Measure => (self.measures, component),
                }
            }
            Fault::NotPositive { pivot, .. } | Fault::SingularFactor { pivot } => (self.states, pivot),
            Fault::Indistinct { component } | Fault::Unresolved { component } => (self.states, component),
            _ => return None,
        };
        names.get(i).copied()
    }

    fn state(&self, i: usize) -> String {
        self.states.get(i).map_or_else(|| (i + 1).to_string(), |name| format!("`{name}`"))
    }

    fn measure(&self, i: usize) -> String {
        self.measures.get(i).map_or_else(|| (i + 1).to_string(), |name| format!("`{name}`"))
    }

    fn words(&self, choice: Option<&Choice>, fault: &Fault) -> (String, Option<String>) {
        let set = |key, value| self.face.set(key, value);
        let (what, remedy) = match *fault {
            Fault::NotPositive { matrix, pivot } => {
                let (kind, name) = if of_measures(matrix) {
                    ("measure", self.measure(pivot))
                } else {
                    ("state", self.state(pivot))
                };
                let what = format!(
                    "the {} is not positive definite at pivot {} ({kind} {name})",
                    matrix.name(),
                    pivot + 1
                );
                (what, self.of_matrix(matrix, choice))
            }
            Fault::SingularInnovation { measure } => {
                let what = format!(
                    "the innovation covariance is singular at pivot {} (measure {}): nothing is uncertain about it",
                    measure + 1,
                    self.measure(measure)
                );
                if choice.is_none_or(|choice| choice.form == FormName::SquareRoot) {
                    return (what, Some("give it a std above zero".to_owned()));
                }
                let form = set("form", "square-root");
                let remedy = format!("give it a std above zero, or try the square-root form ({form})");
                (format!("{what} that the others do not say, to the digits that a covariance keeps"), remedy)
            }
            Fault::Indistinct { component } => {
                let what = format!(
                    "the std of {} is a few spacings of numbers at its mean, or less: rounding would decide what becomes \
                     of it",
                    self.state(component)
                );
                (what, self.apart(choice))
            }
            Fault::NotFinite { quantity, component } => match self.not_finite(choice, quantity, component) {
                Some((what, remedy)) => (what, remedy),
                None => return (fault.to_string(), None),
            },
            Fault::Unresolved { component } => {
                let what = format!(
                    "the steps are too long for the way back of {}, which a filter alone need not show",
                    self.state(component)
                );
                let (more, chosen) = (set("substeps", "…"), set("solver", "dp5"));
                (what, format!("more steps ({more}) or a solver that chooses them ({chosen})"))
            }
            Fault::SingularFactor { pivot } => {
                let what = format!(
                    "the factor of the covariance is singular at pivot {} (state {}): it is known exactly, and this time \
                     update divides by the factor",
                    pivot + 1,
                    self.state(pivot)
                );
                (what, format!("{} does not", set("time_update", "ito-taylor")))
            }
            Fault::Solver { why: Halt::StepLimit { limit }, smallest } => {
                let stiff = choice.is_some_and(|choice| choice.integrator.solver == Solver::Rodas4);
                let remedy = if stiff {
                    "loosen rtol, set atol, or give the states noise".to_owned()
                } else {
                    let rodas4 = set("solver", "rodas4");
                    format!("the drift is likely stiff: {rodas4} is for that; or loosen rtol")
                };
                let what = format!(
                    "the solver came no further than this time in its {limit} steps, the smallest of {smallest:.2e}"
                );
                (what, remedy)
            }
            Fault::Solver { why: Halt::StepTooSmall, smallest } => {
                let what = format!(
                    "the solver came no further than this time: no step of at least {smallest:.2e} meets the tolerance"
                );
                (what, "loosen rtol, or set atol".to_owned())
            }
            Fault::StateDependentDiffusion => {
                let named = self.face.method("sr-cd-ckf2");
                let what = "the diffusion depends on the state".to_owned();
                (what, format!("time updates for such a model are moment-ode ({named}) and euler-maruyama"))
            }
            Fault::Backwards { .. } => {
                let remedy = match self.face {
                    Face::Command => "give times in order",
                    Face::Python => "give times in order, or go on from a copy() made before that time",
                };
                (fault.to_string(), remedy.to_owned())
            }
            Fault::NotWholeSteps { .. } => {
                let remedy =
                    "put the times on whole steps, or write the transition in `dt` and leave `step` out";
                (fault.to_string(), remedy.to_owned())
            }
            Fault::ControlsNotSet { controls } if self.face == Face::Python => {
                (format!("the model has {controls} controls that were never set"), "give `u`".to_owned())
            }
            _ => return (fault.to_string(), None),
        };
        (what, Some(remedy))
    }
}

/// Whether the pivots of a matrix are measures.
fn of_measures(matrix: Matrix) -> bool {
    matches!(matrix, Matrix::Innovation | Matrix::MeasurementNoise)
}
