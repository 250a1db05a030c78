//! What the rules of degree three have in common over continuous models.

use crate::drift::{FLAT, Kind, Problem, apart, with};
use givens_tests::{cases, cov_error, mean_error};
use proptest::prelude::*;

type Parts = &'static [(&'static str, &'static str)];

/// Rules that are exact for polynomials of degree three, and central differences, which are so of what the moment
/// equations ask: the mean of a quadratic, and its covariance with x.
const RULES: [Parts; 8] = [
    &[("rule", "cubature3")],
    &[("rule", "unscented"), ("kappa", "0")],
    &[("rule", "unscented"), ("kappa", "2.5")],
    &[("rule", "unscented"), ("alpha", "0.7"), ("beta", "2"), ("kappa", "0")],
    &[("rule", "central-difference")],
    &[("rule", "central-difference"), ("eta", "1.2")],
    &[("rule", "gauss-hermite"), ("points", "3")],
    &[("rule", "gauss-hermite"), ("points", "2")],
];

fn parts(rule: Parts, more: Parts) -> Vec<(&'static str, &'static str)> {
    rule.iter().chain(more).copied().collect()
}

proptest! {
    #![proptest_config(cases(8))]

    /// E[f] and Cov[f, x] of a quadratic f are expectations of polynomials of degree two and three: every rule has them
    /// exactly, at every stage, so that not even the solver's error differs.
    #[test]
    fn up_to_quadratic_drifts_they_predict_alike_by_the_moment_equations(seed: u64, n in 1usize..=4, q in 1usize..=4) {
        for kind in FLAT {
            let problem = Problem::random(kind, seed, n, q, 0);
            for method in ["cd-ckf2", "sr-cd-ckf2"] {
                let of = |rule| {
                    let solver = &[("solver", "rk4"), ("substeps", "8")];
                    problem.predicted(&with(method, &parts(rule, solver)), 0.5)
                };
                let expected = of(RULES[0]);
                for rule in RULES {
                    let error = apart(&of(rule), &expected);
                    prop_assert!(error < 1e-11, "{method}, {kind:?}, {rule:?}: {error:e}");
                }
            }
        }
    }

    /// The moment equations ask for E[f] and Cov[f, x] alone, and of those the two rules have one formula, with points at
    /// ±η, η² = n + κ: central differences are told apart by their covariances, which only a discrete step or an update sees.
    #[test]
    fn central_differences_are_the_unscented_rule_of_their_step_for_every_drift(
        seed: u64, n in 1usize..=4, q in 1usize..=4, eta in 100u32..250,
    ) {
        let eta = f64::from(eta) / 100.0;
        let (step, kappa) = (eta.to_string(), (eta * eta - n as f64).to_string());
        for kind in FLAT.into_iter().chain([Kind::Cubic, Kind::Trigonometric]) {
            let problem = Problem::random(kind, seed, n, q, 0);
            for method in ["cd-ckf2", "sr-cd-ckf2"] {
                let of = |rule, option, value: &str| {
                    // a covariance does not survive coarse steps of a steep drift
                    let parts = [("rule", rule), (option, value), ("solver", "rk4"), ("substeps", "64")];
                    problem.predicted(&with(method, &parts), 0.5)
                };
                let differences = of("central-difference", "eta", &step);
                let error = apart(&differences, &of("unscented", "kappa", &kappa));
                prop_assert!(error < 1e-11, "{method}, {kind:?}, eta = {step}: {error:e}");
            }
        }
    }
}

#[test]
fn beyond_quadratic_drifts_they_do_not() {
    for kind in [Kind::Cubic, Kind::Trigonometric] {
        let problem = Problem::random(kind, 3, 3, 2, 0);
        let of = |rule| problem.predicted(&with("sr-cd-ckf2", rule), 0.5);
        let expected = of(RULES[0]);
        // κ = 0, and with three states η = √3, are the cubature rule itself
        for rule in [RULES[2], RULES[5], RULES[6]] {
            let apart = apart(&of(rule), &expected);
            assert!(apart > 1e-5, "{kind:?}, {rule:?}: {apart:e}");
        }
    }
}

/// It takes f(m) for E[f], and misses the curvature.
#[test]
fn the_first_order_rule_is_none_of_them() {
    let problem = Problem::random(Kind::Bilinear, 3, 3, 2, 0);
    let [taylor, points] =
        ["sr-cd-ekf", "sr-cd-ckf2"].map(|method| problem.predicted(&with(method, &[]), 0.5));
    assert!(mean_error(&taylor.0, &points.0, &points.1) > 1e-3);
}

/// f_d = x + δ f + (δ²/2) L₀f of a bilinear drift is cubic: its mean is of degree three, its covariance is not.
#[test]
fn an_ito_taylor_step_of_a_bilinear_drift_has_one_mean_and_several_covariances() {
    let problem = Problem::random(Kind::Bilinear, 5, 3, 3, 0);
    for variant in [("variant", "simplified"), ("variant", "full")] {
        let of = |rule: Parts| {
            let mut all = vec![("time_update", "ito-taylor"), ("substeps", "1"), variant];
            all.extend(rule);
            problem.predicted(&with("sr-cd-ckf", &all), 0.5)
        };
        let (mean, cov) = of(RULES[0]);
        for rule in [RULES[2], RULES[6], RULES[7]] {
            let other = of(rule);
            let error = mean_error(&other.0, &mean, &cov);
            assert!(error < 1e-12, "{variant:?}, {rule:?}: {error:e}");
            let apart = cov_error(&other.1, &cov, 3);
            assert!(apart > 1e-6, "{variant:?}, {rule:?}: {apart:e}");
        }
    }
}
