//! What is wrong with a continuous model is told with the quantity and its component, by every method.

use givens::filter::{Fault, Gaussian, Quantity};
use givens::model::zoo::Components;
use givens::model::{At, Sde, Varies};
use givens::scalar::Real;
use givens_tests::choices::continuous_choices;

/// Three states and two noises.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wrong {
    Nothing,
    /// The second component of the drift is not a number.
    Drift,
    /// The last row of the diffusion has an entry that is none.
    Diffusion,
    /// The same of a diffusion that may depend on the state.
    DiffusionOfState,
    /// The diffusion depends on the state, or on the time, and says that it does not.
    SilentState,
    SilentTime,
}

struct Model(Wrong);

impl Sde for Model {
    fn states(&self) -> usize {
        3
    }
    fn noises(&self) -> usize {
        2
    }
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        // no other component moves with the second one, which would then be no number itself
        dx.copy_from_slice(&[-x[0], x[0] - x[1], -x[2]]);
        if self.0 == Wrong::Drift {
            dx[1] = T::of(f64::NAN);
        }
    }
    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        g.fill(T::of(0.3));
        match self.0 {
            Wrong::Diffusion | Wrong::DiffusionOfState => g[5] = T::of(f64::NAN),
            Wrong::SilentState => g[3] = T::of(0.3) * x[2],
            Wrong::SilentTime => g[3] = T::of(0.3) * at.t,
            Wrong::Nothing | Wrong::Drift => {}
        }
    }
    fn diffusion_varies(&self) -> Varies {
        if self.0 == Wrong::DiffusionOfState { Varies::WithState } else { Varies::Never }
    }
}

const SENSOR: Components<1> = Components { states: 3, which: [0], std: [1.0] };

#[test]
fn a_wrong_flow_is_told_by_quantity_and_component() {
    let prior = Gaussian::from_std(&[1.0, -0.5, 2.0], &[0.5, 0.4, 0.3]).unwrap();
    for (name, choice) in continuous_choices(3) {
        let fault = |wrong| -> Option<Fault> {
            let model = Model(wrong);
            let mut f = match choice.start_continuous(&model, &SENSOR, 0.0, &prior) {
                Ok(f) => f,
                Err(error) => return Some(error.fault),
            };
            let before = [f.mean(), f.factor()].concat();
            let fault = f.predict(0.3).err()?.fault;
            assert_eq!(before, [f.mean(), f.factor()].concat(), "{name}: the belief is as before");
            Some(fault)
        };
        let not_finite = |quantity, component| Some(Fault::NotFinite { quantity, component });
        assert_eq!(fault(Wrong::Nothing), None, "{name}");
        assert_eq!(fault(Wrong::Drift), not_finite(Quantity::Drift, 1), "{name}");
        assert_eq!(fault(Wrong::Diffusion), not_finite(Quantity::Diffusion, 2), "{name}");
        let told = fault(Wrong::DiffusionOfState);
        let refused = told == Some(Fault::StateDependentDiffusion);
        assert!(refused || told == not_finite(Quantity::Diffusion, 2), "{name}: {told:?}");
        for (wrong, of) in [(Wrong::SilentState, "state"), (Wrong::SilentTime, "time")] {
            let told = fault(wrong);
            let why = format!("the diffusion depends on the {of}; diffusion_varies must say so");
            assert!(matches!(told, Some(Fault::Mismatch { why: told }) if told == why), "{name}: {told:?}");
        }
    }
}
