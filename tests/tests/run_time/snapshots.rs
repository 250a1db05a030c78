//! A filter that starts from a snapshot goes on with the same numbers to the bit, whatever its method and whenever it was
//! taken; a snapshot that is none is refused.

use givens::filter::predict::{Gauge, Root};
use givens::filter::{
    Carried, CdCkf2, Fault, Filter, Gaussian, Grow, Lskf, Method, Over, Prior, Quantity, Snapshot, SrUkf,
    StepError, Ukf,
};
use givens::model::{At, Noise, Observation, Transition};
use givens::registry::{AnyFilter, Choice, TimeName, resolve};
use givens::rule::Rule;
use givens::scalar::Real;
use givens_tests::cases;
use givens_tests::choices::{choices, continuous_choices};
use givens_tests::models::{Problem, Sensor};
use givens_tests::sde::{Continuous, Flow};
use proptest::prelude::*;

/// One step, and what may be seen after it.
fn take(f: &mut AnyFilter, step: &(f64, Option<Vec<f64>>)) -> (Result<(), StepError>, Vec<u64>) {
    let (t, z) = step;
    let done = match z {
        Some(z) => f.update(z),
        None => f.predict(*t),
    };
    let (nu, cov) = if z.is_some() { f.whole_innovation() } else { Default::default() };
    let seen = [f.mean(), f.factor(), &f.cov(), &nu, &cov, &[f.time()]].concat();
    (done, seen.iter().map(|x| x.to_bits()).collect())
}

/// A prediction to each time, and an update there.
fn steps(rows: impl Iterator<Item = (f64, Vec<f64>)>) -> Vec<(f64, Option<Vec<f64>>)> {
    rows.flat_map(|(t, z)| [(t, None), (t, Some(z))]).collect()
}

/// Cuts a run before every step, and goes on from there.
fn goes_on<'m>(
    name: &str,
    mut f: AnyFilter<'m>,
    steps: &[(f64, Option<Vec<f64>>)],
    resume: impl Fn(&Snapshot) -> Result<AnyFilter<'m>, StepError>,
) {
    let (mut snapshots, mut whole) = (Vec::new(), Vec::new());
    for step in steps {
        snapshots.push(f.snapshot());
        whole.push((take(&mut f, step), f.work()));
    }
    for (k, snapshot) in snapshots.iter().enumerate() {
        let mut f = resume(snapshot).unwrap_or_else(|error| panic!("{name}, before step {k}: {error}"));
        assert_eq!(&f.snapshot(), snapshot, "{name}, before step {k}");
        for (step, expected) in steps.iter().zip(&whole).skip(k) {
            assert_eq!((take(&mut f, step), f.work()), *expected, "{name}, from step {k}");
        }
    }
}

/// A method, and for level sets those with another root or gauge.
fn with_roots((name, choice): (String, Choice)) -> Vec<(String, Choice)> {
    let mut all = vec![(name.clone(), choice)];
    if choice.time_update == TimeName::LevelSet {
        all.push((format!("{name} root = moved"), Choice { root: Root::Moved, ..choice }));
        all.push((format!("{name} gauge = triangular"), Choice { gauge: Gauge::Triangular, ..choice }));
    }
    all
}

proptest! {
    #![proptest_config(cases(6))]

    #[test]
    fn every_discrete_method_goes_on(seed: u64, n in 1usize..=4, d in 1usize..=3, exact: bool) {
        let mut problem = Problem::random(seed, n, d, 5, 0.05);
        if exact {
            // a measure without noise, after which rounding is all that is left of a standard deviation
            problem.sensor.r.row_mut(0).fill(0.0);
            problem.sensor.r.column_mut(0).fill(0.0);
        }
        let steps = steps(problem.rows().map(|row| (row.time, row.z.to_vec())));
        for (name, choice) in choices(n) {
            let f = choice.start(&problem.model, &problem.sensor, 0.0, &problem.prior()).unwrap();
            goes_on(&name, f, &steps, |snapshot| choice.resume(&problem.model, &problem.sensor, snapshot));
        }
    }

    #[test]
    fn every_continuous_method_goes_on(seed: u64, n in 1usize..=3, q in 1usize..=2, d in 1usize..=2) {
        let problem = Continuous::random(seed, [n, q, d], 3, 0.2);
        let steps = steps(problem.rows().map(|row| (row.time, row.z.to_vec())));
        for (name, choice) in continuous_choices(n).into_iter().flat_map(with_roots) {
            let (model, sensor) = (&problem.model, &problem.sensor);
            let f = choice.start_continuous(model, sensor, 0.0, &problem.prior()).unwrap();
            goes_on(&name, f, &steps, |snapshot| choice.resume_continuous(model, sensor, snapshot));
        }
    }
}

