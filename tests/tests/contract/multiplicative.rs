//! Of a linear drift and a diffusion that is linear in the state, mean and covariance have closed forms: a rule that is
//! exact for quadratics follows them.

use givens::filter::{Fault, Gaussian};
use givens::model::zoo::Components;
use givens::model::{At, Sde, Varies};
use givens::ode::Tolerance;
use givens::registry::{RuleName, TimeName};
use givens::scalar::Real;
use givens_tests::choices::continuous_choices;

/// dx = −(a x₀, b x₁) dt + [p x₀, c; 0, r x₁] dβ.
const A: f64 = 0.7;
const B: f64 = 0.4;
const P: f64 = 0.3;
const C: f64 = 0.6;
const R: f64 = 0.5;

struct Multiplicative;

impl Sde for Multiplicative {
    fn states(&self) -> usize {
        2
    }
    fn noises(&self) -> usize {
        2
    }
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        dx.copy_from_slice(&[T::of(-A) * x[0], T::of(-B) * x[1]]);
    }
    fn diffusion<T: Real>(&self, _: &At<T>, x: &[T], g: &mut [T]) {
        g.copy_from_slice(&[T::of(P) * x[0], T::of(C), T::zero(), T::of(R) * x[1]]);
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::WithState
    }
}

const SENSOR: Components<1> = Components { states: 2, which: [0], std: [1.0] };

/// Mean and covariance after time t: e' = k e + f exp(g t) for each of the second moments.
fn moments(mean: [f64; 2], var: [f64; 2], t: f64) -> ([f64; 2], [f64; 3]) {
    let driven = |start: f64, k: f64, f: f64, g: f64| {
        (k * t).exp() * start + f * ((g * t).exp() - (k * t).exp()) / (g - k)
    };
    let now = [mean[0] * (-A * t).exp(), mean[1] * (-B * t).exp()];
    let first = driven(var[0] + mean[0] * mean[0], P * P - 2.0 * A, C * C, 0.0);
    let cross = driven(mean[0] * mean[1], -A - B, C * R * mean[1], -B);
    let second = driven(var[1] + mean[1] * mean[1], R * R - 2.0 * B, 0.0, 0.0);
    (now, [first - now[0] * now[0], cross - now[0] * now[1], second - now[1] * now[1]])
}

#[test]
fn a_diffusion_linear_in_the_state_has_the_moments_of_its_closed_form() {
    let (mean, std, t) = ([2.0, -1.5], [0.5, 0.8], 0.9);
    let prior = Gaussian::from_std(&mean, &std).unwrap();
    let (m, [p00, p01, p11]) = moments(mean, std.map(|s| s * s), t);
    let mut followed = 0;
    for (name, mut choice) in continuous_choices(2) {
        choice.integrator.tolerance = Tolerance { rtol: 1e-11, atol: 0.0 };
        let mut f = match choice.start_continuous(&Multiplicative, &SENSOR, 0.0, &prior) {
            Ok(f) => f,
            Err(error) => {
                assert_eq!(error.fault, Fault::StateDependentDiffusion, "{name}");
                continue;
            }
        };
        if let Err(error) = f.predict(t) {
            assert_eq!(error.fault, Fault::StateDependentDiffusion, "{name}");
            continue;
        }
        // an expansion of first order takes the diffusion at the mean, and an Euler step is one of first order
        if choice.rule == RuleName::Taylor || choice.time_update != TimeName::MomentOde {
            continue;
        }
        followed += 1;
        let found = [f.mean(), &f.cov()].concat();
        for (x, y) in found.iter().zip([m[0], m[1], p00, p01, p01, p11]) {
            assert!((x - y).abs() < 1e-8, "{name}: {found:?}, {m:?} {p00} {p01} {p11}");
        }
    }
    assert!(followed > 5, "{followed}");
}
