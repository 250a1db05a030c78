//! What failed, in the names of the model.

use crate::message::digits;
use givens::filter::{Fault, Halt, Matrix, Quantity, StepError};
use givens::ode::Solver;
use givens::registry::{Choice, FormName, RuleName, TimeName};
use givens_io::{Dynamics, Model, Row, Track};

/// Where something failed: the row of a table, and the track and the time.
pub fn place(data: &str, track: &Track, row: &Row, time: f64) -> String {
    let name = track.id.as_ref().map_or(String::new(), |id| format!("track {id}, "));
    format!("{data}:{}: {name}t = {}", row.line, track.time_text(time))
}

/// Why a step failed, by the names of the model; `what` was at work at `place`, by this method if it has one.
pub fn told(model: &Model, place: &str, what: &str, choice: Option<&Choice>, error: &StepError) -> String {
    format!("{place}, step {}: the {what} failed: {}", error.step, fault(model, choice, &error.fault))
}

/// A fault with the model's own names.
fn fault(model: &Model, choice: Option<&Choice>, fault: &Fault) -> String {
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
            let remedy = remedy(model, matrix, choice);
            format!(
                "the {} is not positive definite at pivot {} ({kind} {name}); {remedy}",
                matrix.name(),
                pivot + 1
            )
        }
        Fault::SingularInnovation { measure: i } => {
            let remedy = match choice.map(|choice| choice.form) {
                Some(FormName::Covariance) => {
                    "nothing is uncertain about it that the others do not say, to the digits that a covariance keeps; give \
                     it a std above zero, or try the square-root form (--set form=square-root)"
                }
                _ => "nothing is uncertain about it; give it a std above zero",
            };
            format!(
                "the innovation covariance is singular at pivot {} (measure {}): {remedy}",
                i + 1,
                measure(i)
            )
        }
        Fault::Indistinct { component } => format!(
            "the std of {} is below the spacing of numbers at its mean: the points of the rule cannot be told from each \
             other; measure it from a nearer origin, or make its std zero if it is known",
            state(component)
        ),
        Fault::NotFinite { quantity, component } => {
            let names = (state(component), measure(component));
            not_finite(model, choice, quantity, names).unwrap_or_else(|| fault.to_string())
        }
        Fault::Unresolved { component } => format!(
            "the steps are too long for the way back of {}, which a filter alone need not show; more steps (--set \
             substeps=…) or a solver that chooses them (--set solver=dp5)",
            state(component)
        ),
        Fault::SingularFactor { pivot } => format!(
            "the factor of the covariance is singular at pivot {} (state {}): it is known exactly, and this time update \
             divides by the factor; --set time_update=ito-taylor does not",
            pivot + 1,
            state(pivot)
        ),
        Fault::Solver { why: Halt::StepLimit { limit }, smallest } => {
            let stiff = choice.is_some_and(|choice| choice.integrator.solver == Solver::Rodas4);
            let remedy = if stiff {
                "loosen rtol, set atol, or give the states noise"
            } else {
                "the drift is likely stiff: --set solver=rodas4 is for that; or loosen rtol"
            };
            format!(
                "the solver came no further than this time in its {limit} steps, the smallest of {smallest:.2e}; {remedy}"
            )
        }
        Fault::Solver { why: Halt::StepTooSmall, smallest } => format!(
            "the solver came no further than this time: no step of at least {smallest:.2e} meets the tolerance; loosen \
             rtol, or set atol"
        ),
        _ => fault.to_string(),
    }
}

/// The mean from which a step set out that failed on a number or in a solver; nothing for other faults.
pub fn set_out(model: &Model, mean: &[f64], fault: &Fault) -> String {
    if mean.is_empty() || !matches!(fault, Fault::NotFinite { .. } | Fault::Solver { .. }) {
        return String::new();
    }
    let values = model.states.iter().zip(mean).map(|(name, x)| format!("{name} = {}", digits(*x)));
    format!("\n  the step set out from {}", values.collect::<Vec<_>>().join(", "))
}

/// Where numbers that are none come from.
const DOMAIN: &str =
    "look for a division by zero, the root of a negative number, or an estimate that runs away";

