//! Whole filters over a sequence of measurements: what the user did not choose makes no difference beyond the tolerance.

use crate::drift::{FLAT, Kind, Problem, STEEP, runs_apart, with};
use givens::registry::Choice;
use givens_tests::cases;
use proptest::prelude::*;

/// The tolerance that is asked of a step, in standard deviations; the answers may differ by ten of it.
const RTOL: f64 = 1e-6;

const ROADS: [(&str, &str); 4] =
    [("cd-ckf2", "moment-ode"), ("sr-cd-ckf2", "moment-ode"), ("lskf", "triangular"), ("lskf", "free")];

fn road((method, gauge): (&str, &str), solver: &str, max_step: Option<&str>) -> Choice {
    let mut settings = vec![("solver", solver), ("rtol", "1e-6")];
    settings.extend((method == "lskf").then_some(("gauge", gauge)));
    settings.extend(max_step.map(|longest| ("max_step", longest)));
    with(method, &settings)
}

/// The same with a row without measures somewhere in every gap.
fn split(problem: &Problem, share: f64) -> Problem {
    let mut more = Problem { times: Vec::new(), z: Vec::new(), ..problem.clone() };
    let mut before = 0.0;
    for (&t, z) in problem.times.iter().zip(&problem.z) {
        more.times.extend([before + share * (t - before), t]);
        more.z.extend([vec![f64::NAN], z.clone()]);
        before = t;
    }
    more
}

proptest! {
    #![proptest_config(cases(6))]

    #[test]
    fn a_bound_on_the_steps_the_first_included_makes_no_difference(seed: u64, n in 1usize..=3, q in 1usize..=3) {
        for kind in FLAT.into_iter().chain(STEEP) {
            let problem = Problem::random(kind, seed, n, q, 6);
            for solver in ["dp5", "rodas4"] {
                for of in ROADS {
                    let alone = problem.run(&road(of, solver, None));
                    for longest in ["0.11", "0.013"] {
                        let apart = runs_apart(&alone, &problem.run(&road(of, solver, Some(longest))));
                        prop_assert!(apart < 10.0 * RTOL, "{kind:?}, {of:?} {solver}, {longest}: {apart:e}");
                    }
                }
            }
        }
    }

    /// The free root is triangularised at the end of a gap. Beyond quadratic drifts its velocity depends on that.
    #[test]
    fn an_interval_in_two_parts_is_one(seed: u64, n in 1usize..=3, q in 1usize..=3, share in 0.05..0.95) {
        for kind in FLAT.into_iter().chain(STEEP) {
            let problem = Problem::random(kind, seed, n, q, 6);
            let parted = split(&problem, share);
            for solver in ["dp5", "rodas4"] {
                for of in ROADS.into_iter().filter(|of| of.1 != "free" || FLAT.contains(&kind)) {
                    let choice = road(of, solver, None);
                    let apart = runs_apart(&problem.run(&choice), &parted.run(&choice));
                    prop_assert!(apart < 10.0 * RTOL, "{kind:?}, {of:?} {solver}: {apart:e}");
                }
            }
        }
    }
}

#[test]
fn beyond_quadratic_drifts_a_free_root_knows_where_it_was_triangularised() {
    let mut problem = Problem::random(Kind::Cubic, 4, 3, 3, 4);
    problem.cov *= 4.0;
    let choice = road(("lskf", "free"), "dp5", None);
    let apart = runs_apart(&problem.run(&choice), &split(&problem, 0.5).run(&choice));
    assert!(apart > 100.0 * RTOL, "{apart:e}");
}
