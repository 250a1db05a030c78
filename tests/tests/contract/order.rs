//! The order of the states. A rule of points sees the lower Cholesky factor, which another order turns into another root
//! of the same matrix: the answer is the same where the rule is exact, or where it does not depend on the root.

use crate::{apart, run};
use givens::registry::{Choice, RuleName};
use givens::{Estimates, Goal, Row};
use givens_tests::cases;
use givens_tests::choices::choices;
use givens_tests::models::{Normals, Problem};
use givens_tests::{cov_error, mean_error};
use nalgebra::DMatrix;
use proptest::prelude::*;

/// A random order, by sorting random numbers.
fn order(seed: u64, n: usize) -> Vec<usize> {
    let keys = Normals::new(seed ^ 1).vector(n);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| keys[a].total_cmp(&keys[b]));
    order
}

/// The same problem with its states in another order.
fn reordered(problem: &Problem, order: &[usize]) -> Problem {
    let both = |of: &DMatrix<f64>| of.select_rows(order).select_columns(order);
    let mut other = problem.clone();
    other.model.f = both(&problem.model.f);
    other.model.b = both(&problem.model.b);
    other.model.q = both(&problem.model.q);
    other.sensor.h = problem.sensor.h.select_columns(order);
    other.sensor.g = problem.sensor.g.select_columns(order);
    other.mean = order.iter().map(|&i| problem.mean[i]).collect();
    other.cov = both(&problem.cov);
    other
}

/// How far the answers of the reordered problem are from those of the first one, reordered.
fn change(a: &Estimates, b: &Estimates, order: &[usize]) -> f64 {
    let n = order.len();
    let row = |k: usize| {
        let mean: Vec<f64> = order.iter().map(|&i| a.mean(k)[i]).collect();
        let element = |(i, j): (usize, usize)| a.cov(k)[order[i] * n + order[j]];
        let cov: Vec<f64> = (0..n * n).map(|at| element((at / n, at % n))).collect();
        mean_error(b.mean(k), &mean, &cov).max(cov_error(b.cov(k), &cov, n))
    };
    givens_tests::worst((0..a.len()).map(row))
}

fn changes(seed: u64, problem: &Problem, choice: &Choice) -> f64 {
    let order = order(seed, problem.mean.len());
    let other = reordered(problem, &order);
    change(&run(choice, problem, Goal::Interval), &run(choice, &other, Goal::Interval), &order)
}

proptest! {
    #![proptest_config(cases(12))]

    #[test]
    fn the_order_of_states_does_not_matter_on_a_linear_model(seed: u64, n in 2usize..=6, d in 1usize..=4) {
        let problem = Problem::random(seed, n, d, 6, 0.0);
        for (name, choice) in choices(n) {
            let change = changes(seed, &problem, &choice);
            prop_assert!(change < 1e-10, "{name}: {change:e}");
        }
    }

    #[test]
    fn it_does_not_matter_to_taylor_and_for_quadratic_maps_not_to_rules_of_degree_five(
        seed: u64, n in 2usize..=6, d in 1usize..=4,
    ) {
        let mut problem = Problem::random(seed, n, d, 6, 0.05);
        let quadratic = Problem { model: problem.model.clone(), ..problem.clone() };
        for (name, choice) in choices(n).into_iter().filter(|of| of.1.rule == RuleName::Taylor) {
            let change = changes(seed, &problem, &choice);
            prop_assert!(change < 1e-10, "{name}: {change:e}");
        }
        problem = quadratic;
        problem.model.bend = 0.0;
        for (name, choice) in choices(n) {
            let five = choice.rule == RuleName::Cubature5
                || (choice.rule == RuleName::GaussHermite && choice.gauss_hermite.points >= 3);
            let change = if five { changes(seed, &problem, &choice) } else { 0.0 };
            prop_assert!(change < 1e-10, "{name}: {change:e}");
        }
    }

    #[test]
    fn with_uncorrelated_states_it_matters_to_no_rule(seed: u64, n in 2usize..=6, d in 1usize..=4) {
        let mut problem = Problem::random(seed, n, d, 1, 0.1);
        problem.cov = DMatrix::from_diagonal(&problem.cov.diagonal());
        let (order, z) = (order(seed, n), problem.z[0].clone());
        let other = reordered(&problem, &order);
        // an update of the prior itself, which is still uncorrelated
        let rows = || [Row { time: 0.0, z: &z, u: &[] }].into_iter();
        for (name, choice) in choices(n) {
            let est = [&problem, &other].map(|of| {
                choice.run(&of.model, &of.sensor, rows(), 0.0, &of.prior(), Goal::Filter, &[]).into_result().unwrap()
            });
            let change = change(&est[0], &est[1], &order);
            prop_assert!(change < 1e-11, "{name}: {change:e}");
        }
    }
}

#[test]
fn it_does_matter_to_the_rules_of_degree_three() {
    let mut problem = Problem::random(3, 4, 2, 6, 0.05);
    problem.model.bend = 0.0;
    for (name, choice) in choices(4) {
        let three = match choice.rule {
            RuleName::Cubature3 | RuleName::Unscented => true,
            // with η = 1 it sees the trace of a curvature alone
            RuleName::CentralDifference => choice.central_difference.eta > 1.0,
            _ => false,
        };
        if three {
            assert!(changes(3, &problem, &choice) > 1e-6, "{name}");
        }
    }
}

#[test]
fn the_order_of_measures_does_not_matter() {
    let problem = Problem::random(4, 4, 3, 6, 0.05);
    let mut other = problem.clone();
    other.sensor = problem.sensor.only(&[2, 0, 1]);
    other.z.iter_mut().for_each(|z| z.rotate_right(1));
    for (name, choice) in choices(4) {
        let [mut a, mut b] = [&problem, &other].map(|of| run(&choice, of, Goal::Interval));
        for est in [&mut a, &mut b] {
            est.innovation.fill(0.0);
        }
        assert!(apart(&a, &b) < 1e-11, "{name}");
    }
}
