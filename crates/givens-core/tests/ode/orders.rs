//! The order of every solver and of its dense output, on a nonlinear system driven by time.

use crate::problems::{Driven, equal, error, solve};
use givens_core::ode::{Segment, Solver};

const ORDERS: [(Solver, f64); 5] =
    [(Solver::Euler, 1.0), (Solver::Rk2, 2.0), (Solver::Rk4, 4.0), (Solver::Dp5, 5.0), (Solver::Rodas4, 4.0)];

/// The largest error at the ends of steps, and the largest within them, over [0, 2] in `steps` equal ones.
fn errors(solver: Solver, steps: usize) -> (f64, f64) {
    let mut y = Driven::solution(0.0);
    let (mut end, mut within) = (0.0_f64, 0.0_f64);
    let mut visit = |segment: &Segment<f64>| {
        end = end.max(error(segment.end, &Driven::solution(segment.t + segment.h)));
        for theta in [0.0, 0.2, 0.5, 0.7, 1.0] {
            let mut y = [0.0; 2];
            segment.at(theta, &mut y);
            within = within.max(error(&y, &Driven::solution(segment.t + theta * segment.h)));
        }
    };
    let integrator = equal(solver, 2.0 / steps as f64);
    let (done, work) = solve(&integrator, &Driven, (0.0, 2.0), &mut y, Some(&mut visit));
    done.unwrap();
    assert_eq!((work.accepted, work.rejected), (steps, 0));
    (end, within)
}

#[test]
fn each_solver_has_its_order_at_the_end_and_within_the_steps() {
    for (solver, order) in ORDERS {
        let ((end, within), (half_end, half_within)) = (errors(solver, 64), errors(solver, 128));
        let (slope, slope_within) = ((end / half_end).log2(), (within / half_within).log2());
        // from above: at these steps the next order still counts (dp5: 6.1, 5.8, 5.6, 5.4, 5.2 from 8 steps on)
        assert!(slope > order - 0.1 && slope < order + 0.5, "{solver:?}: order {slope}");
        assert!(slope_within > order - 0.1, "{solver:?}: dense output of order {slope_within}");
    }
}

#[test]
fn time_may_run_backwards() {
    for (solver, _) in ORDERS {
        let mut y = Driven::solution(1.0);
        let mut times = Vec::new();
        let mut visit = |segment: &Segment<f64>| times.push((segment.t, segment.h));
        solve(&equal(solver, 1e-3), &Driven, (1.0, -1.0), &mut y, Some(&mut visit)).0.unwrap();
        assert!(error(&y, &Driven::solution(0.0)) < 2e-3, "{solver:?}: {y:?}");
        assert!(times.iter().all(|&(_, h)| h < 0.0) && times[0].0 == 1.0);
    }
}
