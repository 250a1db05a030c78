//! What `f32` has to do with a fault.

use super::{Explain, not_finite};
use crate::filter::{Fault, Quantity};
use crate::registry::{Choice, Precision};
use crate::scalar::Shown;

/// Whether more digits than those of `f32` may help.
pub(super) fn rounded(choice: Option<&Choice>, fault: &Fault) -> bool {
    let of_numbers = matches!(
        fault,
        Fault::NotPositive { .. }
            | Fault::SingularInnovation { .. }
            | Fault::NotFinite { .. }
            | Fault::Unrepresentable { .. }
            | Fault::Indistinct { .. }
            | Fault::Solver { .. }
            | Fault::Unresolved { .. }
    );
    of_numbers && choice.is_some_and(|choice| choice.precision == Precision::F32)
}

impl Explain<'_> {
    /// A remedy, and that of more digits.
    pub(super) fn or_in_double(&self, remedy: Option<String>) -> String {
        let double = self.face.set("precision", "f64");
        match remedy {
            Some(remedy) => format!("{remedy}; or compute in f64 ({double})"),
            None => format!("compute in f64 ({double})"),
        }
    }

    /// What cannot be kept, with its name.
    pub(super) fn unrepresentable(&self, quantity: Quantity, component: usize, value: f64) -> String {
        let of = match not_finite::of_what(quantity) {
            Some(not_finite::Of::State) => self.state(component),
            Some(not_finite::Of::Measure) => self.measure(component),
            None => (component + 1).to_string(),
        };
        let (name, value) = (quantity.name(), Shown(value));
        format!("the {name} of {of}, {value}, is beyond what f32 can keep (1.2e-38 to 3.4e38)")
    }
}
