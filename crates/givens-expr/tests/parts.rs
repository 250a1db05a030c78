//! What models are made of: noise, parameters, starts, and parts that do not fit.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod turn;

use givens_core::model::{At, Noise, Observation, Transition};
use givens_expr::{
    Graph, Input, Meaning, ModelError, ModelObservation, ModelStart, ModelTransition, NoiseBlock,
    ObservationParts, Scope, StartParts, TransitionParts, parse,
};
use turn::Turn;

#[test]
fn sensors_stack_their_noise_on_the_diagonal() {
    let mut turn = Turn::new();
    let parts = ObservationParts {
        states: 5,
        parameters: 1,
        measures: turn.read_all(&["x", "x", "y", "vx", "vy", "w"]),
        angles: vec![None; 6],
        noise: vec![
            NoiseBlock::Std(turn.read_all(&["p"])),
            NoiseBlock::Cov(turn.read_all(&["4", "2", "2", "t"])),
            NoiseBlock::Std(turn.read_all(&["3", "0"])),
            NoiseBlock::Cov(turn.read_all(&["9*p^2"])),
        ],
        ..Default::default()
    };
    let model = ModelObservation::new(&mut turn.graph, parts).unwrap();
    assert_eq!((model.noise(), model.parameters(), model.controls()), (Noise::Root(6), 1, 0));
    let root_at = |t: f64, p: f64| {
        let mut root = [7.0; 36];
        let health = model.noise_root(&At { t, dt: 0.0, u: &[], p: &[p] }, &mut root);
        (root, health.failed())
    };
    let (root, failed) = root_at(10.0, 0.5);
    let mut wanted = [0.0; 36];
    for (row, column, value) in
        [(0, 0, 0.5), (1, 1, 2.0), (2, 1, 1.0), (2, 2, 3.0), (3, 3, 3.0), (4, 4, 0.0), (5, 5, 1.5)]
    {
        wanted[row * 6 + column] = value;
    }
    assert_eq!((root, failed), (wanted, None));
    // a negative deviation, and a covariance whose second pivot, the third of all, is negative
    assert_eq!(root_at(10.0, -0.5).1, Some(0));
    assert_eq!(root_at(0.5, 0.5).1, Some(2));
    assert_eq!(root_at(f64::NAN, 0.5).1, Some(2));
    let mut root = [0.0_f64; 36];
    model.measurement_noise(&At { t: 0.5, dt: 0.0, u: &[], p: &[0.5] }, &mut root);
    assert!(root[0].is_nan());
}

#[test]
fn parameters_controls_and_time_reach_the_model() {
    let mut turn = Turn::new();
    let next = turn.read_all(&["x + p*u_a*dt + t"]);
    let parts = TransitionParts {
        states: 1,
        controls: 1,
        parameters: vec![2.0],
        period: Some(0.5),
        next,
        noise_cov: vec![],
    };
    let mut model = ModelTransition::new(&mut turn.graph, parts).unwrap();
    assert_eq!((model.states(), model.controls(), model.period()), (1, 1, Some(0.5)));
    assert_eq!((model.parameters(), model.noise()), (&[2.0][..], Noise::Root(0)));
    model.process_noise(&At { t: 0.0, dt: 1.0, u: &[], p: &[] }, &mut []);
    let mut out = [0.0];
    let at = At { t: 100.0, dt: 0.5, u: &[4.0], p: model.parameters() };
    model.transition(&at, &[1.0], &mut out);
    assert_eq!(out, [105.0]);
    model.set_parameters(&[-2.0]).unwrap();
    assert_eq!(model.parameters(), [-2.0]);
    assert_eq!(
        model.set_parameters(&[]).unwrap_err(),
        ModelError::Length { what: "the parameters", expected: 1, found: 0 }
    );
    assert!(model.set_parameters(&[f64::NAN]).is_err());
    assert_eq!(model.parameters(), [-2.0]);
}

