//! Numbers that are none: where they come from, and the way out.

use super::Explain;
use crate::filter::Quantity;
use crate::registry::{Choice, TimeName};

/// What a quantity has components of.
pub(super) enum Of {
    State,
    Measure,
}

pub(super) fn of_what(quantity: Quantity) -> Option<Of> {
    Some(match quantity {
        Quantity::Observation
        | Quantity::ObservationDerivative
        | Quantity::MeasurementNoise
        | Quantity::Measurement
        | Quantity::Innovation => Of::Measure,
        Quantity::Control | Quantity::Parameter => return None,
        _ => Of::State,
    })
}

/// Where numbers that are none come from.
const DOMAIN: &str =
    "look for a division by zero, the root of a negative number, or an estimate that runs away";

impl Explain<'_> {
    /// A quantity that is not a finite number, and the way out; none that has no more words than its own.
    pub(super) fn not_finite(
        &self,
        choice: Option<&Choice>,
        quantity: Quantity,
        component: usize,
    ) -> Option<(String, String)> {
        let (state, measure) = (self.state(component), self.measure(component));
        Some(match quantity {
            Quantity::TransitionDerivative => {
                let what = format!(
                    "the derivative of the transition of {state}, with respect to the state at the mean, is not a finite \
                     number"
                );
                (what, self.without_derivatives())
            }
            Quantity::ObservationDerivative => {
                let what = format!(
                    "the derivative of the predicted measure {measure}, with respect to the state at the mean, is not a \
                     finite number"
                );
                (what, self.without_derivatives())
            }
            Quantity::DriftDerivative => {
                let what = format!(
                    "a derivative of the drift of {state}, with respect to the state, is not a finite number"
                );
                (what, self.without_derivatives())
            }
            Quantity::Drift if choice.is_some_and(|choice| choice.time_update == TimeName::ItoTaylor) => {
                let what = format!(
                    "the drift of {state}, or a derivative of it in the expansion, is not a finite number"
                );
                (what, format!("{DOMAIN}{}", self.too_long(choice)))
            }
            Quantity::Transition
            | Quantity::Drift
            | Quantity::Diffusion
            | Quantity::Estimate
            | Quantity::ProcessNoise => {
                let what = format!("the {} of {state} is not a finite number", quantity.name());
                (what, format!("{DOMAIN}{}", self.too_long(choice)))
            }
            Quantity::Observation | Quantity::MeasurementNoise | Quantity::Measurement => {
                (format!("the {} {measure} is not a finite number", quantity.name()), DOMAIN.to_owned())
            }
            Quantity::Innovation => {
                let what = format!(
                    "the innovation of {measure}, in its standard deviations, is too large to be squared"
                );
                (what, "look for a wrong unit of the measure or of its noise".to_owned())
            }
            _ => return None,
        })
    }

    /// What equal steps in continuous time may have done besides.
    fn too_long(&self, choice: Option<&Choice>) -> String {
        if !choice.is_some_and(Choice::steps_are_equal) {
            return String::new();
        }
        let set = |key, value| self.face.set(key, value);
        format!(
            "; or the steps are too long for the drift: {} bounds them, and {} with {} is for stiff drifts",
            set("max_step", "…"),
            set("time_update", "moment-ode"),
            set("solver", "rodas4")
        )
    }
}
