//! Why an answer may be wrong, and what to do about it.

use super::{Explain, Told};
use crate::doubt::{Doubt, Doubtful};
use crate::filter::predict::Variant;
use crate::ode::Steps;
use crate::registry::{Choice, FormName, Precision, TimeName};
use crate::scalar::Shown;

impl Explain<'_> {
    /// A doubt in words, of an answer of this method.
    pub fn doubt(&self, choice: &Choice, found: &Doubtful) -> Told {
        match found.doubt {
            Doubt::Steps { moved } => {
                Told { what: moves(moved), remedy: Some(self.finer(choice)), component: None }
            }
            Doubt::Shrunk { component } => {
                let what = format!(
                    "a measurement made the std of {} so small beside what it was that what is left may be rounding",
                    self.state(component)
                );
                self.of(component, what, choice)
            }
            Doubt::Bound { component } => {
                let what = format!(
                    "{} is known from the states before it better than a covariance can hold: how well may be rounding",
                    self.state(component)
                );
                self.of(component, what, choice)
            }
        }
    }

    fn of(&self, component: usize, what: String, choice: &Choice) -> Told {
        let exact = "it is right if a measurement had no noise, or one state is exactly that of others";
        let way = match (choice.form, choice.precision) {
            (FormName::Covariance, _) => {
                format!(
                    "the square-root form ({}) keeps twice the digits",
                    self.face.set("form", "square-root")
                )
            }
            (FormName::SquareRoot, Precision::F32) => {
                format!("more digits ({})", self.face.set("precision", "f64"))
            }
            (FormName::SquareRoot, Precision::F64) => {
                "begin with a std nearer to what is measured".to_owned()
            }
        };
        let component = self.states.get(component).map(|name| (*name).to_owned());
        Told { what, remedy: Some(format!("{exact}; otherwise {way}")), component }
    }

    fn finer(&self, choice: &Choice) -> String {
        let set = |key, value| self.face.set(key, value);
        let more = match choice.integrator.steps {
            Steps::Count(_) => set("substeps", "…"),
            Steps::Longest(_) => set("max_step", "…"),
        };
        if choice.variant == Variant::NoiseOnce && choice.time_update == TimeName::ItoTaylor {
            return format!("{} takes the noise in every step", set("variant", "simplified"));
        }
        let name = match (choice.time_update.solves(), choice.form) {
            (true, _) => {
                return format!(
                    "take more steps ({more}), or a solver that chooses them ({})",
                    set("solver", "dp5")
                );
            }
            (false, FormName::SquareRoot) => "sr-cd-ckf2",
            (false, FormName::Covariance) => "cd-ckf2",
        };
        format!("take more steps ({more}), or a method that chooses them ({})", self.face.method(name))
    }
}

fn moves(moved: f64) -> String {
    let by = match moved {
        _ if !moved.is_finite() => {
            return "with twice as many steps the prediction fails: they are far too long".to_owned();
        }
        _ if moved < 1.0 => format!("{moved:.3}"),
        _ => format!("{:.1}", Shown(moved)),
    };
    format!("the steps of a gap are too long: with twice as many the prediction moves by {by} of its std")
}
