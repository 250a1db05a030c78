//! Numbers and lengths at the ends of what there is, most of them found by fuzzing: refused by name, never a panic, and never
//! an answer without a word.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use givens::filter::{Carried, Fault, Filter, Gaussian, InvalidCovariance, Method, Over, Quantity, SrCkf};
use givens::filter::{SrCdUkf1, SrEkf, StepError, factor_of_covariance};
use givens::metrics::{chi_squared_band, chi_squared_cdf, chi_squared_quantile, nees};
use givens::model::zoo::{CoordinatedTurn, RangeBearing, Turn3d};
use givens::model::{At, Noise, Observation, Sde, Transition};
use givens::ode::Steps;
use givens::scalar::Real;
use givens::simulate::{Path, Paths, Scheme, Stream, simulate, simulate_continuous};
use givens::smoother::{FixedPoint, History};
use givens::{Data, Estimates};

/// Two states that stay, in steps of one second.
struct Still;

impl Transition for Still {
    fn states(&self) -> usize {
        2
    }
    fn transition<T: Real>(&self, _: &At<T>, x: &[T], next: &mut [T]) {
        next.copy_from_slice(x);
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn process_noise<T: Real>(&self, _: &At<T>, cov: &mut [T]) {
        cov.fill(T::zero());
    }
    fn period(&self) -> Option<f64> {
        Some(1.0)
    }
}

/// A sensor so steep and so noisy that its standard deviation is beyond the largest number, though neither part is.
struct Steep;

impl Observation for Steep {
    fn states(&self) -> usize {
        2
    }
    fn measures(&self) -> usize {
        1
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        z[0] = x[0] * T::of(1.5e308);
    }
    fn noise(&self) -> Noise {
        Noise::Root(1)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, root: &mut [T]) {
        root[0] = T::of(1.5e308);
    }
}

fn unit(n: usize) -> Gaussian {
    Gaussian::from_std(&vec![0.0; n], &vec![1.0; n]).unwrap()
}

#[test]
fn an_innovation_that_overflows_is_an_error_and_not_a_measurement_that_says_nothing() {
    let mut filter = SrEkf::default().start(&Still, 0.0, unit(2)).unwrap();
    let fault = filter.update(&Steep, &[3.0]).unwrap_err().fault;
    assert_eq!(fault, Fault::NotFinite { quantity: Quantity::Innovation, component: 0 });
    assert_eq!(filter.mean(), [0.0, 0.0]);
}

/// A state that stays but for its noise.
struct Pushed;

impl Sde for Pushed {
    fn states(&self) -> usize {
        1
    }
    fn noises(&self) -> usize {
        1
    }
    fn drift<T: Real>(&self, _: &At<T>, _: &[T], out: &mut [T]) {
        out[0] = T::zero();
    }
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], out: &mut [T]) {
        out[0] = T::one();
    }
}

#[test]
fn a_step_so_long_that_its_noise_overflows_is_an_error() {
    // the cube of the gap's root is beyond the largest number
    let mut filter = SrCdUkf1::default().start(&Pushed, 0.0, unit(1)).unwrap();
    let fault = filter.predict(1e300).unwrap_err().fault;
    assert_eq!(fault, Fault::NotFinite { quantity: Quantity::Diffusion, component: 0 });
    assert_eq!((filter.mean(), filter.factor()), (&[0.0][..], &[1.0][..]));
}

#[test]
fn a_gap_of_more_than_ten_million_steps_is_refused() {
    let mut filter = SrCkf::default().start(&Still, 0.0, unit(2)).unwrap();
    let fault = filter.predict(1e12).unwrap_err().fault;
    assert!(matches!(fault, Fault::Mismatch { why } if why.contains("same unit")), "{fault}");
    filter.predict(1000.0).unwrap();
}

#[test]
fn a_snapshot_may_bring_the_largest_count_of_steps() {
    let turn = CoordinatedTurn::default();
    let prior =
        Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01]).unwrap();
    let first = SrCkf::default().start(&turn, 0.0, &prior).unwrap();
    let carried = Carried { step: usize::MAX, ..first.carried() };
    let sizes = SrCkf::default().sizes(&turn).unwrap();
    let memory =
        vec![
            0.0;
            Filter::<SrCkf, CoordinatedTurn, f64, Vec<f64>>::memory_len(&SrCkf::default(), sizes, false)
        ];
    let mut filter = Filter::resume_in(SrCkf::default(), &turn, sizes, false, carried, memory).unwrap();
    filter.predict(1.0).unwrap();
    filter.predict(2.0).unwrap();
    assert_eq!(filter.carried().step, usize::MAX);
}