#[test]
fn parts_that_do_not_fit_are_named() {
    let mut turn = Turn::new();
    let (x, w, p, u, dt, z) = (
        turn.read("x"),
        turn.read("w"),
        turn.read("p"),
        turn.read("u_a"),
        turn.read("dt"),
        turn.graph.input(Input::Measure(0)),
    );
    let one = turn.graph.constant(1.0);
    let transition = TransitionParts { states: 1, next: vec![x], ..Default::default() };
    let observation = ObservationParts {
        states: 1,
        measures: vec![x],
        angles: vec![None],
        noise: vec![NoiseBlock::Std(vec![one])],
        ..Default::default()
    };
    let transitions = [
        (TransitionParts { next: vec![x, x], ..transition.clone() }, "the transition: 1 expected, 2 found"),
        (TransitionParts { next: vec![w], ..transition.clone() }, "may not name component 4 of the state"),
        (TransitionParts { next: vec![p], ..transition.clone() }, "may not name parameter 0"),
        (TransitionParts { next: vec![u], ..transition.clone() }, "may not name control 0"),
        (
            TransitionParts { next: vec![z], ..transition.clone() },
            "may not name component 0 of the measurement",
        ),
        (
            TransitionParts { noise_cov: vec![x], ..transition.clone() },
            "the covariance of the process noise: expression 0 (from zero) may not name component 0 of the state",
        ),
        (TransitionParts { noise_cov: vec![one; 2], ..transition.clone() }, "1 expected, 2 found"),
        (TransitionParts { parameters: vec![f64::INFINITY], ..transition.clone() }, "the parameters: inf"),
        (TransitionParts { period: Some(0.0), ..transition.clone() }, "the period of the transition: 0"),
        (
            TransitionParts { period: Some(f64::NAN), ..transition.clone() },
            "the period of the transition: NaN",
        ),
    ];
    for (parts, words) in transitions {
        let error = ModelTransition::new(&mut turn.graph, parts).unwrap_err().to_string();
        assert!(error.contains(words), "{error}, not {words}");
    }
    let observations = [
        (
            ObservationParts { angles: vec![], ..observation.clone() },
            "the periods of the angles: 1 expected, 0 found",
        ),
        (
            ObservationParts { angles: vec![Some(-1.0)], ..observation.clone() },
            "the periods of the angles: -1",
        ),
        (
            ObservationParts { measures: vec![dt], ..observation.clone() },
            "may not name the length of the step",
        ),
        (
            ObservationParts { noise: vec![], ..observation.clone() },
            "the noise of the measures: 1 expected, 0 found",
        ),
        (
            ObservationParts { noise: vec![NoiseBlock::Std(vec![x])], ..observation.clone() },
            "the noise of the measures: expression 0 (from zero) may not name component 0 of the state",
        ),
        (
            ObservationParts { noise: vec![NoiseBlock::Cov(vec![one; 3])], ..observation.clone() },
            "the covariance of a sensor: 1 expected, 3 found",
        ),
    ];
    for (parts, words) in observations {
        let error = ModelObservation::new(&mut turn.graph, parts).unwrap_err().to_string();
        assert!(error.contains(words), "{error}, not {words}");
    }
    let start = StartParts { measures: 1, states: vec![0], values: vec![x], ..Default::default() };
    let error = ModelStart::new(&mut turn.graph, start).unwrap_err().to_string();
    assert!(
        error.contains("the start: expression 0 (from zero) may not name component 0 of the state"),
        "{error}"
    );
}

#[test]
fn a_start_places_a_radar_return_with_its_slopes() {
    let (mut graph, mut scope) = (Graph::new(), Scope::new());
    for (i, name) in ["range", "bearing", "doppler"].into_iter().enumerate() {
        scope.insert(name, Meaning::Is(graph.input(Input::Measure(i as u32))));
    }
    let values = ["range*cos(bearing)", "range*sin(bearing)"]
        .map(|text| parse(&mut graph, &scope, text).unwrap())
        .to_vec();
    let parts = StartParts { measures: 3, states: vec![0, 2], values, ..Default::default() };
    let start = ModelStart::new(&mut graph, parts).unwrap();
    assert_eq!(start.states(), [0, 2]);
    assert_eq!([0, 1, 2, 3].map(|j| start.uses(j)), [true, true, false, false]);
    let (r, b) = (1500.0, 0.4_f64);
    let (s, c) = b.sin_cos();
    let (mut values, mut jacobian) = ([0.0; 2], [9.0; 6]);
    // a measure that is not named may be missing
    start.evaluate(&At { t: 0.0, dt: 0.0, u: &[], p: &[] }, &[r, b, f64::NAN], &mut values, &mut jacobian);
    assert_eq!(values, [r * c, r * s]);
    assert_eq!(jacobian, [c, -(s * r), 0.0, s, r * c, 0.0]);
    let mut short = [0.0_f64; 5];
    start.evaluate(&At { t: 0.0, dt: 0.0, u: &[], p: &[] }, &[r, b, 0.0], &mut values, &mut short);
    assert!(values.iter().chain(&short).all(|value| value.is_nan()));
}

#[test]
fn large_noise_needs_more_memory_than_the_stack_frame_and_is_right() {
    let mut turn = Turn::new();
    let n = 40;
    let text = |i: usize, j: usize| format!("{}*dt*p", 1.0 / (1.0 + i.abs_diff(j) as f64) + (i * j) as f64);
    let noise_cov = (0..n * n).map(|k| turn.read(&text(k / n, k % n))).collect();
    let next = vec![turn.read("x"); n];
    let parts = TransitionParts { states: n, parameters: vec![2.0], next, noise_cov, ..Default::default() };
    let model = ModelTransition::new(&mut turn.graph, parts).unwrap();
    let mut out = vec![0.0; n * n];
    model.process_noise(&At { t: 0.0, dt: 0.5, u: &[], p: model.parameters() }, &mut out);
    for (k, value) in out.into_iter().enumerate() {
        let (i, j) = (k / n, k % n);
        let wanted = 1.0 / (1.0 + i.abs_diff(j) as f64) + (i * j) as f64;
        assert!((value - wanted).abs() < 1e-12 * wanted);
    }
}