/// A quantity that is not a finite number, of this state or of this measure; none that has no more words than its own.
fn not_finite(
    model: &Model,
    choice: Option<&Choice>,
    quantity: Quantity,
    (state, measure): (String, String),
) -> Option<String> {
    Some(match quantity {
        Quantity::TransitionDerivative => format!(
            "the derivative of the transition of {}, with respect to the state at the mean, is not a finite number; \
                 {}",
            state,
            smooth(model)
        ),
        Quantity::ObservationDerivative => format!(
            "the derivative of the predicted measure {}, with respect to the state at the mean, is not a finite \
                 number; {}",
            measure,
            smooth(model)
        ),
        Quantity::DriftDerivative => format!(
            "a derivative of the drift of {state}, with respect to the state, is not a finite number; use a method \
             without derivatives (--method sr-cd-ckf2), or start off that point"
        ),
        Quantity::Drift if choice.is_some_and(|choice| choice.time_update == TimeName::ItoTaylor) => {
            format!(
                "the drift of {}, or a derivative of it in the expansion, is not a finite number; {DOMAIN}{}",
                state,
                too_long(choice)
            )
        }
        Quantity::Transition
        | Quantity::Drift
        | Quantity::Diffusion
        | Quantity::Estimate
        | Quantity::ProcessNoise => {
            format!(
                "the {} of {} is not a finite number; {DOMAIN}{}",
                quantity.name(),
                state,
                too_long(choice)
            )
        }
        Quantity::Observation | Quantity::MeasurementNoise | Quantity::Measurement => {
            format!("the {} {} is not a finite number; {DOMAIN}", quantity.name(), measure)
        }
        _ => return None,
    })
}

/// What equal steps in continuous time may have done besides.
fn too_long(choice: Option<&Choice>) -> &'static str {
    match choice.map(|choice| (choice.time_update, choice.integrator.solver.adaptive())) {
        Some(
            (TimeName::ItoTaylor | TimeName::EulerMaruyama, _)
            | (TimeName::MomentOde | TimeName::LevelSet, false),
        ) => {
            "; or the steps are too long for the drift: --set max_step=… bounds them, and --set time_update=moment-ode \
             with --set solver=rodas4 is for stiff drifts"
        }
        _ => "",
    }
}

/// The way out of a point where a model has no derivative.
fn smooth(model: &Model) -> String {
    format!("use a method without derivatives (--method {}), or start off that point", plain(model))
}

/// A method without negative weights, of either form's kind, for this model.
fn plain(model: &Model) -> &'static str {
    match model.dynamics {
        Dynamics::Discrete(_) => "sr-ckf",
        Dynamics::Continuous(_) => "sr-cd-ckf2",
    }
}

/// The way out of a covariance that does not exist.
fn remedy(model: &Model, matrix: Matrix, choice: Option<&Choice>) -> String {
    match matrix {
        Matrix::ProcessNoise | Matrix::MeasurementNoise => {
            return "check its expressions at this time".to_owned();
        }
        Matrix::Prior => return "check the initial covariance".to_owned(),
        _ => {}
    }
    let mut ways = Vec::new();
    let form = choice.map(|choice| choice.form);
    let solves = choice.is_some_and(|choice| choice.time_update.solves());
    if solves
        && matrix == Matrix::Predicted
        && choice.is_some_and(|choice| !choice.integrator.solver.adaptive())
    {
        ways.push("more steps (--set substeps=…) or a solver that adapts them (--set solver=dp5)".to_owned());
    }
    match form {
        Some(FormName::SquareRoot) if matrix == Matrix::Conditional => {
            ways.push("smoothing in covariance form (--set form=covariance)".to_owned());
        }
        Some(FormName::Covariance) => ways.push("the square-root form (--set form=square-root)".to_owned()),
        _ => {}
    }
    if choice.is_none_or(|choice| matches!(choice.rule, RuleName::Unscented | RuleName::Cubature5)) {
        ways.push(format!("a rule without negative weights (--method {})", plain(model)));
    }
    ways.push("more noise".to_owned());
    format!("try {}", ways.join(", or "))
}
