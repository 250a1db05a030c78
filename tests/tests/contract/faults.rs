//! A step that fails says why, and leaves the belief as it was.

use givens::filter::{Cdkf, Ckf, Ckf5, Ekf, Qkf, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf, SrUkf, Ukf};
use givens::filter::{
    Fault, Filter, Form, Gaussian, Matrix, Method, Over, Prior, Quantity, Sizes, StepError,
};
use givens::model::{At, Noise, Observation, Transition};
use givens::rule::Rule;
use givens::scalar::Real;
use givens::smoother::{FixedPoint, History};

/// Two states; what is wrong with the model or the sensor, if anything, is the number.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wrong {
    Nothing,
    /// The second component of the transition or of the measure is not a number.
    Value,
    /// It is infinite, to one side of the mean only.
    OneSide,
    /// The noise is not a number.
    Noise,
    /// The noise covariance has a negative eigenvalue.
    Indefinite,
    /// No noise, and the second measure repeats the first.
    Repeated,
}

struct Model(Wrong);

fn value<T: Real>(wrong: Wrong, x: T) -> T {
    match wrong {
        Wrong::Value => T::of(f64::NAN),
        Wrong::OneSide => T::select(T::of(0.5).lt(x), T::of(f64::INFINITY), x),
        _ => x,
    }
}

fn noise<T: Real>(wrong: Wrong, out: &mut [T]) {
    let cov = match wrong {
        Wrong::Noise => [1.0, 0.0, f64::NAN, 1.0],
        Wrong::Indefinite => [1.0, 2.0, 2.0, 1.0],
        Wrong::Repeated => [0.0; 4],
        _ => [1.0, 0.0, 0.0, 1.0],
    };
    out.copy_from_slice(&cov.map(T::of));
}

impl Transition for Model {
    fn states(&self) -> usize {
        2
    }
    fn transition<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out.copy_from_slice(&[x[0] + x[1], value(self.0, x[1])]);
    }
    fn noise(&self) -> Noise {
        if self.0 == Wrong::Noise { Noise::Root(2) } else { Noise::Covariance }
    }
    fn process_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        noise(self.0, out);
    }
}

impl Observation for Model {
    fn states(&self) -> usize {
        2
    }
    fn measures(&self) -> usize {
        2
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        let second = if self.0 == Wrong::Repeated { x[0] } else { value(self.0, x[1]) };
        out.copy_from_slice(&[x[0], second]);
    }
    fn noise(&self) -> Noise {
        if self.0 == Wrong::Noise { Noise::Root(2) } else { Noise::Covariance }
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        noise(self.0, out);
    }
}

fn start<X: Over<Model>>(method: X, model: &Model, smoothing: bool) -> Filter<'_, X, Model, f64, Vec<f64>> {
    let shape = method.rule().shape(2);
    let sizes = Sizes::of_model(model, shape).with_sensor(model, shape);
    let memory = vec![0.0; Filter::<X, Model, f64, Vec<f64>>::memory_len(&method, sizes, smoothing)];
    let prior = Gaussian::from_std(&[0.3, 0.1], &[1.0, 2.0]).unwrap();
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
    Filter::start_in(method, model, sizes, smoothing, prior, memory).unwrap()
}

/// The step must fail, and leave the belief.
fn fails<X: Over<Model>>(
    name: &str,
    filter: &mut Filter<'_, X, Model, f64, Vec<f64>>,
    step: impl FnOnce(&mut Filter<'_, X, Model, f64, Vec<f64>>) -> Result<(), StepError>,
) -> Fault {
    let known = |filter: &Filter<'_, X, Model, f64, Vec<f64>>| {
        (filter.time(), filter.mean().to_vec(), filter.factor().to_vec(), filter.cov())
    };
    let before = known(filter);
    let error = step(filter).expect_err(name);
    assert_eq!(known(filter), before, "{name}: {error}");
    assert!(!error.to_string().is_empty());
    error.fault
}

