//! The experiments of Wang & Forger 2021 that are quick enough for every day: what must hold, and the numbers of an
//! independent program. The radar runs have theirs beside the code.

#![allow(clippy::unwrap_used, clippy::panic)]

use givens_papers::{Cell, Page, Plan, Quiet, Verdict, find};

fn page(name: &str, runs: usize) -> Page {
    let plan = Plan { runs: Some(runs), seed: 7, progress: &Quiet };
    let found = find("wang2021levelset", Some(name)).unwrap();
    found[0].1.run(&plan).unwrap()
}

/// The number in `column` of the row that begins with these cells.
fn number(page: &Page, begins: &[Cell], column: &str) -> f64 {
    let table = &page.tables[0];
    let at = table.columns.iter().position(|name| name == column).unwrap();
    let row = table.rows.iter().find(|row| row.starts_with(begins)).unwrap();
    match &row[at] {
        Cell::Number(x) => *x,
        Cell::Word(word) => panic!("{word}"),
    }
}

fn all_hold(page: &Page, but: &str) {
    for claim in page.claims.iter().filter(|claim| but.is_empty() || !claim.what.contains(but)) {
        let sound = matches!(claim.verdict, Verdict::Holds | Verdict::NotRecoverable(_));
        assert!(sound, "{}: {}", claim.what, claim.ours);
    }
}

#[test]
fn the_level_set_converges_at_its_solvers_order() {
    let page = page("figure-1", 0);
    assert_eq!(page.claims.len(), 6);
    all_hold(&page, "");
}

#[test]
fn noise_once_stalls_where_an_independent_program_saw_it_stall() {
    let page = page("figure-2", 0);
    all_hold(&page, "");
    let error = |method: &str| number(&page, &[method.into(), 32usize.into()], "covariance");
    // 7.5e-7 and 7e-15 there, both to the digits given
    assert!((error("CD-CKF (noise once)") - 7.5e-7).abs() < 0.05e-7);
    assert!(error("LSKF-RK4") < 7.6e-15);
}

#[test]
fn in_the_quadratic_flow_only_the_cubature_radius_finds_the_mean() {
    // the differences of the errors are some ten standard deviations of the mean of 256 roots
    let page = page("figure-5", 256);
    all_hold(&page, "least error of the density");
    let mean = |velocity: &str| number(&page, &[velocity.into(), 1.0.into()], "mean of y");
    assert!(mean("standard").abs() < 1e-9);
    assert!((mean("averaged, central") - 0.5).abs() < 1e-9);
    assert!((mean("cubature radius") - 1.0).abs() < 1e-9);
}
