//! `sde_it15_step` of `golden/continuous.json`: one Itô–Taylor step of order 1.5 with given noise.

use givens::model::At;
use givens::model::zoo::Turn3d;
use givens::simulate::{Path, Paths};
use givens_tests::{golden, numbers};

#[test]
fn a_step_with_given_noise_is_the_oracles() {
    let step = &golden("continuous.json")["sde_it15_step"];
    let of = |key: &str| numbers(&step[key]);
    let turn = Turn3d::default();
    let mut path = Path::new(&turn, Paths::default()).unwrap();
    let (mut x, expected) = (of("x"), of("out"));
    let at = At { t: 0.0, dt: step["d"].as_f64().unwrap(), u: &[], p: &[] };
    path.step(&at, &mut x, &of("u1"), &of("u2")).unwrap();
    for (x, expected) in x.iter().zip(&expected) {
        assert!((x - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{x} and {expected}");
    }
}