/// A filter for smoothing, predicted and updated, and one that starts where it was: the rest of both.
fn typed<T: Real, M, X: Over<M>>(method: X, model: &M, sensor: &Sensor, prior: &Gaussian) {
    let sizes = method.sizes(model).unwrap();
    let sizes = sizes.with_sensor(sensor, method.rule().shape(sizes.states));
    let memory = || {
        let mut memory = Vec::<T>::new();
        memory.grow(Filter::<X, M, T, Vec<T>>::memory_len(&method, sizes, true));
        memory.fill(T::of(f64::NAN));
        memory
    };
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
    let mut whole = Filter::start_in(method, model, sizes, true, prior, memory()).unwrap();
    whole.predict(1.0).unwrap();
    let mut rest = Filter::resume_in(method, model, sizes, true, whole.carried(), memory()).unwrap();
    for filter in [&mut whole, &mut rest] {
        filter.update(sensor, &[0.3]).unwrap();
        filter.predict(2.0).unwrap();
    }
    let seen =
        |f: &Filter<X, M, T, Vec<T>>| format!("{:?} {:?} {:?}", f.snapshot(), f.backward(), f.innovation());
    assert_eq!(seen(&whole), seen(&rest));
}

#[test]
fn every_form_goes_on_for_a_smoother_and_in_single_precision() {
    let problem = Problem::random(5, 3, 1, 0, 0.1);
    let (model, sensor, prior) = (&problem.model, &problem.sensor, &problem.prior());
    typed::<f64, _, _>(Ukf::DEFAULT, model, sensor, prior);
    typed::<f32, _, _>(Ukf::DEFAULT, model, sensor, prior);
    typed::<f64, _, _>(SrUkf::DEFAULT, model, sensor, prior);
    typed::<f32, _, _>(SrUkf::DEFAULT, model, sensor, prior);
    let flow: &Flow = &Continuous::random(6, [3, 2, 1], 1, 0.1).model;
    typed::<f64, _, _>(CdCkf2::DEFAULT, flow, sensor, prior);
    typed::<f64, _, _>(Lskf { root: Root::Moved, ..Lskf::DEFAULT }, flow, sensor, prior);
    typed::<f32, _, _>(Lskf { root: Root::Moved, ..Lskf::DEFAULT }, flow, sensor, prior);
}

/// x' = p x + u, measured with the control added.
struct Driven;

impl Transition for Driven {
    fn states(&self) -> usize {
        1
    }
    fn controls(&self) -> usize {
        1
    }
    fn parameters(&self) -> &[f64] {
        &[0.9]
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = at.p[0] * x[0] + at.u[0];
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn process_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out[0] = T::of(0.1);
    }
}

impl Observation for Driven {
    fn states(&self) -> usize {
        1
    }
    fn measures(&self) -> usize {
        1
    }
    fn controls(&self) -> usize {
        1
    }
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = x[0] + at.u[0];
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out[0] = T::of(0.5);
    }
}

#[test]
fn controls_and_parameters_hold_on() {
    let (choice, prior) = (resolve("ckf", &[]).unwrap(), Gaussian::from_std(&[1.0], &[1.0]).unwrap());
    let mut f = choice.start(&Driven, &Driven, 0.0, &prior).unwrap();
    // not yet known, and so it stays
    let mut g = choice.resume(&Driven, &Driven, &f.snapshot()).unwrap();
    assert_eq!(g.predict(1.0).unwrap_err().fault, Fault::ControlsNotSet { controls: 1 });
    f.set_controls(&[0.25]).unwrap();
    f.set_parameters(&[0.5]).unwrap();
    let mut g = choice.resume(&Driven, &Driven, &f.snapshot()).unwrap();
    for filter in [&mut f, &mut g] {
        filter.predict(1.0).unwrap();
        assert_eq!(filter.mean(), [0.75]);
        filter.update(&[1.5]).unwrap();
    }
    assert_eq!(f.mean(), g.mean());
    assert_eq!(f.snapshot().controls, Some(vec![0.25]));
}

