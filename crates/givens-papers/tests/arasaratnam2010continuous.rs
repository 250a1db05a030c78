//! Small runs with a fixed seed, in wide bands about the counts of an independent program.

#![allow(clippy::unwrap_used)]

use givens_papers::arasaratnam2010continuous::{PAPER, lost};
use givens_papers::{Plan, Quiet};

fn of(runs: usize, nought: bool, omega: f64, interval: f64, steps: usize) -> usize {
    let plan = Plan { runs: Some(runs), seed: 1, progress: &Quiet };
    lost(&plan, 7e-4, nought, omega, interval, steps).unwrap()
}

#[test]
fn the_cubature_filter_breaks_down_at_six_degrees_and_eight_seconds_if_the_rate_is_drawn() {
    // 98 of 100: of 10, fewer than 7 come once in 10⁵ times
    assert!(of(10, false, 6.0, 8.0, 8) >= 7);
}

#[test]
fn and_loses_fewer_if_the_rate_starts_at_nought() {
    // 37 of 100: of 10, more than 9 come once in 10⁴ times
    assert!(of(10, true, 6.0, 8.0, 8) <= 9);
}

#[test]
fn at_three_degrees_and_two_seconds_it_keeps_its_runs() {
    assert_eq!(of(4, false, 3.0, 2.0, 2), 0);
}

#[test]
fn the_operations_are_counted_without_a_random_number() {
    let table = PAPER.experiments.iter().find(|experiment| experiment.name == "table-5").unwrap();
    let page = table.run(&Plan { runs: None, seed: 1, progress: &Quiet }).unwrap();
    assert_eq!(page.tables[0].rows.len(), 3);
    assert!(page.claims.len() == 2);
}
