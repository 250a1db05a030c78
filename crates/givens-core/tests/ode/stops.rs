//! What ends an integration early, and what is left then.

use crate::problems::{Driven, Ends, Floor, Oscillator, Outside, equal, solve, to};
use givens_core::ode::{Integrator, Segment, Solver, Steps, Tolerance, Why};

#[test]
fn a_boundary_of_the_domain_is_approached_until_steps_vanish() {
    for solver in [Solver::Dp5, Solver::Rodas4] {
        for gap in [1.5, 20.0] {
            let tolerance = Tolerance { rtol: 0.0, atol: 1e-6 };
            let integrator = Integrator { solver, tolerance, ..Integrator::default() };
            let mut y = [1.08];
            let (done, work) = solve(&integrator, &Floor, (3.0, gap), &mut y, None);
            let stop = done.unwrap_err();
            assert_eq!(stop.why, Why::System(Outside));
            assert!((stop.time - 3.83).abs() < 1e-12, "{stop:?}");
            assert!((y[0] - (4.08 - stop.time)).abs() < 1e-14, "{y:?}");
            assert!(stop.smallest < 1e-12 && work.accepted + work.rejected < 200, "{stop:?} {work:?}");
        }
    }
}

#[test]
fn equal_steps_stop_before_the_one_that_leaves_the_domain() {
    for solver in [Solver::Euler, Solver::Rk2, Solver::Rk4] {
        let mut y = [1.25];
        let (done, work) = solve(&equal(solver, 0.3), &Floor, (3.0, 3.0), &mut y, None);
        let stop = done.unwrap_err();
        assert_eq!((stop.why, stop.smallest), (Why::System(Outside), 0.3));
        let steps = work.accepted as f64;
        assert!((stop.time - 3.0 - 0.3 * steps).abs() < 1e-14 && (y[0] - 1.25 + 0.3 * steps).abs() < 1e-14);
        assert!((3.0..=4.0).contains(&steps));
    }
}

#[test]
fn a_slope_that_is_no_number_is_named_with_its_component_and_time() {
    for solver in Solver::ALL {
        let mut y = [1.0, 0.0];
        let integrator = Integrator { steps: Steps::Longest(0.1), ..to(solver, 1e-6) };
        let (done, _) = solve(&integrator, &Ends, (0.0, 2.0), &mut y, None);
        let stop = done.unwrap_err();
        assert_eq!(stop.why, Why::NotFinite { component: 1 }, "{solver:?}");
        assert!((stop.time - 1.0).abs() < if solver.adaptive() { 1e-6 } else { 0.11 }, "{stop:?}");
        assert!(y.iter().all(|y: &f64| y.is_finite()));
    }
}

#[test]
fn a_start_without_a_number_or_outside_the_domain_stops_at_once() {
    for solver in Solver::ALL {
        let stop = |y: f64| solve(&to(solver, 1e-6), &Floor, (3.0, 1.0), &mut [y], None).0.unwrap_err();
        assert_eq!((stop(-1.0).why, stop(-1.0).time), (Why::System(Outside), 3.0));
        assert_eq!((stop(f64::NAN).why, stop(f64::NAN).time), (Why::NotFinite { component: 0 }, 3.0));
    }
}

#[test]
fn a_tolerance_below_rounding_ends_in_words() {
    for solver in [Solver::Dp5, Solver::Rodas4] {
        // the rounding of a step shrinks with the step, until the step itself vanishes
        let mut y = [1.0, 0.0];
        let (done, _) = solve(&to(solver, 1e-40), &Oscillator, (0.0, 10.0), &mut y, None);
        let stop = done.unwrap_err();
        assert_eq!(stop.why, Why::StepTooSmall);
        assert!(stop.to_string().contains("rtol"), "{stop}");
    }
}

#[test]
fn more_equal_steps_than_the_limit_are_refused_at_once() {
    let integrator = Integrator { limit: 1000, ..equal(Solver::Rk4, 1e-4) };
    let (done, work) = solve(&integrator, &Oscillator, (0.0, 1.0), &mut [1.0, 0.0], None);
    let stop = done.unwrap_err();
    assert_eq!((stop.why, stop.time, work.calls), (Why::StepLimit { limit: 1000 }, 0.0, 0));
}

#[test]
fn a_gap_of_nothing_changes_nothing_and_one_without_end_is_refused() {
    for solver in Solver::ALL {
        let mut y = Driven::solution(0.3);
        let (done, work) = solve(&to(solver, 1e-6), &Driven, (0.3, 0.0), &mut y, None);
        assert!(done.is_ok() && work.calls == 0 && y == Driven::solution(0.3));
        for gap in [f64::INFINITY, f64::NAN] {
            let (done, _) = solve(&to(solver, 1e-6), &Driven, (0.3, gap), &mut y, None);
            assert_eq!(done.unwrap_err().why, Why::StepTooSmall);
        }
    }
}

#[test]
fn a_gap_that_ends_where_there_is_no_slope_ends_well_and_its_dense_output_is_a_parabola() {
    let (mut plain, mut seen, mut middle) = ([1.25], [1.25], [0.0]);
    let integrator = equal(Solver::Euler, 0.3);
    let (done, work) = solve(&integrator, &Floor, (0.0, 1.2), &mut plain, None);
    assert!(done.is_ok() && work.accepted == 4);
    let mut visit = |segment: &Segment<f64>| segment.at(0.5, &mut middle);
    assert!(solve(&integrator, &Floor, (0.0, 1.2), &mut seen, Some(&mut visit)).0.is_ok());
    assert_eq!(plain, seen);
    assert!(seen[0] < 0.25 && (middle[0] - 0.2).abs() < 1e-15, "{seen:?} {middle:?}");
}