fn fails_well<X: Over<Model>>(name: &str, method: X) {
    let good = Model(Wrong::Nothing);
    let z = [0.5, 0.4];
    let expect = |fault: Fault, expected: Fault| assert_eq!(fault, expected, "{name}");
    let finite = |quantity, component| Fault::NotFinite { quantity, component };
    for smoothing in [false, true] {
        let predict = |wrong| fails(name, &mut start(method, &Model(wrong), smoothing), |f| f.predict(1.0));
        let update = |wrong| {
            let filter = &mut start(method, &good, smoothing);
            filter.predict(1.0).unwrap();
            fails(name, filter, |f| f.update(&Model(wrong), &z))
        };
        expect(predict(Wrong::Value), finite(Quantity::Transition, 1));
        expect(predict(Wrong::Noise), finite(Quantity::ProcessNoise, 1));
        expect(predict(Wrong::Indefinite), Fault::NotPositive { matrix: Matrix::ProcessNoise, pivot: 1 });
        expect(update(Wrong::Value), finite(Quantity::Observation, 1));
        expect(update(Wrong::Noise), finite(Quantity::MeasurementNoise, 1));
        expect(update(Wrong::Indefinite), Fault::NotPositive { matrix: Matrix::MeasurementNoise, pivot: 1 });
        expect(update(Wrong::Repeated), Fault::SingularInnovation { measure: 1 });
        if name != "ekf" && name != "sr-ekf" {
            expect(predict(Wrong::OneSide), finite(Quantity::Transition, 1));
            expect(update(Wrong::OneSide), finite(Quantity::Observation, 1));
        }
    }
    let filter = &mut start(method, &good, false);
    filter.predict(1.0).unwrap();
    expect(fails(name, filter, |f| f.predict(0.5)), Fault::Backwards { to: 0.5 });
    expect(fails(name, filter, |f| f.update(&good, &[0.5, f64::NAN])), finite(Quantity::Measurement, 1));
    let infinite = |f: &mut Filter<'_, X, Model, f64, Vec<f64>>| {
        f.update_present(&good, &[f64::INFINITY, 0.0], &[true, true])
    };
    expect(fails(name, filter, infinite), finite(Quantity::Measurement, 0));
    for (z, present) in [(&z[..1], &[true, true][..]), (&z[..], &[true][..])] {
        let fault = fails(name, filter, |f| f.update_present(&good, z, present));
        assert!(matches!(fault, Fault::Length { expected: 2, found: 1, .. }), "{name}: {fault}");
    }
    let fault = fails(name, filter, |f| f.set_controls(&[1.0]));
    assert!(matches!(fault, Fault::Length { expected: 0, found: 1, .. }), "{name}: {fault}");
    // after all that, it goes on as if nothing had happened
    let fresh = &mut start(method, &good, false);
    fresh.predict(1.0).unwrap();
    for f in [&mut *filter, fresh] {
        f.update(&good, &z).unwrap();
    }
    assert_eq!((filter.mean(), filter.cov()), (fresh.mean(), fresh.cov()), "{name}");
}

#[test]
fn a_failing_step_names_its_fault_and_changes_nothing() {
    fails_well("ekf", Ekf::default());
    fails_well("ukf", Ukf::default());
    fails_well("cdkf", Cdkf::default());
    fails_well("qkf", Qkf::default());
    fails_well("ckf", Ckf::default());
    fails_well("ckf5", Ckf5::default());
    fails_well("sr-ekf", SrEkf::default());
    fails_well("sr-cdkf", SrCdkf::default());
    fails_well("sr-ckf5", SrCkf5::default());
    for update in [givens::filter::Block::Joint, givens::filter::Block::Separate] {
        fails_well("sr-ukf", SrUkf { update, ..Default::default() });
        fails_well("sr-qkf", SrQkf { update, ..Default::default() });
        fails_well("sr-ckf", SrCkf { update });
    }
}

#[test]
fn what_cannot_start_says_so() {
    let model = Model(Wrong::Nothing);
    let prior = Gaussian::from_std(&[0.3, 0.1], &[1.0, 2.0]).unwrap();
    let option = |fault: Fault| match fault {
        Fault::Option(error) => error.option,
        other => panic!("{other}"),
    };
    let refused = |error: Result<(), StepError>| option(error.unwrap_err().fault);
    let ukf = |alpha, beta, kappa| Ukf { alpha, beta, kappa }.start(&model, 0.0, &prior).map(|_| ());
    assert_eq!(refused(ukf(0.0, 0.0, None)), "alpha");
    assert_eq!(refused(ukf(1.0, f64::NAN, None)), "beta");
    assert_eq!(refused(ukf(1.0, 0.0, Some(-2.0))), "kappa");
    assert_eq!(refused(Cdkf { eta: 0.9 }.start(&model, 0.0, &prior).map(|_| ())), "eta");
    assert_eq!(refused(Qkf { points: 1 }.start(&model, 0.0, &prior).map(|_| ())), "points");
    let longer = Gaussian::from_std(&[0.3, 0.1, 0.0], &[1.0, 2.0, 1.0]).unwrap();
    let fault = Ckf::default().start(&model, 0.0, &longer).map(|_| ()).unwrap_err().fault;
    assert!(matches!(fault, Fault::Length { expected: 2, found: 3, .. }), "{fault}");
}

