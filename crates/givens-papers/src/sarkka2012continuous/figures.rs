//! What the text says of Figures 1 and 2.

use super::runs::{Cells, METHODS, STEPS};
use crate::Claim;
use crate::statistics::root_mean;

/// Error of a filter, by its key, with so many steps; not a number where no run was kept.
fn error(cells: &Cells, key: &str, steps: usize) -> f64 {
    let method = METHODS.iter().position(|method| method.key == key);
    let at = STEPS.iter().position(|&m| m == steps);
    method.zip(at).map_or(f64::NAN, |(i, j)| root_mean(cells[i][j].squares.iter().copied()))
}

/// The largest of the ratios of the errors of two filters over numbers of steps, either way up.
fn apart(cells: &Cells, pairs: &[(&str, &str)], steps: &[usize]) -> f64 {
    let ratio = |(a, b): &(&str, &str), m: usize| {
        let ratio = error(cells, a, m) / error(cells, b, m);
        ratio.max(1.0 / ratio)
    };
    pairs.iter().flat_map(|pair| steps.iter().map(move |&m| ratio(pair, m))).fold(1.0, f64::max)
}

const ALIKE: f64 = 1.1;

fn alike(what: &str, apart: f64) -> Claim {
    Claim::statement(what, format!("a factor of {apart:.2} apart at most"), apart < ALIKE)
}

/// Figure 1.
pub(super) fn one(cells: &Cells) -> Vec<Claim> {
    let steps = |m: &usize| error(cells, "ekf", *m);
    let (low, high) =
        (STEPS.iter().map(steps).fold(f64::INFINITY, f64::min), STEPS.iter().map(steps).fold(0.0, f64::max));
    vec![
        alike(
            "the Itô–Taylor filters have practically the same errors",
            apart(cells, &[("ckf1", "ukf1"), ("ckf1", "ghkf1")], &STEPS),
        ),
        alike(
            "so have the moment filters from M = 16",
            apart(cells, &[("ckf1", "ckf2"), ("ukf1", "ukf2"), ("ghkf1", "ghkf2")], &[16, 32, 64]),
        ),
        Claim::statement(
            "the CD-EKF's errors are high with some M and low with others",
            format!("from {low:.0} to {high:.3e} m"),
            high > 3.0 * low,
        ),
    ]
}

/// Figure 2.
pub(super) fn two(cells: &Cells) -> Vec<Claim> {
    let of = |key: &str, m: usize| error(cells, key, m);
    let best = |m: usize| of("ckf1", m).min(of("ghkf1", m));
    let times = STEPS.iter().map(|&m| of("ekf", m) / best(m)).fold(f64::INFINITY, f64::min);
    let late = [8, 16, 32, 64];
    let smaller = |hermite: &str, others: [&str; 2]| {
        late.iter().all(|&m| others.iter().all(|other| of(hermite, m) < of(other, m)))
    };
    let ratio = late.iter().map(|&m| of("ghkf1", m) / of("ckf1", m)).fold(0.0, f64::max);
    vec![
        Claim::statement(
            "the CD-EKF's errors are an order of magnitude higher than the others'",
            format!("{times:.1} times those of the better Itô–Taylor filter, at least"),
            times >= 5.0,
        ),
        alike(
            "corresponding filters by Itô–Taylor and by moments have practically the same errors after M = 8",
            apart(cells, &[("ckf1", "ckf2"), ("ghkf1", "ghkf2")], &[16, 32, 64]),
        ),
        Claim::statement(
            "from M = 8 both Gauss–Hermite filters have smaller errors than the cubature and unscented ones",
            format!("GHKF1 at most {ratio:.3} of CKF1"),
            smaller("ghkf1", ["ckf1", "ukf1"]) && smaller("ghkf2", ["ckf2", "ukf2"]),
        ),
    ]
}
