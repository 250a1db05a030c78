//! Ways out.

use super::Explain;
use crate::filter::Matrix;
use crate::registry::{Choice, FormName, Kind, RuleName};

impl Explain<'_> {
    /// The way out of a point where a model has no derivative.
    pub(super) fn without_derivatives(&self) -> String {
        let plain = self.face.method(self.plain());
        format!("use a method without derivatives ({plain}), or start off that point")
    }

    /// A method without derivatives and without negative weights for this model.
    fn plain(&self) -> &'static str {
        match self.kind {
            Kind::Discrete => "sr-ckf",
            Kind::Continuous => "sr-cd-ckf2",
        }
    }

    /// The way out of points that cannot be told from their mean.
    pub(super) fn apart(&self, choice: Option<&Choice>) -> String {
        let origin = "measure it from a nearer origin, or make its std zero if it is known";
        let near =
            choice.is_some_and(|choice| choice.rule == RuleName::Unscented && choice.unscented.alpha < 1.0);
        if near {
            return format!(
                "set the points further from the mean ({}), or {origin}",
                self.face.set("alpha", "1")
            );
        }
        origin.to_owned()
    }

    /// The way out of a covariance that does not exist.
    pub(super) fn of_matrix(&self, matrix: Matrix, choice: Option<&Choice>) -> String {
        match matrix {
            Matrix::ProcessNoise | Matrix::MeasurementNoise => {
                return "check its expressions at this time".to_owned();
            }
            Matrix::Prior => return "check the initial covariance".to_owned(),
            _ => {}
        }
        let set = |key, value| self.face.set(key, value);
        let negative =
            choice.is_none_or(|choice| matches!(choice.rule, RuleName::Unscented | RuleName::Cubature5));
        let rotated =
            choice.is_some_and(|choice| choice.form == FormName::SquareRoot && !choice.time_update.solves());
        if matrix == Matrix::Predicted && rotated && !negative {
            // a root by rotations fails for nothing else
            return "a standard deviation is too large to be squared (1e154): does the model run away? Or use other units"
                .to_owned();
        }
        let mut ways = Vec::new();
        let by_equal_steps = |choice: &Choice| {
            choice.time_update.solves() && !choice.integrator.solver.adaptive() && matrix == Matrix::Predicted
        };
        if choice.is_some_and(by_equal_steps) {
            let (more, adapts) = (set("substeps", "…"), set("solver", "dp5"));
            ways.push(format!("more steps ({more}) or a solver that adapts them ({adapts})"));
        }
        match choice.map(|choice| choice.form) {
            Some(FormName::SquareRoot) if matrix == Matrix::Conditional => {
                ways.push(format!("smoothing in covariance form ({})", set("form", "covariance")));
            }
            Some(FormName::Covariance) => {
                ways.push(format!("the square-root form ({})", set("form", "square-root")));
            }
            _ => {}
        }
        if negative {
            ways.push(format!("a rule without negative weights ({})", self.face.method(self.plain())));
        }
        ways.push("more noise".to_owned());
        format!("try {}", ways.join(", or "))
    }
}
