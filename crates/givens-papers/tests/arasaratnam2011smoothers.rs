//! A hundred runs of Table 4, in bands of 3.5 standard deviations about what independent programs measured in runs of a
//! thousand.

#![allow(clippy::unwrap_used)]

use givens_papers::{Cell, Plan, Quiet, find};

/// Estimator, state, mean and standard deviation of one replication of 1000 runs.
const MEASURED: [(&str, usize, f64, f64); 9] = [
    ("ckf", 0, 25.39, 0.23),
    ("ckf", 1, 54.66, 0.115),
    ("ckf", 2, 2.078e-3, 0.021e-3),
    ("eks", 0, 17.35, 0.32),
    ("eks", 1, 2.62, 0.041),
    ("cdks", 1, 2.119, 0.037),
    ("qks", 2, 2.25e-6, 0.05e-6),
    ("cks", 0, 16.24, 0.31),
    ("cks", 1, 2.121, 0.037),
];

#[test]
fn the_accumulated_errors_are_those_of_an_independent_program() {
    const RUNS: usize = 100;
    let (_, table) = find("arasaratnam2011smoothers", Some("table-4")).unwrap()[0];
    let page = table.run(&Plan { runs: Some(RUNS), seed: 2, progress: &Quiet }).unwrap();
    for (name, state, mean, spread) in MEASURED {
        let row = page.tables[0].rows.iter().filter(|row| row[0] == Cell::from(name)).nth(state).unwrap();
        let Cell::Number(ours) = row[3] else { unreachable!("{row:?}") };
        let band = 3.5 * spread * (1000.0 / RUNS as f64).sqrt();
        assert!((ours - mean).abs() < band, "{name}, state {state}: {ours}, not {mean} ± {band}");
    }
    assert!(page.failures.iter().all(|(_, failures)| failures.count() == 0));
}
