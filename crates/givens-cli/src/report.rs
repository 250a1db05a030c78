//! What stderr says at the end: how much was done, how likely it was, how right; and what failed, by name.

use crate::message::{count, say};
use crate::method::title;
use crate::plan::Plan;
use crate::session::Session;
use givens::Estimates;
use givens::filter::{Fault, Matrix, Quantity, StepError};
use givens::metrics::{Accuracy, Consistency};
use givens::registry::FormName;
use givens_io::{Model, Row, Track};

/// The closing lines of a run.
pub fn closing(plan: &Plan, session: &Session) {
    let rows: usize = session.estimates().map(Estimates::len).sum();
    let tracks = plan.tracks.tracks.len();
    let of = if tracks == 1 { String::new() } else { format!(" of {tracks} tracks") };
    let (title, counted) = (title(&plan.choice), count(rows, "row"));
    if rows == 0 {
        say(&format!("{title}: no row{of} was finished"));
        return;
    }
    let consistency = Consistency::of(session.estimates());
    say(&format!("{title}: {counted}{of}, log-likelihood {:.3}, {consistency}", session.log_likelihood()));
    if let Some(accuracy) = session.accuracy(plan) {
        for line in accuracy_lines(&plan.model, &accuracy) {
            say(&line);
        }
    }
}

/// RMSE, coverage and NEES, a line for each state.
fn accuracy_lines(model: &Model, accuracy: &Accuracy) -> Vec<String> {
    let width = model.states.iter().map(|name| name.chars().count()).max().unwrap_or(0).max(5);
    let mut lines = vec![format!(
        "against the truth:\n  {:width$} {:>12} {:>12} {:>8}",
        "state", "RMSE", "within 2σ", "rows"
    )];
    for (i, name) in model.states.iter().enumerate() {
        if accuracy.rows[i] > 0 {
            let percent = 100.0 * accuracy.coverage[i];
            lines.push(format!(
                "  {name:width$} {:>12} {percent:>10.1} % {:>8}",
                digits(accuracy.rmse[i]),
                accuracy.rows[i]
            ));
        }
    }
    if accuracy.rows.iter().all(|&rows| rows == 0) {
        lines.push("  no row of the data stands at a time of the truth".into());
    } else {
        let per = accuracy.nees / accuracy.nees_dof;
        lines.push(format!(
            "  mean NEES {:.3} of {:.1} states known, {per:.3} per state (1 if the covariances are right; 2σ holds 95.4 %)",
            accuracy.nees, accuracy.nees_dof
        ));
    }
    lines
}

/// A number with five digits; a dash if it is none.
pub fn digits(x: f64) -> String {
    match x.abs() {
        size if size.is_nan() => "-".to_owned(),
        size if size != 0.0 && !(1e-3..1e6).contains(&size) => format!("{x:.4e}"),
        0.0 => "0".to_owned(),
        size => format!("{x:.*}", (4 - size.log10().floor() as i32).max(0) as usize),
    }
}

/// Where something failed: the row of a table, and the track and the time.
pub fn place(data: &str, track: &Track, row: &Row, time: f64) -> String {
    let name = track.id.as_ref().map_or(String::new(), |id| format!("track {id}, "));
    format!("{data}:{}: {name}t = {}", row.line, track.time_text(time))
}

/// Why a step failed, by the names of the model; `what` was at work at `place`, in this form if it has one.
pub fn failure(model: &Model, place: &str, what: &str, form: Option<FormName>, error: &StepError) -> String {
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
        Fault::NotFinite { quantity, component } => match quantity {
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
