//! What overflows where no number that was given does: an error that names the component, and the belief as before.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use core::f64::consts::TAU;
use givens::Data;
use givens::filter::{Belief, Ckf, Covariance, Fault, Filter, Gaussian, Over, Prior, Quantity};
use givens::filter::{SrCkf, SrEkf, SrQkf};
use givens::model::{At, Noise, Observation, Transition};
use givens::scalar::Real;
use givens::simulate::{Stream, simulate};
use givens::smoother::{History, Smoothed};

/// Each state becomes a multiple of the first one.
struct Multiples([f64; 2]);

impl Transition for Multiples {
    fn states(&self) -> usize {
        2
    }
    fn transition<T: Real>(&self, _: &At<T>, x: &[T], next: &mut [T]) {
        next.copy_from_slice(&self.0.map(|factor| T::of(factor) * x[0]));
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

/// The first state, as an angle of this period.
struct Angle(f64);

impl Observation for Angle {
    fn states(&self) -> usize {
        2
    }
    fn measures(&self) -> usize {
        1
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        z[0] = x[0];
    }
    fn angle(&self, _: usize) -> Option<f64> {
        Some(self.0)
    }
    fn noise(&self) -> Noise {
        Noise::Root(1)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, root: &mut [T]) {
        root[0] = T::one();
    }
}

type Records = History<f64, Vec<f64>>;
type Own<'m, X> = Filter<'m, X, Multiples, f64, Vec<f64>>;

const SECOND: Fault = Fault::NotFinite { quantity: Quantity::Estimate, component: 1 };
const FIRST: Fault = Fault::NotFinite { quantity: Quantity::Estimate, component: 0 };

fn started<X: Over<Multiples>>(method: X, model: &Multiples, std: f64) -> Own<'_, X> {
    let (sizes, prior) = (method.sizes(model).unwrap(), Gaussian::from_std(&[0.0; 2], &[std; 2]).unwrap());
    let memory = vec![0.0; Own::<X>::memory_len(&method, sizes, true)];
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
    Filter::start_in(method, model, sizes, true, prior, memory).unwrap()
}

fn refused<X: Over<Multiples>>(method: X) {
    // the product of the rows of the root is beyond the largest number, or only the sum of the squares of the second
    let model = Multiples([1e153, 1e160]);
    let unit = Gaussian::from_std(&[0.0; 2], &[1.0; 2]).unwrap();
    let mut alone = method.start(&model, 0.0, &unit).unwrap();
    assert_eq!(alone.predict(1.0).unwrap_err().fault, SECOND);
    assert_eq!((alone.time(), alone.mean(), alone.factor()), (0.0, unit.mean(), unit.factor()));
    let mut followed = started(method, &model, 1.0);
    let mut history = Records::new(2, true, vec![0.0; Records::memory_len(2, 1)]);
    assert_eq!(history.predict(&mut followed, 1.0).unwrap_err().fault, SECOND);
    assert_eq!((followed.mean(), followed.factor()), (unit.mean(), unit.factor()));
}

#[test]
fn a_predicted_root_that_overflows_is_an_error_and_the_belief_as_before() {
    refused(SrEkf::default());
    refused(SrCkf::default());
    refused(SrQkf::default());
}

#[test]
fn a_smoothed_state_that_overflows_is_an_error() {
    // what is 1e308 now was ten times as much
    let model = Multiples([0.1, 0.0]);
    let mut filter = started(Ckf::default(), &model, 1.0);
    let mut history = Records::new(2, false, vec![0.0; Records::memory_len(2, 1)]);
    history.predict(&mut filter, 1.0).unwrap();
    let (mean, root, cov) = ([1e308, 0.0], [1e-2, 0.0, 0.0, 0.0], [1e-4, 0.0, 0.0, 0.0]);
    let begin = Prior { time: 1.0, mean: &mean, factor: &root, cov: &cov };
    let error = history.smooth_from::<Covariance, _>(begin, 0, 1, |_, _| {}).unwrap_err();
    assert_eq!(error.fault, FIRST);

    let mut filter = started(SrCkf::default(), &model, 10.0);
    let mut history = Records::new(2, true, vec![0.0; Records::memory_len(2, 1)]);
    history.predict(&mut filter, 1.0).unwrap();
    history.close(&mut filter).unwrap();
    let (mut mean, mut factor, mut cov) = ([0.0; 2], [0.0; 4], [0.0; 4]);
    let belief = Belief { mean: &mut mean, factor: &mut factor, cov: &mut cov, moved: &mut [] };
    let from = Smoothed { belief, shift: &mut [1e308, 0.0], root: &mut [1.0, 0.0, 0.0, 1.0] };
    assert_eq!(history.smooth_on(1.0, &from, |_, _| {}).unwrap_err().fault, FIRST);
}

#[test]
fn a_drawn_state_that_overflows_is_an_error() {
    let model = Multiples([0.1, 0.0]);
    let mut filter = started(SrCkf::default(), &model, 10.0);
    let mut history = Records::new(2, true, vec![0.0; Records::memory_len(2, 1)]);
    history.predict(&mut filter, 1.0).unwrap();
    let mut draw = [0.0; 2];
    let error = history.sample(&filter, 1, &mut draw, |_| 1e308, |_, _, _| {}).unwrap_err();
    assert_eq!(error.fault, FIRST);
}

#[test]
fn an_angle_of_more_periods_than_there_are_numbers_is_an_error() {
    let (model, prior) = (Multiples([1.0, 1.0]), Gaussian::from_std(&[1000.0, 0.0], &[0.0; 2]).unwrap());
    let mut rows = Data::new(1).starting_at(0.0);
    rows.push(1.0, &[0.0]).unwrap();
    let drawn = |period| {
        simulate(&model, &Angle(period), rows.rows(), 0.0, &prior, &mut Stream::new(1, 0, 0))
            .map_err(|error| error.fault)
    };
    assert!(drawn(TAU).is_ok_and(|drawn| drawn.z[0].abs() <= TAU / 2.0));
    assert_eq!(drawn(1e-310), Err(Fault::NotFinite { quantity: Quantity::Observation, component: 0 }));
}