#[test]
fn a_snapshot_that_is_none_is_refused() {
    let problem = Problem::random(8, 2, 1, 1, 0.0);
    let of = |name: &str| {
        let choice = resolve(name, &[]).unwrap();
        let mut f = choice.start(&problem.model, &problem.sensor, 0.0, &problem.prior()).unwrap();
        f.predict(1.0).unwrap();
        (choice, f.snapshot())
    };
    let (choice, good) = of("ckf");
    let fault = |choice: &Choice, bad: Snapshot| {
        choice.resume(&problem.model, &problem.sensor, &bad).map(|_| ()).unwrap_err().fault
    };
    let length = |of, expected, found| Fault::Length { of, expected, found };
    let none = |quantity, component| Fault::NotFinite { quantity, component };
    let refused = |bad: Snapshot| fault(&choice, bad);
    assert_eq!(refused(Snapshot { mean: vec![0.0; 3], ..good.clone() }), length("mean", 2, 3));
    assert_eq!(refused(Snapshot { factor: vec![0.0; 3], ..good.clone() }), length("factor", 4, 3));
    assert_eq!(refused(Snapshot { cov: vec![], ..good.clone() }), length("covariance", 4, 0));
    assert_eq!(refused(Snapshot { floor: vec![], ..good.clone() }), length("floor", 2, 0));
    assert_eq!(refused(Snapshot { controls: Some(vec![1.0]), ..good.clone() }), length("controls", 0, 1));
    assert_eq!(refused(Snapshot { parameters: vec![1.0], ..good.clone() }), length("parameters", 0, 1));
    let moved = length("the root that a prediction left", 0, 4);
    assert_eq!(refused(Snapshot { moved: vec![0.0; 4], ..good.clone() }), moved);
    assert_eq!(refused(Snapshot { time: f64::NAN, ..good.clone() }), none(Quantity::Time, 0));
    let (nan, infinite) = (vec![0.0, f64::NAN], vec![1.0, 0.0, f64::INFINITY, 1.0]);
    assert_eq!(refused(Snapshot { mean: nan.clone(), ..good.clone() }), none(Quantity::Estimate, 1));
    assert_eq!(refused(Snapshot { floor: nan, ..good.clone() }), none(Quantity::Estimate, 1));
    assert_eq!(refused(Snapshot { factor: infinite.clone(), ..good.clone() }), none(Quantity::Estimate, 2));
    assert_eq!(refused(Snapshot { cov: infinite, ..good.clone() }), none(Quantity::Estimate, 2));
    for factor in [vec![1.0, 0.1, 0.0, 1.0], vec![1.0, 0.0, 0.5, -1.0]] {
        assert!(matches!(refused(Snapshot { factor, ..good.clone() }), Fault::Mismatch { .. }));
    }
    // a square root has no covariance of its own, which the other form needs
    let (square_root, of_root) = of("sr-ckf");
    assert_eq!(fault(&choice, of_root.clone()), length("covariance", 4, 0));
    assert!(square_root.resume(&problem.model, &problem.sensor, &good).is_ok());
    let flow = Continuous::random(1, [2, 1, 1], 1, 0.0).model;
    let error = square_root.resume_continuous(&flow, &problem.sensor, &of_root);
    assert_eq!(error.map(|_| ()).unwrap_err().time, 1.0);
}

#[test]
fn what_is_carried_is_what_is_known() {
    let problem = Problem::random(9, 2, 1, 1, 0.0);
    let f = Ukf::DEFAULT.start(&problem.model, 0.0, problem.prior()).unwrap();
    let Carried { mean, factor, cov, time, step, .. } = f.carried();
    assert_eq!((mean, factor, cov.to_vec()), (f.mean(), f.factor(), f.cov()));
    assert_eq!((time, step), (0.0, 0));
}
