//! All settings of all time updates of a problem, against references.

use crate::predict::{Predicted, Problem, Setting, Way};
use givens::filter::predict::Velocity;
use givens::model::Sde;
use givens::ode::Solver;
use givens_tests::{cov_error, mean_error};

/// The time updates that solve an equation, with their names.
pub const SOLVED: [(Way, &str); 3] = [
    (Way::Moments, "moment equations"),
    (Way::LevelSet(Velocity::Averaged), "level set, averaged"),
    (Way::LevelSet(Velocity::Partial), "level set, partial"),
];

/// Those by substeps.
pub const SUBSTEPS: [(Way, &str); 2] =
    [(Way::ItoTaylor, "Itô–Taylor, full"), (Way::EulerMaruyama, "Euler–Maruyama")];

/// The steps of rk4 and the tolerance of rodas4 that a limit is compared with.
pub const FINE: usize = 1 << 14;
pub const TIGHT: f64 = 1e-12;

/// Errors of mean and covariance in standard deviations.
#[derive(Clone, Copy, Default)]
pub struct Errors {
    pub mean: f64,
    pub cov: f64,
}

impl Errors {
    fn of(found: &Predicted, exact: &Predicted) -> Self {
        Self {
            mean: mean_error(&found.mean, &exact.mean, &exact.cov),
            cov: cov_error(&found.cov, &exact.cov, exact.mean.len()),
        }
    }

    /// The larger one; infinite if one is no number.
    pub fn worst(self) -> f64 {
        if self.mean.is_nan() || self.cov.is_nan() { f64::INFINITY } else { self.mean.max(self.cov) }
    }
}

/// One setting that gave an answer.
pub struct Sample {
    pub setting: Setting,
    pub predicted: Predicted,
    /// Against the limit of its own equations; of a time update by substeps, against the moment equations.
    pub own: Errors,
    /// Against the moment equations.
    pub moments: Errors,
}

/// A time update by one solver, all settings.
pub struct Curve {
    pub way: Way,
    pub time_update: &'static str,
    /// None where a gap is divided into substeps.
    pub solver: Option<Solver>,
    /// Without the settings that ended in an error, or in no number.
    pub samples: Vec<Sample>,
}

/// The limit of a time update.
pub struct Limit {
    pub time_update: &'static str,
    /// How far [`FINE`] steps of rk4, and rodas4 at [`TIGHT`], are from it; NaN for an error.
    pub rk4: f64,
    pub rodas4: f64,
    /// How far the limit itself is from that of the moment equations.
    pub moments: Errors,
}

/// Everything about one problem.
pub struct Sweep {
    pub limits: Vec<Limit>,
    pub curves: Vec<Curve>,
}

/// Runs all of it.
pub fn sweep<M: Sde + Copy>(problem: &Problem<M>) -> Sweep {
    let exact = |way| problem.predict(way, Solver::Dp5, Setting::Rtol(1e-13), false).unwrap();
    let moments = exact(Way::Moments);
    let (mut limits, mut curves) = (Vec::new(), Vec::new());
    for (way, name) in SOLVED.into_iter().chain([(Way::LevelSet(Velocity::Cubature), "level set, cubature")])
    {
        let limit = exact(way);
        let other = |solver, setting| match problem.predict(way, solver, setting, false) {
            Ok(found) => Errors::of(&found, &limit).worst(),
            Err(_) => f64::NAN,
        };
        limits.push(Limit {
            time_update: name,
            rk4: other(Solver::Rk4, Setting::Steps(FINE)),
            rodas4: other(Solver::Rodas4, Setting::Rtol(TIGHT)),
            moments: Errors::of(&limit, &moments),
        });
        if way != Way::LevelSet(Velocity::Cubature) {
            curves
                .extend(Solver::ALL.map(|solver| curve(problem, way, name, Some(solver), &limit, &moments)));
        }
    }
    curves.extend(SUBSTEPS.map(|(way, name)| curve(problem, way, name, None, &moments, &moments)));
    Sweep { limits, curves }
}

fn curve<M: Sde + Copy>(
    problem: &Problem<M>,
    way: Way,
    time_update: &'static str,
    solver: Option<Solver>,
    limit: &Predicted,
    moments: &Predicted,
) -> Curve {
    let settings: Vec<Setting> = if solver.is_some_and(Solver::adaptive) {
        (2..=12).map(|digits| Setting::Rtol(0.1_f64.powi(digits))).collect()
    } else {
        (0..=problem.most.ilog2()).map(|power| Setting::Steps(1 << power)).collect()
    };
    let sample = |setting| {
        let predicted = problem.predict(way, solver.unwrap_or(Solver::Euler), setting, true).ok()?;
        let (own, moments) = (Errors::of(&predicted, limit), Errors::of(&predicted, moments));
        own.worst().is_finite().then_some(Sample { setting, predicted, own, moments })
    };
    Curve { way, time_update, solver, samples: settings.into_iter().filter_map(sample).collect() }
}
