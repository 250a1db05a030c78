//! A filter's counters say what its drift was asked.

use givens::filter::{Filter, Gaussian, Lskf, Method, Over, SrCdCkf2};
use givens::model::zoo::VanDerPol;
use givens::ode::{Solver, Work};
use givens_tests::counted::Counted;

/// The counters and the evaluations of one prediction; a Jacobian is one evaluation in duals for each component of the
/// solver's state and one for time.
fn predicted<X: Over<Counted<VanDerPol>>>(method: X) -> (Work, usize) {
    let model = Counted::new(VanDerPol::default());
    let prior = Gaussian::from_std(&[2.0, 0.0], &[0.3, 0.3]).unwrap();
    let mut filter: Filter<_, _, _, _> = method.start(&model, 0.0, &prior).unwrap();
    model.take();
    filter.predict(0.5).unwrap();
    (filter.work(), model.take())
}

#[test]
fn the_work_of_a_prediction_counts_every_evaluation_of_the_drift() {
    for solver in Solver::ALL {
        let moments = predicted(SrCdCkf2 { solver, ..Default::default() });
        let level_set = predicted(Lskf { solver, ..Default::default() });
        // mean and lower triangle, mean and whole root; the cubature rule has four points
        for ((work, evaluations), len) in [(moments, 5), (level_set, 6)] {
            assert_eq!(
                evaluations,
                4 * (work.calls + 3 * (len + 1) * work.jacobians),
                "{solver:?}: {work:?}"
            );
        }
    }
}
