//! A stiff oscillator: few steps of rodas4, and what dp5 says of it.

use crate::problems::{VanDerPol, error, solve, to};
use givens_core::ode::{Integrator, Solver, Why};

/// Van der Pol, μ = 1000, from (2, 0) at t = 500, 1000 and 2000: Radau of SciPy 1.17.1 with the exact Jacobian, rtol
/// 1e-12, atol 1e-14. The first jump is at t = 807.
const REFERENCE: [(f64, [f64; 2]); 3] = [
    (500.0, [1.596_768_951_052_545_1, -0.001_030_391_187_838_801_2]),
    (1000.0, [-1.863_646_254_808_302_8, 0.000_753_543_086_543_274_5]),
    (2000.0, [1.706_167_732_170_438_3, -0.000_892_809_701_024_646_5]),
];

#[test]
fn rodas4_takes_few_steps_through_the_jumps_of_van_der_pol() {
    for rtol in [1e-4, 1e-6, 1e-8] {
        for (t, expected) in REFERENCE {
            let mut y = [2.0, 0.0];
            let (done, work) = solve(&to(Solver::Rodas4, rtol), &VanDerPol, (0.0, t), &mut y, None);
            done.unwrap();
            let error = error(&y, &expected) / rtol;
            assert!(error < 10.0, "t = {t}: {error} times {rtol:e}");
            assert!(work.accepted + work.rejected < 3000, "{work:?}");
        }
    }
}

#[test]
fn dp5_ends_at_its_limit_with_the_time_and_the_smallest_step() {
    let mut y = [2.0, 0.0];
    let integrator = Integrator { limit: 5000, ..to(Solver::Dp5, 1e-6) };
    let (done, work) = solve(&integrator, &VanDerPol, (0.0, 2000.0), &mut y, None);
    let stop = done.unwrap_err();
    assert_eq!(stop.why, Why::StepLimit { limit: 5000 });
    assert_eq!(work.accepted + work.rejected, 5000);
    assert!(stop.time > 1.0 && stop.time < 100.0 && stop.smallest < 0.01, "{stop:?}");
    let words = stop.to_string();
    assert!(words.contains("rodas4") && words.contains("5000") && words.contains("t = "), "{words}");
    // the state is that of the time reached
    let mut again = [2.0, 0.0];
    solve(&to(Solver::Rodas4, 1e-8), &VanDerPol, (0.0, stop.time), &mut again, None).0.unwrap();
    assert!(error(&y, &again) < 1e-5, "{y:?} {again:?}");
}
