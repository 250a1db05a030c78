//! The tables, in Markdown.

use crate::predict::Setting;
use crate::sweep::{Curve, Sample, Sweep};

const GOALS: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-8];

/// Evaluations for an error, and everything about the default setting.
pub fn curves(sweep: &Sweep) {
    println!(
        "| time update | solver | 1e-2 | 1e-4 | 1e-6 | 1e-8 | drift | slopes | Jacobians | steps | error of mean | error of cov | time, µs |"
    );
    println!("|---|---|{}", "--:|".repeat(11));
    for curve in &sweep.curves {
        let least = GOALS.map(|goal| {
            let good = curve.samples.iter().filter(|sample| sample.own.worst() <= goal);
            let least = good.map(|sample| sample.predicted.evaluations).min();
            least.map_or("–".to_owned(), |count| count.to_string())
        });
        let solver = curve.solver.map_or("substeps", givens::ode::Solver::name);
        println!("| {} | {solver} | {} | {} |", curve.time_update, least.join(" | "), default(curve));
    }
}

/// Sixteen steps, or a tolerance of 1e-6.
fn default(curve: &Curve) -> String {
    let wanted = |sample: &&Sample| match sample.setting {
        Setting::Steps(count) => count == 16,
        Setting::Rtol(rtol) => (rtol / 1e-6 - 1.0).abs() < 1e-9,
    };
    let Some(Sample { predicted, own, .. }) = curve.samples.iter().find(wanted) else {
        return "– | – | – | – | fails | fails | –".to_owned();
    };
    let work = predicted.work;
    let (slopes, jacobians, steps) = match curve.solver {
        None => ("–".to_owned(), "–".to_owned(), "16".to_owned()),
        Some(_) => {
            let rejected = if work.rejected > 0 { format!(" + {}", work.rejected) } else { String::new() };
            (work.calls.to_string(), work.jacobians.to_string(), format!("{}{rejected}", work.accepted))
        }
    };
    format!(
        "{} | {slopes} | {jacobians} | {steps} | {:.0e} | {:.0e} | {:.1}",
        predicted.evaluations, own.mean, own.cov, predicted.microseconds
    )
}

/// The limits: how well they are known, and how far apart they are.
pub fn limits<'s>(sweeps: impl Iterator<Item = (&'s str, &'s Sweep)>) {
    println!("| model | time update | rk4 | rodas4 | mean | covariance |");
    println!("|---|---|--:|--:|--:|--:|");
    for (model, sweep) in sweeps {
        for limit in &sweep.limits {
            let known = |error: f64| match error {
                0.0 => "0".to_owned(),
                _ if error.is_nan() => "fails".to_owned(),
                _ => format!("{error:.0e}"),
            };
            println!(
                "| {model} | {} | {} | {} | {} | {} |",
                limit.time_update,
                known(limit.rk4),
                known(limit.rodas4),
                known(limit.moments.mean),
                known(limit.moments.cov)
            );
        }
        for curve in sweep.curves.iter().filter(|curve| curve.solver.is_none()) {
            if let Some(Sample { setting: Setting::Steps(count), moments, .. }) = curve.samples.last() {
                let name = format!("{}, {count} substeps", curve.time_update);
                println!("| {model} | {name} | | | {:.0e} | {:.0e} |", moments.mean, moments.cov);
            }
        }
    }
}
