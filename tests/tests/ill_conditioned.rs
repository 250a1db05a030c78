//! An update whose innovation covariance is nearly singular, against exact arithmetic: the square root answers to the
//! condition of the problem, the covariance form refuses where it cannot.

use givens::filter::{Fault, Matrix};
use givens::scalar::Real;
use givens_tests::ill_conditioned::{Case, cases, methods};

/// Runs `check(name, case, relative error or fault)` on every method of a form.
fn each<T: Real>(scalar: &str, count: usize, root: bool, check: impl Fn(&str, &Case, Result<f64, Fault>)) {
    let cases = cases(scalar);
    for (name, square_root, error, _) in methods::<T>() {
        if square_root == root {
            cases[..count]
                .iter()
                .for_each(|case| check(&name, case, error(case).map_err(|error| error.fault)));
        }
    }
}

/// The relative error of P stays below 3 ε/δ, which is what rounding the inputs costs.
fn square_root<T: Real>(scalar: &str, count: usize) {
    each::<T>(scalar, count, true, |name, case, error| {
        let (error, delta) = (error.unwrap_or_else(|fault| panic!("{name}: {fault}")), case.sensor.delta);
        assert!(error < 3.0 * T::EPSILON / delta, "{name} at δ = {delta:e}: {error:e}");
    });
}

#[test]
fn every_square_root_method_answers_to_3_epsilon_over_delta() {
    square_root::<f64>("f64", 10);
}

#[test]
fn every_square_root_method_answers_so_in_single_precision() {
    square_root::<f32>("f32", 3);
}

/// δ² is lost beside one: an error as soon as the pivot is rounding, and before that an answer to ε/δ².
fn covariance<T: Real>(scalar: &str, count: usize, last_answered: f64) {
    each::<T>(scalar, count, false, |name, case, error| {
        let delta = case.sensor.delta;
        match error {
            Ok(error) => {
                let bound = 3.0 * T::EPSILON / (delta * delta);
                assert!(error < bound && error < 1e-3, "{name} at δ = {delta:e}: {error:e}");
            }
            Err(fault) => {
                assert!(delta < last_answered, "{name} at δ = {delta:e}: {fault}");
                let named = match fault {
                    Fault::NotPositive { matrix, .. } => {
                        matches!(matrix, Matrix::Innovation | Matrix::Posterior)
                    }
                    Fault::SingularInnovation { measure } => measure == 1,
                    _ => false,
                };
                assert!(named, "{name} at δ = {delta:e}: {fault}");
            }
        }
    });
}

#[test]
fn the_covariance_form_answers_right_or_says_that_it_cannot() {
    covariance::<f64>("f64", 10, 0.9e-6);
}

#[test]
fn the_covariance_form_says_so_in_single_precision() {
    covariance::<f32>("f32", 10, f64::INFINITY);
}
