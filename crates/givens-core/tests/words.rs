//! What a failing step says, and that it says it at all.
#![allow(clippy::unwrap_used)]

use givens_core::filter::{
    Ekf, Fault, Filter, Gaussian, Method, Over, Quantity, SrCkf, SrEkf, StepError, Ukf,
};
use givens_core::model::{At, Noise, Observation, Transition};
use givens_core::scalar::Real;

/// A point that a control pushes, seen by its distance from the origin, twice.
#[derive(Debug)]
struct Pushed;

impl Transition for Pushed {
    fn states(&self) -> usize {
        2
    }
    fn controls(&self) -> usize {
        1
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = x[0] + at.u[0];
        out[1] = x[1];
    }
    fn noise(&self) -> Noise {
        Noise::Root(0)
    }
    fn process_noise<T: Real>(&self, _: &At<T>, _: &mut [T]) {}
}

impl Observation for Pushed {
    fn states(&self) -> usize {
        2
    }
    fn measures(&self) -> usize {
        2
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out.fill(x[0].hypot(x[1]));
    }
    fn noise(&self) -> Noise {
        Noise::Root(2)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&[1.0, 0.0, 0.0, 1.0].map(T::of));
    }
}

fn start<X: Over<Pushed>>(method: X) -> Filter<'static, X, Pushed, f64, Vec<f64>> {
    method.start(&Pushed, 0.0, Gaussian::from_std(&[0.0, 0.0], &[1.0, 1.0]).unwrap()).unwrap()
}

#[test]
fn controls_that_were_never_set_are_an_error_and_not_zero() {
    let mut f = start(SrCkf::default());
    f.predict(0.0).unwrap();
    let error = f.predict(1.0).unwrap_err();
    let fault = Fault::ControlsNotSet { controls: 1 };
    assert_eq!(error, StepError { fault, time: 0.0, step: 0 });
    assert!(error.to_string().contains("`set_controls`"), "{error}");
    assert!(f.set_controls(&[f64::NAN]).is_err() && f.predict(1.0).is_err());
    f.set_controls(&[3.0]).unwrap();
    f.predict(1.0).unwrap();
    assert_eq!(f.mean(), [3.0, 0.0]);
}

fn derivative<X: Over<Pushed>>(method: X) {
    let error = start(method).update(&Pushed, &[1.0, 1.0]).unwrap_err();
    let fault = Fault::NotFinite { quantity: Quantity::ObservationDerivative, component: 0 };
    assert_eq!(error.fault, fault);
    assert!(
        error.to_string().contains("with respect to the state at the mean; use a method without derivatives")
    );
}

#[test]
fn a_derivative_that_does_not_exist_is_told_as_that() {
    derivative(Ekf::default());
    derivative(SrEkf::default());
    assert!(start(SrCkf::default()).update(&Pushed, &[1.0, 1.0]).is_ok());
}

#[test]
fn a_missing_component_is_pointed_to_update_present() {
    let mut f = start(SrCkf::default());
    let error = f.update(&Pushed, &[1.0, f64::NAN]).unwrap_err();
    assert!(error.to_string().ends_with("; `update_present` takes missing components"), "{error}");
    f.update_present(&Pushed, &[1.0, f64::NAN], &[true, false]).unwrap();
}

#[test]
fn a_nis_that_overflows_is_an_error_and_not_infinite() {
    // each square is finite, their sum is not
    let error = start(SrCkf::default()).update(&Pushed, &[1e154, -1e154]).unwrap_err();
    let fault = Fault::NotFinite { quantity: Quantity::Innovation, component: 1 };
    assert_eq!(error.fault, fault);
}

#[test]
fn options_out_of_range_name_themselves() {
    let prior = Gaussian::from_std(&[0.0, 0.0], &[1.0, 1.0]).unwrap();
    for (alpha, kappa, word) in [
        (1e-170, None, "alpha = 1e-170"),
        (1e200, None, "alpha = 1e200"),
        (1.0, Some(1e300), "kappa = 1e300"),
    ] {
        let error = Ukf { alpha, kappa, beta: 0.0 }.start(&Pushed, 0.0, &prior).unwrap_err();
        assert!(error.to_string().contains(word), "{error}");
    }
}