#[test]
fn a_smoother_refuses_what_does_not_fit_it() {
    let model = Model(Wrong::Nothing);
    let length = |fault: Fault| assert!(matches!(fault, Fault::Length { .. }), "{fault}");
    type Records = History<f64, Vec<f64>>;
    let memory = |n| vec![0.0; Records::memory_len(n, 3)];
    let (mut filter, mut without) =
        (start(SrCkf::default(), &model, true), start(SrCkf::default(), &model, false));
    // of the other form, of another length, not started for smoothing, or without memory for the way back
    let form = |fault: Fault| assert!(matches!(fault, Fault::Mismatch { .. }), "{fault}");
    let mut history = History::new(2, false, memory(2));
    form(history.predict(&mut filter, 1.0).unwrap_err().fault);
    form(history.smooth(&filter, 1, |_, _| {}).unwrap_err().fault);
    let mut history = History::new(3, true, memory(3));
    length(history.predict(&mut filter, 1.0).unwrap_err().fault);
    length(history.smooth(&filter, 1, |_, _| {}).unwrap_err().fault);
    let mut history = History::new(2, true, memory(2));
    length(history.predict(&mut without, 1.0).unwrap_err().fault);
    length(history.smooth_means(&without, 1, |_, _| {}).unwrap_err().fault);
    assert_eq!((filter.time(), without.time(), history.len()), (0.0, 0.0, 0));
    length(History::new(2, true, vec![0.0; 5]).smooth(&filter, 1, |_, _| {}).unwrap_err().fault);
    let len = FixedPoint::<f64, Vec<f64>>::memory_len(2);
    length(FixedPoint::begin(&mut filter, vec![0.0; len - 1]).unwrap_err().fault);
    length(FixedPoint::begin(&mut without, vec![0.0; len]).unwrap_err().fault);
    let mut point = FixedPoint::begin(&mut filter, vec![0.0; len]).unwrap();
    length(point.predict(&mut without, 1.0).unwrap_err().fault);
    let mut other = start(Ckf::default(), &model, true);
    form(point.predict(&mut other, 1.0).unwrap_err().fault);
    form(point.update(&other).unwrap_err().fault);
}

/// A smoother that has missed something of its filter says so, and one that has not goes on.
fn misses_nothing<X: Over<Model>>(method: X) {
    let model = Model(Wrong::Nothing);
    let square_root = X::Form::SQUARE_ROOT;
    let missed = |fault: Fault| assert!(matches!(fault, Fault::Mismatch { .. }), "{fault}");
    let history = || History::new(2, square_root, vec![0.0; History::<f64, Vec<f64>>::memory_len(2, 5)]);
    let point =
        |filter: &mut _| FixedPoint::begin(filter, vec![0.0; FixedPoint::<f64, Vec<f64>>::memory_len(2)]);

    let (mut filter, mut follower) = (start(method, &model, true), history());
    follower.predict(&mut filter, 1.0).unwrap();
    filter.update(&model, &[0.4, 0.1]).unwrap();
    assert!(follower.predict(&mut filter, 0.5).is_err(), "the past");
    follower.predict(&mut filter, 2.0).unwrap();
    filter.predict(3.0).unwrap();
    missed(follower.predict(&mut filter, 4.0).unwrap_err().fault);
    missed(follower.smooth(&filter, 2, |_, _| {}).unwrap_err().fault);
    missed(follower.smooth_means(&filter, 2, |_, _| {}).unwrap_err().fault);

    let (mut filter, mut follower) = (start(method, &model, true), history());
    follower.predict(&mut filter, 1.0).unwrap();
    let mut other = point(&mut filter).unwrap();
    missed(follower.predict(&mut filter, 2.0).unwrap_err().fault);
    other.predict(&mut filter, 2.0).unwrap();
    filter.predict(3.0).unwrap();
    missed(other.predict(&mut filter, 4.0).unwrap_err().fault);
    missed(other.update(&filter).unwrap_err().fault);

    // an update that was not asked for is not lost
    let (mut asked, mut silent) = (start(method, &model, true), start(method, &model, true));
    let mut points = [point(&mut asked).unwrap(), point(&mut silent).unwrap()];
    for t in [1.0, 2.0, 3.0] {
        points[0].predict(&mut asked, t).unwrap();
        points[1].predict(&mut silent, t).unwrap();
        asked.update(&model, &[0.4, 0.1]).unwrap();
        silent.update(&model, &[0.4, 0.1]).unwrap();
        points[0].update(&asked).unwrap();
    }
    points[1].update(&silent).unwrap();
    assert_eq!((points[0].mean(), points[0].cov()), (points[1].mean(), points[1].cov()));
}

#[test]
fn a_smoother_that_has_missed_a_step_says_so() {
    misses_nothing(Ckf::default());
    misses_nothing(SrCkf::default());
}
