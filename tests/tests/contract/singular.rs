//! Singular covariances: what is known stays known, in every method and its smoothers.

use crate::{distance, run};
use givens::Goal;
use givens::filter::{Method, SrEkf};
use givens::registry::FormName;
use givens_tests::cases;
use givens_tests::choices::choices;
use givens_tests::exact::{Moments, conditioned};
use givens_tests::models::{Normals, Problem};
use givens_tests::worst;
use proptest::prelude::*;

const ROWS: usize = 6;

/// Makes a covariance of the problem singular, in one way out of seven.
fn degenerate(problem: &mut Problem, way: usize, seed: u64) {
    let n = problem.mean.len();
    let (mut normals, which) = (Normals::new(seed ^ 7), seed as usize % n);
    let line = normals.covariance(n, 1) * 0.1;
    match way {
        0 => problem.model.q.fill(0.0),
        1 => problem.model.q = line,
        // an exactly known, constant state
        2 => {
            for matrix in [&mut problem.cov, &mut problem.model.q, &mut problem.model.f] {
                matrix.row_mut(which).fill(0.0);
            }
            for matrix in [&mut problem.cov, &mut problem.model.q] {
                matrix.column_mut(which).fill(0.0);
            }
            problem.model.f[(which, which)] = 1.0;
        }
        // all known, and of growing rank
        3 => {
            problem.cov.fill(0.0);
            problem.model.q = line;
        }
        // the last state is the first one once more
        4 => {
            let (first, last) = (0, n - 1);
            for matrix in [&mut problem.cov, &mut problem.model.q] {
                let row = matrix.row(first).into_owned();
                matrix.set_row(last, &row);
                let column = matrix.column(first).into_owned();
                matrix.set_column(last, &column);
            }
            let row = problem.model.f.row(first).into_owned();
            problem.model.f.set_row(last, &row);
            problem.mean[last] = problem.mean[first];
        }
        // a transition that forgets a direction, without noise
        5 => {
            problem.model.q.fill(0.0);
            let kept = problem.model.f.row((which + 1) % n) * 0.5;
            problem.model.f.set_row(which, &kept);
        }
        // a prior of rank one
        _ => problem.cov = line * 10.0,
    }
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn every_method_filters_and_smooths_singular_covariances(
        seed: u64, n in 1usize..=5, d in 1usize..=3, way in 0usize..7,
    ) {
        let mut problem = Problem::random(seed, n, d, ROWS, 0.0);
        degenerate(&mut problem, way, seed);
        problem.draw(seed, ROWS);
        let smoothed = conditioned(&problem, ROWS);
        let filtered: Vec<Moments> = (1..=ROWS).map(|k| conditioned(&problem, k).swap_remove(k)).collect();
        for (name, choice) in choices(n) {
            let est = run(&choice, &problem, Goal::Interval);
            let filter = worst((0..ROWS).map(|k| far(est.filtered_mean(k), est.filtered_cov(k), &filtered[k])));
            let bound = if choice.form == FormName::SquareRoot { 1e-10 } else { 1e-8 };
            prop_assert!(filter < bound, "{name}, way {way}: filter {filter:e}");
            let smoother = worst((0..ROWS).map(|k| far(est.mean(k), est.cov(k), &smoothed[k + 1])));
            // the gain divides by P⁻ or by its root: what is nearly singular costs digits, twice as many or as many
            let bound = match choice.form {
                FormName::SquareRoot => 1e-10 + 1e-13 / narrowest(&problem, 1e-13),
                FormName::Covariance => 1e-9 + 1e-13 / narrowest(&problem, 1e-8).powi(2),
            };
            prop_assert!(smoother < bound, "{name}, way {way}: smoother {smoother:e}, {bound:e}");
        }
    }

    #[test]
    fn a_constant_has_at_every_time_the_value_it_ends_with(seed: u64, n in 1usize..=5, d in 1usize..=3) {
        let mut problem = Problem::random(seed, n, d, ROWS, 0.05);
        let which = seed as usize % n;
        for matrix in [&mut problem.model.f, &mut problem.model.b, &mut problem.model.q] {
            matrix.row_mut(which).fill(0.0);
        }
        problem.model.q.column_mut(which).fill(0.0);
        problem.model.f[(which, which)] = 1.0;
        problem.draw(seed, ROWS);
        for (name, choice) in choices(n) {
            let est = run(&choice, &problem, Goal::Interval);
            let (value, std) = (est.filtered_mean(ROWS - 1)[which], est.std(ROWS - 1, which));
            for k in 0..ROWS {
                let error = ((est.mean(k)[which] - value) / std).abs().max((est.std(k, which) / std - 1.0).abs());
                prop_assert!(error < 1e-9, "{name}, row {k}: {error:e}");
            }
        }
    }
}

/// The least of all predicted standard deviations of a state given the states before it, relative to its own and above
/// `rounding`. A transition without noise can make it a hundredth of itself at every step.
fn narrowest(problem: &Problem, rounding: f64) -> f64 {
    let prior = problem.prior();
    let mut filter = SrEkf::default().start(&problem.model, 0.0, &prior).unwrap();
    let (n, mut least) = (problem.mean.len(), 1.0f64);
    for row in problem.rows() {
        filter.predict(row.time).unwrap();
        for i in 0..n {
            let s = &filter.factor()[i * n..=i * n + i];
            let ratio = s[i] / s.iter().map(|x| x * x).sum::<f64>().sqrt();
            least = if ratio > rounding { least.min(ratio) } else { least };
        }
        let present: Vec<bool> = row.z.iter().map(|z| !z.is_nan()).collect();
        filter.update_present(&problem.sensor, row.z, &present).unwrap();
    }
    least
}

/// As [`distance`], but a standard deviation below a millionth is rounding of the exact roads.
fn far(mean: &[f64], cov: &[f64], expected: &Moments) -> f64 {
    let (mut of, mut cov) = (expected.clone(), cov.to_vec());
    let n = mean.len();
    for i in 0..n {
        if of.1[(i, i)] < 1e-12 {
            of.1.row_mut(i).fill(0.0);
            of.1.column_mut(i).fill(0.0);
            // its covariances with the others are no larger than it: only its own variance is compared
            for j in (0..n).filter(|&j| j != i) {
                (cov[i * n + j], cov[j * n + i]) = (0.0, 0.0);
            }
        }
    }
    distance(mean, &cov, &of)
}

#[test]
fn what_is_known_exactly_has_no_variance_ever_after() {
    let mut problem = Problem::random(8, 4, 2, ROWS, 0.05);
    for matrix in [&mut problem.model.f, &mut problem.model.b, &mut problem.model.q] {
        matrix.row_mut(0).fill(0.0);
    }
    problem.model.q.column_mut(0).fill(0.0);
    problem.model.f[(0, 0)] = 1.0;
    problem.cov.row_mut(0).fill(0.0);
    problem.cov.column_mut(0).fill(0.0);
    problem.draw(8, ROWS);
    for (name, choice) in choices(4) {
        let est = run(&choice, &problem, Goal::Interval);
        for k in 0..ROWS {
            for cov in [est.predicted_cov(k), est.filtered_cov(k), est.cov(k)] {
                assert!(cov[..4].iter().all(|&x| x == 0.0), "{name}, row {k}: {cov:?}");
            }
            for mean in [est.predicted_mean(k), est.filtered_mean(k), est.mean(k)] {
                assert_eq!(mean[0], problem.mean[0], "{name}, row {k}");
            }
        }
    }
}
