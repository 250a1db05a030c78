//! What failed, in the names of the model.

use givens::filter::{Fault, Matrix, Quantity, StepError};
use givens::registry::FormName;
use givens_io::{Model, Row, Track};

/// Where something failed: the row of a table, and the track and the time.
pub fn place(data: &str, track: &Track, row: &Row, time: f64) -> String {
    let name = track.id.as_ref().map_or(String::new(), |id| format!("track {id}, "));
    format!("{data}:{}: {name}t = {}", row.line, track.time_text(time))
}

/// Why a step failed, by the names of the model; `what` was at work at `place`, in this form if it has one.
pub fn told(model: &Model, place: &str, what: &str, form: Option<FormName>, error: &StepError) -> String {
    format!("{place}, step {}: the {what} failed: {}", error.step, fault(model, form, &error.fault))
}

/// A fault with the model's own names.
fn fault(model: &Model, form: Option<FormName>, fault: &Fault) -> String {
    let state =
        |i: usize| model.states.get(i).map_or_else(|| (i + 1).to_string(), |name| format!("`{name}`"));
    let columns: Vec<&String> = model.sensors.iter().flat_map(|sensor| &sensor.columns).collect();
    let measure = |i: usize| columns.get(i).map_or_else(|| (i + 1).to_string(), |name| format!("`{name}`"));
    match *fault {
        Fault::NotPositive { matrix, pivot } => {
            let (kind, name) = match matrix {
                Matrix::Innovation | Matrix::MeasurementNoise => ("measure", measure(pivot)),
                _ => ("state", state(pivot)),
            };
            let remedy = remedy(matrix, form);
            format!(
                "the {} is not positive definite at pivot {} ({kind} {name}); {remedy}",
                matrix.name(),
                pivot + 1
            )
        }
        Fault::SingularInnovation { measure: i } => format!(
            "the innovation covariance is singular at pivot {} (measure {}): nothing is uncertain about it; give it a \
             std above zero",
            i + 1,
            measure(i)
        ),
        Fault::Indistinct { component } => format!(
            "the std of {} is below the spacing of numbers at its mean: the points of the rule cannot be told from each \
             other; measure it from a nearer origin, or make its std zero if it is known",
            state(component)
        ),
        Fault::NotFinite { quantity, component } => match quantity {
            Quantity::TransitionDerivative => format!(
                "the derivative of the transition of {}, with respect to the state at the mean, is not a finite number; \
                 {SMOOTH}",
                state(component)
            ),
            Quantity::ObservationDerivative => format!(
                "the derivative of the predicted measure {}, with respect to the state at the mean, is not a finite \
                 number; {SMOOTH}",
                measure(component)
            ),
            Quantity::Transition | Quantity::Estimate | Quantity::ProcessNoise => {
                format!("the {} of {} is not a finite number; {DOMAIN}", quantity.name(), state(component))
            }
            Quantity::Observation | Quantity::MeasurementNoise | Quantity::Measurement => {
                format!("the {} {} is not a finite number; {DOMAIN}", quantity.name(), measure(component))
            }
            _ => fault.to_string(),
        },
        _ => fault.to_string(),
    }
}

/// Where numbers that are none come from.
const DOMAIN: &str =
    "look for a division by zero, the root of a negative number, or an estimate that runs away";

/// The way out of a point where a model has no derivative.
const SMOOTH: &str = "use a method without derivatives (--method sr-ckf), or start off that point";

/// The way out of a covariance that does not exist.
fn remedy(matrix: Matrix, form: Option<FormName>) -> &'static str {
    match (matrix, form) {
        (Matrix::ProcessNoise | Matrix::MeasurementNoise, _) => "check its expressions at this time",
        (Matrix::Prior, _) => "check the initial covariance",
        (Matrix::Conditional, _) => {
            "smooth in covariance form (--set form=covariance), or by a rule without negative weights (sr-ckf)"
        }
        (_, Some(FormName::Covariance)) => {
            "try the square-root form (--set form=square-root), a rule without negative weights (ckf), or more noise"
        }
        _ => "try a rule without negative weights (sr-ckf), or more noise",
    }
}
