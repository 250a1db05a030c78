//! Models made of expressions, against the same models written by hand.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod turn;

use givens_core::model::zoo::{CoordinatedTurn, RangeBearing};
use givens_core::model::{At, Linear, Observation, Transition};
use givens_core::scalar::{Dual2, Real};
use turn::Turn;

fn at<T: Real>(dt: f64) -> At<'static, T> {
    At { t: T::zero(), dt: T::of(dt), u: &[], p: &[] }
}

fn linear<'a, T>(value: &'a mut [T], image: &'a mut [T], stride: usize) -> Linear<'a, T> {
    Linear { value, image, stride }
}

/// States of the turn, one of them straight on.
const STATES: [[f64; 5]; 3] =
    [[1000.0, 300.0, 1000.0, 0.0, -0.05], [-2e4, -120.0, 3e3, 80.0, 0.3], [50.0, 10.0, -7.0, 2.0, 0.0]];

const ROOT: [f64; 25] = [
    9.0, 0.0, 0.0, 0.0, 0.0, //
    1.0, 3.0, 0.0, 0.0, 0.0, //
    -2.0, 0.5, 8.0, 0.0, 0.0, //
    0.1, -0.7, 0.4, 2.5, 0.0, //
    0.01, 0.002, -0.003, 0.004, 0.02,
];

fn agree<T: Real>(found: &[T], wanted: &[T], tolerance: f64) {
    let size = wanted.iter().map(|value| value.first().abs()).fold(1.0, f64::max);
    for (i, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        let error = (found.first() - wanted.first()).abs();
        assert!(error <= tolerance * size, "{i}: {found:?}, not {wanted:?}");
    }
}

/// Every method of the trait against the model written by hand.
fn the_turn_is_the_turn_of_the_zoo<T: Real>(tolerance: f64) {
    let (model, zoo) = (Turn::new().transition(), CoordinatedTurn::default());
    let root = ROOT.map(T::of);
    for dt in [1.0, 0.1] {
        let at = at::<T>(dt);
        for state in STATES {
            let x = state.map(T::of);
            let (mut found, mut wanted) = ([T::zero(); 5], [T::zero(); 5]);
            model.transition(&at, &x, &mut found);
            zoo.transition(&at, &x, &mut wanted);
            agree(&found, &wanted, tolerance);

            let (mut found, mut wanted) = ([T::zero(); 5 * 7], [T::zero(); 5 * 7]);
            let (mut value, mut wanted_value) = ([T::zero(); 5], [T::zero(); 5]);
            let mut scratch = vec![T::zero(); model.transition_scratch(1)];
            model.transition_linear(&at, &x, &root, linear(&mut value, &mut found, 7), &mut scratch);
            let mut scratch = vec![T::zero(); zoo.transition_scratch(1)];
            zoo.transition_linear(&at, &x, &root, linear(&mut wanted_value, &mut wanted, 7), &mut scratch);
            agree(&value, &wanted_value, tolerance);
            agree(&found, &wanted, 10.0 * tolerance);
        }
        let points = STATES.len();
        let x: Vec<T> = (0..5 * points).map(|k| T::of(STATES[k % points][k / points])).collect();
        let (mut found, mut wanted) = (vec![T::zero(); 5 * points], vec![T::zero(); 5 * points]);
        let mut scratch = vec![T::zero(); model.transition_scratch(points)];
        model.transition_points(&at, points, &x, &mut found, &mut scratch);
        let mut scratch = vec![T::zero(); zoo.transition_scratch(points)];
        zoo.transition_points(&at, points, &x, &mut wanted, &mut scratch);
        agree(&found, &wanted, tolerance);

        let (mut found, mut wanted) = ([T::zero(); 25], [T::zero(); 25]);
        model.process_noise(&at, &mut found);
        zoo.process_noise(&at, &mut wanted);
        agree(&found, &wanted, tolerance);
        assert!(model.noise_root(&at, &mut found).failed().is_none());
        assert!(zoo.noise_root(&at, &mut wanted).failed().is_none());
        agree(&found, &wanted, 10.0 * tolerance);
    }
}

#[test]
fn the_turn_in_f64_is_the_zoo_s() {
    the_turn_is_the_turn_of_the_zoo::<f64>(1e-15);
}

#[test]
fn the_turn_in_f32_is_the_zoo_s() {
    the_turn_is_the_turn_of_the_zoo::<f32>(1e-6);
}

#[test]
fn the_turn_on_duals_is_the_zoo_s() {
    the_turn_is_the_turn_of_the_zoo::<Dual2<f64>>(1e-15);
    let (model, zoo) = (Turn::new().transition(), CoordinatedTurn::default());
    let x = STATES[0].map(|value| Dual2::along(value, 0.01 * value.abs().sqrt()));
    let (mut found, mut wanted) = ([Dual2::zero(); 5], [Dual2::zero(); 5]);
    model.transition(&at(1.0), &x, &mut found);
    zoo.transition(&at(1.0), &x, &mut wanted);
    agree(&found.map(|dual| dual.d), &wanted.map(|dual| dual.d), 1e-15);
    agree(&found.map(|dual| dual.dd), &wanted.map(|dual| dual.dd), 1e-14);
}

#[test]
fn the_radar_is_the_zoo_s() {
    let (model, zoo) = (Turn::new().radar(), RangeBearing::published());
    assert_eq!(
        (model.states(), model.measures(), model.angle(0), model.angle(1)),
        (5, 2, None, zoo.angle(1))
    );
    assert_eq!(model.angle(7), None);
    for state in STATES {
        let (mut found, mut wanted) = ([0.0; 2], [0.0; 2]);
        model.observe(&at(0.0), &state, &mut found);
        zoo.observe(&at(0.0), &state, &mut wanted);
        assert_eq!(found, wanted);
        let (mut found, mut wanted) = ([0.0; 12], [0.0; 12]);
        let (mut value, mut scratch) = ([0.0; 2], vec![0.0; 200]);
        assert!(model.observe_scratch(1) <= 200);
        model.observe_linear(&at(0.0), &state, &ROOT, linear(&mut value, &mut found, 6), &mut scratch);
        zoo.observe_linear(&at(0.0), &state, &ROOT, linear(&mut value, &mut wanted, 6), &mut scratch);
        agree(&found, &wanted, 1e-15);
    }
    let (mut found, mut wanted) = ([1.0; 4], [0.0; 4]);
    assert!(model.noise_root(&at(0.0), &mut found).failed().is_none());
    zoo.measurement_noise(&at(0.0), &mut wanted);
    assert_eq!(found, wanted);
}
