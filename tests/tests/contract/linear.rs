//! On a linear model every method is the Kalman filter, and its smoother the Rauch–Tung–Striebel smoother.

use crate::{distance, run};
use givens::Goal;
use givens_tests::cases;
use givens_tests::choices::choices;
use givens_tests::exact::{conditioned, kalman, least_squares};
use givens_tests::models::Problem;
use givens_tests::worst;
use proptest::prelude::*;

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn the_three_exact_roads_agree(seed: u64, n in 1usize..=6, d in 1usize..=4) {
        let problem = Problem::random(seed, n, d, 7, 0.0);
        let answer = kalman(&problem);
        let (squares, joint) = (least_squares(&problem), conditioned(&problem, 7));
        for k in 0..7 {
            for (mean, cov) in [&squares[k], &joint[k + 1]] {
                prop_assert!(distance(mean.as_slice(), cov.as_slice(), &answer.smoothed[k]) < 1e-9);
            }
            let filtered = &conditioned(&problem, k + 1)[k + 1];
            prop_assert!(distance(filtered.0.as_slice(), filtered.1.as_slice(), &answer.filtered[k]) < 1e-9);
        }
    }

    #[test]
    fn every_method_is_the_exact_filter_and_smoother(seed: u64, n in 1usize..=6, d in 1usize..=4) {
        let problem = Problem::random(seed, n, d, 7, 0.0);
        let answer = kalman(&problem);
        for (name, choice) in choices(n) {
            let est = run(&choice, &problem, Goal::Interval);
            let row = |k: usize| {
                let log_likelihood = (est.log_likelihood[k] - answer.log_likelihood[k]).abs();
                let predicted = distance(est.predicted_mean(k), est.predicted_cov(k), &answer.predicted[k]);
                let filtered = distance(est.filtered_mean(k), est.filtered_cov(k), &answer.filtered[k]);
                let smoothed = distance(est.mean(k), est.cov(k), &answer.smoothed[k]);
                worst([predicted, filtered, smoothed, log_likelihood].into_iter())
            };
            let error = worst((0..7).map(row));
            prop_assert!(error < 1e-10, "{name}: {error:e}");
        }
    }
}
