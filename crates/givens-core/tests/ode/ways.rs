//! The ways in which a solver may be used: f32, duals, with and without dense output, options out of range.

use crate::problems::{Driven, Oscillator, equal, error, solve, to};
use givens_core::model::At;
use givens_core::ode::{Integrator, Segment, Solver, Steps, Tolerance, Work};
use givens_core::scalar::{Dual2, Real};

#[test]
fn single_precision_reaches_its_own_accuracy() {
    for solver in Solver::ALL {
        let mut y = Driven::solution(0.0).map(|y| y as f32);
        let integrator = match solver {
            Solver::Euler | Solver::Rk2 => equal(solver, 1e-3),
            _ => Integrator { steps: Steps::Longest(0.05), ..to(solver, 1e-6) },
        };
        solve(&integrator, &Driven, (0.0, 2.0), &mut y, None).0.unwrap();
        let bound = if solver == Solver::Euler { 2e-3 } else { 1e-5 };
        assert!(error(&y.map(f64::from), &Driven::solution(2.0)) < bound, "{solver:?}: {y:?}");
    }
}

#[test]
fn asking_for_dense_output_changes_no_bit_and_segments_follow_each_other() {
    for solver in Solver::ALL {
        let integrator = to(solver, 1e-8);
        let (mut plain, mut seen) = (Driven::solution(0.5), Driven::solution(0.5));
        let (_, work) = solve(&integrator, &Driven, (0.5, 1.5), &mut plain, None);
        let mut segments = Vec::new();
        let mut visit = |s: &Segment<f64>| {
            let mut ends = [[0.0; 2]; 2];
            s.at(0.0, &mut ends[0]);
            s.at(1.0, &mut ends[1]);
            assert_eq!(ends[0], s.start);
            assert!(error(&ends[1], s.end) < 4e-16);
            segments.push((s.t, s.h, [s.start[0], s.end[0]]));
        };
        let (_, work_seen) = solve(&integrator, &Driven, (0.5, 1.5), &mut seen, Some(&mut visit));
        assert_eq!(plain, seen, "{solver:?}");
        assert_eq!(segments.len(), work.accepted);
        assert_eq!(work_seen.calls, work.calls + usize::from(!solver.adaptive()), "{solver:?}");
        for pair in segments.windows(2) {
            assert!((pair[0].0 + pair[0].1 - pair[1].0).abs() < 1e-15, "{solver:?}");
            assert_eq!(pair[0].2[1], pair[1].2[0]);
        }
        let last = segments[segments.len() - 1];
        assert!((last.0 + last.1 - 2.0).abs() < 1e-15);
    }
}

#[test]
fn each_solver_costs_what_it_says() {
    let cost = |solver| {
        let mut y = [1.0, 0.0];
        let (done, work) = solve(&to(solver, 1e-6), &Oscillator, (0.0, 1.0), &mut y, None);
        done.unwrap();
        work
    };
    for (solver, stages) in [(Solver::Euler, 1), (Solver::Rk2, 2), (Solver::Rk4, 4)] {
        let expected = Work { calls: 16 * stages, accepted: 16, ..Work::default() };
        assert_eq!(cost(solver), expected, "{solver:?}");
    }
    // two calls before the first step; the slope at the end of a step is the next one's first
    for solver in [Solver::Dp5, Solver::Rodas4] {
        let work = cost(solver);
        assert_eq!(work.calls, 2 + 6 * (work.accepted + work.rejected), "{solver:?}");
        assert_eq!(work.jacobians, if solver == Solver::Rodas4 { work.accepted } else { 0 });
    }
}

#[test]
fn equal_steps_carry_derivatives_through() {
    // y = cos(t), and its derivative by the length of the gap
    let integrator = Integrator { solver: Solver::Rk4, steps: Steps::Count(200), ..Integrator::default() };
    let one = [Dual2::one()];
    let at = At { t: Dual2::of(0.0), dt: Dual2::variable(2.0), u: &[], p: &one };
    let mut y = [Dual2::of(1.0), Dual2::of(0.0)];
    let mut scratch = vec![Dual2::of(0.0); integrator.scratch(2, 1, 1, 1)];
    integrator.advance(&Oscillator, &at, &one, &mut y, &mut Work::default(), &mut scratch).unwrap();
    assert!((y[0].d + 2.0_f64.sin()).abs() < 1e-9 && (y[0].dd + 2.0_f64.cos()).abs() < 1e-9, "{y:?}");
}

#[test]
fn a_whole_number_of_longest_steps_is_taken_as_such() {
    for (gap, longest, expected) in [(0.9, 0.3, 3), (0.7, 0.1, 7), (1.0, 0.3, 4), (0.1, 5.0, 1)] {
        let integrator = Integrator { solver: Solver::Rk4, ..equal(Solver::Rk4, longest) };
        let (_, work) = solve(&integrator, &Oscillator, (0.0, gap), &mut [1.0, 0.0], None);
        assert_eq!(work.accepted, expected, "{gap} in steps of {longest}");
        let (_, work) = solve(&integrator, &Oscillator, (0.0, gap), &mut [1.0_f32, 0.0], None);
        assert_eq!(work.accepted, expected, "{gap} in steps of {longest}, f32");
    }
}

#[test]
fn an_option_out_of_range_is_refused_by_name() {
    let with = |change: fn(&mut Integrator)| {
        let mut integrator = Integrator::default();
        change(&mut integrator);
        integrator.check().map_err(|error| error.option)
    };
    assert_eq!(with(|_| ()), Ok(()));
    assert_eq!(with(|i| i.steps = Steps::Count(0)), Err("substeps"));
    assert_eq!(with(|i| i.steps = Steps::Count(100_001)), Err("substeps"));
    assert_eq!(with(|i| i.steps = Steps::Longest(0.0)), Err("max_step"));
    assert_eq!(with(|i| i.steps = Steps::Longest(f64::NAN)), Err("max_step"));
    assert_eq!(with(|i| i.tolerance.rtol = -1e-6), Err("rtol"));
    assert_eq!(with(|i| i.tolerance.atol = f64::INFINITY), Err("atol"));
    assert_eq!(with(|i| i.tolerance = Tolerance { rtol: 0.0, atol: 0.0 }), Err("rtol"));
    assert_eq!(with(|i| i.limit = 0), Err("substeps"));
}