#[test]
fn lengths_that_no_memory_has_are_the_largest_number_or_refused() {
    let n = usize::MAX / 2;
    assert_eq!(History::<f64, Vec<f64>>::record_len(n), usize::MAX);
    assert_eq!(History::<f64, Vec<f64>>::memory_len(n, 1), usize::MAX);
    assert_eq!(History::<f64, Vec<f64>>::memory_len(2, usize::MAX), usize::MAX);
    assert_eq!(FixedPoint::<f64, Vec<f64>>::memory_len(n), usize::MAX);
    assert_eq!(Estimates::row_bytes(n, 1, true), usize::MAX);
    assert_eq!(givens::Stream::bytes_per_row(givens::Goal::Interval, n, n), usize::MAX);
    assert!(History::<f64, Vec<f64>>::new(n, true, vec![0.0; 10]).is_empty());
    let refused = factor_of_covariance::<f64>(&[], 1 << 32, &mut []);
    assert_eq!(refused, Err(InvalidCovariance::Length { expected: usize::MAX, found: 0 }));
}

#[test]
fn the_error_of_an_estimate_wants_a_covariance_of_its_length() {
    assert_eq!(nees(&[1.0, 2.0], &[1.0]), None);
    assert_eq!(nees(&[1.0], &[4.0]), Some((0.25, 1)));
}

#[test]
fn a_path_that_is_not_finite_is_refused_and_the_state_as_before() {
    let turn = Turn3d::default();
    for (scheme, x, u1) in [
        (Scheme::EulerMaruyama, f64::NAN, 0.0),
        (Scheme::ItoTaylor, f64::NAN, 0.0),
        (Scheme::EulerMaruyama, 0.0, f64::INFINITY),
        (Scheme::EulerMaruyama, 1.7e308, 1.7e308),
    ] {
        let mut path = Path::new(&turn, Paths { scheme, ..Paths::default() }).unwrap();
        let before = [1.0, x, 2.0, x, 3.0, x, 0.1];
        let mut state = before;
        let at = At { t: 0.0, dt: 1.0, u: &[], p: &[] };
        let fault = path.step(&at, &mut state, &[u1; 4], &[0.0; 4]).unwrap_err();
        assert!(matches!(fault, Fault::NotFinite { .. }), "{fault}");
        assert_eq!(state.map(f64::to_bits), before.map(f64::to_bits));
    }
}

/// A path of Turn3d over one gap of a second.
fn path(steps: Steps) -> Result<(), StepError> {
    let prior = Gaussian::from_std(&[1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.1], &[0.0; 7]).unwrap();
    let (paths, stream) = (Paths { steps, ..Paths::default() }, &mut Stream::new(1, 0, 0));
    let sensor = givens::model::zoo::Radar3d::default();
    let mut rows = Data::new(3).starting_at(0.0);
    rows.push(1.0, &[0.0; 3]).unwrap();
    simulate_continuous(&Turn3d::default(), &sensor, rows.rows(), 0.0, &prior, &paths, stream).map(|_| ())
}

#[test]
fn a_path_takes_no_more_steps_than_a_filter() {
    assert!(path(Steps::Longest(0.1)).is_ok());
    for longest in [1e-9, 1e-300] {
        let fault = path(Steps::Longest(longest)).unwrap_err().fault;
        assert!(matches!(fault, Fault::Option(error) if error.option == "max_step"), "{fault}");
    }
}

#[test]
fn simulation_refuses_lengths_that_are_not_the_models() {
    let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
    let rows = |measures: usize, controls: usize| {
        let mut data = Data::with_controls(measures, controls);
        data.push_controlled(1.0, &vec![0.0; measures], &vec![0.0; controls]).unwrap();
        data
    };
    let refused = |data: &Data, n: usize| {
        let drawn = simulate(&turn, &radar, data.rows(), 0.0, &unit(n), &mut Stream::new(1, 0, 0));
        match drawn.map_err(|error| error.fault) {
            Err(Fault::Length { of, expected, found }) => (of, expected, found),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(refused(&rows(2, 0), 4), ("the prior", 5, 4));
    assert_eq!(refused(&rows(3, 0), 5), ("measurement", 2, 3));
    assert_eq!(refused(&rows(2, 1), 5), ("controls", 0, 1));
}

#[test]
fn quantiles_of_more_freedom_than_has_digits_are_none() {
    assert!(chi_squared_quantile(1e300, 0.5).is_nan() && chi_squared_cdf(1e11, 1e11).is_nan());
    assert!(chi_squared_band(f64::INFINITY).0.is_nan());
    let (low, high) = chi_squared_band(1e8);
    // a normal variable of variance 2 dof
    assert!((low - (1e8 - 1.959_964 * 2e8_f64.sqrt())).abs() < 10.0 && high > 1e8, "{low} {high}");
}
