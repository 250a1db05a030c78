//! Every scenario of the oracle, through the library: every rule, in covariance form and in square-root form with both
//! measurement updates; filter, smoothers, scores and failures. `golden/README.md` tells the errors that are reached;
//! the bounds here are three to five times as wide, for other machines round otherwise.

use givens_tests::scenario::{ROADS, SMALL, Scenario};

/// The largest errors allowed: of all rules but the one with α = 0.001, whose weights of a million times the size cost
/// six digits, and of that one.
struct Bounds {
    filter: f64,
    smoothers: f64,
    small: f64,
}

fn check(name: &str, bounds: &Bounds) {
    let scenario = Scenario::read(name);
    for rule in scenario.rules() {
        for (road, parts) in ROADS {
            let reached = scenario.reached(rule, parts).unwrap_or_else(|error| panic!("{error}"));
            let (filter, mut smoothers) = match rule.as_str() {
                SMALL => (bounds.small, bounds.small),
                _ => (bounds.filter, bounds.smoothers),
            };
            if road == "covariance" {
                // steps without noise: P⁻ is nearly singular, and Pˢ = P + G (Pˢ − P⁻) Gᵀ divides by it and subtracts
                match name {
                    "reentry" => smoothers = 1e-7,
                    "contracting" => smoothers = 2e-2,
                    _ => {}
                }
            }
            assert!(reached.filter() < filter, "{name} {rule} {road}: filter {reached:?}");
            assert!(reached.smoothed < smoothers, "{name} {rule} {road}: smoothers {reached:?}");
        }
    }
}

macro_rules! scenarios {
    ($($name:ident: $filter:literal $smoothers:literal $small:literal;)*) => {$(
        #[test]
        fn $name() {
            check(stringify!($name), &Bounds { filter: $filter, smoothers: $smoothers, small: $small });
        }
    )*

        #[test]
        fn no_scenario_is_left_out() {
            assert_eq!([$(stringify!($name)),*], givens_tests::SCENARIOS);
        }
    };
}

scenarios! {
    missing: 1e-12 3e-12 5e-7;
    crossing: 5e-13 1e-12 1e-7;
    degrees: 3e-13 1e-12 1e-7;
    three_d: 1e-12 1e-12 1e-7;
    driven: 3e-13 3e-13 3e-8;
    fixed_step: 3e-13 3e-13 3e-8;
    known_state: 5e-13 1e-12 5e-8;
    duplicated_state: 3e-13 5e-13 3e-8;
    no_noise: 3e-13 3e-13 3e-8;
    growing_rank: 3e-13 1e-12 1e-7;
    contracting: 3e-13 3e-13 0.0;
    reentry: 4e-12 5e-11 0.0;
    prediction_rows: 3e-13 3e-13 1e-8;
    one_time: 3e-13 3e-13 3e-8;
    innovation_fails: 3e-13 3e-13 1e-10;
    posterior_fails: 3e-13 3e-13 1e-9;
    predicted_fails: 3e-13 3e-13 2e-9;
    conditional_fails: 3e-13 3e-13 2e-9;
}
