//! Adaptive solvers keep what they promise.

use crate::problems::{Driven, Kepler, Lorenz, Oscillator, error, solve, solve_at_rate, to};
use givens_core::ode::{Solver, System};

const SOLVERS: [Solver; 2] = [Solver::Dp5, Solver::Rodas4];

/// Lorenz from (1, 1, 1) at t = 2: DOP853 of SciPy 1.17.1, rtol 3e-14, atol 1e-14; its Radau agrees to 1e-12.
const LORENZ: [f64; 3] = [-8.173_499_932_242, -9.562_023_686_799, 24.620_702_049_679];

fn claim<const N: usize>(
    system: &impl System,
    start: [f64; N],
    gap: f64,
    expected: [f64; N],
    name: &str,
    bound: f64,
) {
    for solver in SOLVERS {
        for rtol in [1e-4, 1e-6, 1e-8, 1e-10] {
            let mut y = start;
            let (done, work) = solve(&to(solver, rtol), system, (0.0, gap), &mut y, None);
            assert!(done.is_ok());
            let error = error(&y, &expected) / rtol;
            assert!(error < bound, "{name}, {solver:?}: {error} times the tolerance of {rtol:e}, {work:?}");
            assert!(work.rejected * 10 <= work.accepted + 10, "{name}, {solver:?}, {rtol:e}: {work:?}");
        }
    }
}

#[test]
fn the_global_error_stays_within_ten_tolerances() {
    let turn = core::f64::consts::TAU;
    claim(&Oscillator, [1.0, 0.0], turn, [1.0, 0.0], "oscillator", 10.0);
    claim(&Driven, Driven::solution(0.0), 3.0, Driven::solution(3.0), "driven", 10.0);
    claim(&Lorenz, [1.0, 1.0, 1.0], 2.0, LORENZ, "Lorenz", 10.0);
    // half a revolution of eccentricity 0.5, from perihelion to aphelion
    let (near, far) = (0.5, 1.5);
    let [fast, slow] = [3.0_f64.sqrt(), (1.0_f64 / 3.0).sqrt()];
    claim(&Kepler, [near, 0.0, 0.0, fast], turn / 2.0, [-far, 0.0, 0.0, -slow], "Kepler", 10.0);
}

#[test]
fn a_gap_in_two_parts_gives_the_same_to_ten_tolerances() {
    for solver in SOLVERS {
        for rtol in [1e-5, 1e-8] {
            for cut in [0.1, 0.5, 0.77] {
                let (mut whole, mut parts) = ([1.0, 1.0, 1.0], [1.0, 1.0, 1.0]);
                let integrator = to(solver, rtol);
                solve(&integrator, &Lorenz, (0.0, 1.0), &mut whole, None).0.unwrap();
                solve(&integrator, &Lorenz, (0.0, cut), &mut parts, None).0.unwrap();
                solve(&integrator, &Lorenz, (cut, 1.0 - cut), &mut parts, None).0.unwrap();
                let error = error(&parts, &whole) / rtol;
                assert!(error < 10.0, "{solver:?}, cut at {cut}: {error} times {rtol:e}");
            }
        }
    }
}

#[test]
fn the_unit_of_time_changes_no_bit() {
    for solver in SOLVERS {
        let run = |rate: f64| {
            let mut y = [1.0, 1.0, 1.0];
            let (_, work) = solve_at_rate(rate, &to(solver, 1e-6), &Lorenz, (0.0, 1.0 / rate), &mut y, None);
            (y, work)
        };
        assert_eq!(run(1.0), run(1024.0), "{solver:?}");
        assert_eq!(run(1.0), run(1.0 / 4096.0), "{solver:?}");
    }
}
