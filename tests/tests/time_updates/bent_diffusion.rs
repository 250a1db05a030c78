//! A diffusion that is quadratic in the state: of a Gaussian its square has a closed form, which a rule exact to degree four
//! follows, whatever the signs of its weights, forwards and on the way back.

use crate::drift::with;
use givens::filter::Gaussian;
use givens::model::zoo::Components;
use givens::model::{At, Sde, Varies};
use givens::ode::Tolerance;
use givens::registry::{Choice, RuleName, TimeName};
use givens::scalar::Real;
use givens::{Goal, Row};
use givens_tests::choices::continuous_choices;

/// From five states on, cubature of degree five and the unscented transform have negative weights.
const N: usize = 5;
const B: [f64; 2] = [0.3, 0.5];

/// dx_i = b_i x_i² dβ_i of the first two states; the others stand still.
struct Bent;

impl Sde for Bent {
    fn states(&self) -> usize {
        N
    }
    fn noises(&self) -> usize {
        2
    }
    fn drift<T: Real>(&self, _: &At<T>, _: &[T], dx: &mut [T]) {
        dx.fill(T::zero());
    }
    fn diffusion<T: Real>(&self, _: &At<T>, x: &[T], g: &mut [T]) {
        g.fill(T::zero());
        g[0] = T::of(B[0]) * x[0] * x[0];
        g[3] = T::of(B[1]) * x[1] * x[1];
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::WithState
    }
}

const SENSOR: Components<2> = Components { states: N, which: [0, 1], std: [0.4, 0.7] };
const MEAN: [f64; N] = [0.8, -0.6, 1.0, 2.0, 3.0];
const STD: [f64; N] = [0.5, 0.6, 1.0, 0.2, 3.0];

/// The variance after time t: with a mean that stays, p' = b² E[x⁴] = b² (m⁴ + 6 m² p + 3 p²).
fn spread(b: f64, m: f64, p: f64, t: f64) -> f64 {
    // with q = p + m² and k² = ⅔ m⁴, q' = 3 b² (q² − k²)
    let (q, k) = (p + m * m, m * m * (2.0_f64 / 3.0).sqrt());
    let turned = (q - k) / (q + k) * (6.0 * b * b * k * t).exp();
    k * (1.0 + turned) / (1.0 - turned) - m * m
}

/// Mean and variance of a state at two rows, smoothed. Nothing moves it but noise: the gain is P / P⁻.
fn smoothed(b: f64, [m, p, r]: [f64; 3], rows: [(f64, f64); 2]) -> [(f64, f64); 2] {
    let (mut m, mut p, mut time) = (m, p, 0.0);
    let mut all = [[0.0; 4]; 2];
    for ((t, z), beliefs) in rows.into_iter().zip(&mut all) {
        let predicted = (m, spread(b, m, p, t - time));
        let gain = predicted.1 / (predicted.1 + r);
        (m, p, time) = (m + gain * (z - m), (1.0 - gain) * predicted.1, t);
        *beliefs = [predicted.0, predicted.1, m, p];
    }
    let [[.., m0, p0], [m_predicted, p_predicted, m1, p1]] = all;
    let gain = p0 / p_predicted;
    [(m0 + gain * (m1 - m_predicted), p0 + gain * gain * (p1 - p_predicted)), (m1, p1)]
}

fn is_exact_to_degree_four(choice: &Choice) -> bool {
    match choice.rule {
        RuleName::Cubature5 => true,
        RuleName::GaussHermite => choice.gauss_hermite.points > 2,
        RuleName::CentralDifference => choice.central_difference.eta == 3f64.sqrt(),
        RuleName::Unscented => choice.unscented.kappa.is_none(),
        RuleName::Cubature3 | RuleName::Taylor => false,
    }
}

#[test]
fn a_bent_diffusion_is_followed_there_and_back_by_rules_of_degree_four() {
    let rows = [(0.4, [1.0, -0.2]), (1.1, [0.3, -0.9])];
    let of = |i: usize| {
        smoothed(B[i], [MEAN[i], STD[i] * STD[i], SENSOR.std[i].powi(2)], rows.map(|(t, z)| (t, z[i])))
    };
    let expected = [of(0), of(1)];
    let prior = Gaussian::from_std(&MEAN, &STD).unwrap();
    let mut followed = Vec::new();
    let others =
        ["cd-ckf2", "sr-cd-ckf2"].map(|name| (name.to_owned(), with(name, &[("rule", "cubature5")])));
    for (name, mut choice) in continuous_choices(N).into_iter().chain(others) {
        choice.integrator.tolerance = Tolerance { rtol: 1e-11, atol: 0.0 };
        if choice.time_update != TimeName::MomentOde || !is_exact_to_degree_four(&choice) {
            continue;
        }
        let data = rows.iter().map(|(time, z)| Row { time: *time, z, u: &[] });
        let outcome = choice.run_continuous(&Bent, &SENSOR, data, 0.0, &prior, Goal::Interval, &[]);
        let found = match outcome.into_result() {
            Ok(found) => found,
            Err(failure) => panic!("{name}: {failure}"),
        };
        for row in 0..rows.len() {
            for i in 0..N {
                let still = (MEAN[i], STD[i] * STD[i]);
                let (mean, var) = expected.get(i).map_or(still, |of_rows| of_rows[row]);
                let (m, p) = (found.mean(row)[i], found.cov(row)[i * N + i]);
                assert!(
                    (m - mean).abs() < 1e-8 && (p - var).abs() < 1e-8,
                    "{name}, row {row}, state {i}: {m} {p}, {mean} {var}"
                );
            }
            assert!(found.cov(row)[1].abs() < 1e-9, "{name}");
        }
        followed.push(choice.rule);
    }
    for rule in [RuleName::Cubature5, RuleName::GaussHermite, RuleName::Unscented] {
        assert!(followed.contains(&rule), "{rule:?} of {followed:?}");
    }
}
