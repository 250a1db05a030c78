//! A model's own parameters are those that every method moves it by, and those that are set afterwards too.

use givens::filter::{CdCkf1, CdEkf, Filter, Gaussian, Lskf, Over, SrCdCkf, SrCdCkf2};
use givens::model::zoo::Components;
use givens::model::{At, Noise, Sde, Transition, Varies};
use givens::registry::AnyFilter;
use givens::scalar::Real;
use givens_tests::choices::{choices, continuous_choices};

/// x' = p x, or dx = −p x dt + p dβ, with p = 0.5 as a parameter, or written into the formulas.
#[derive(Clone, Copy)]
enum Half {
    Parameter,
    Written,
}

impl Half {
    fn p<T: Real>(self, at: &At<T>) -> T {
        match self {
            Self::Parameter => at.p[0],
            Self::Written => T::of(0.5),
        }
    }
    fn own(&self) -> &[f64] {
        match self {
            Self::Parameter => &[0.5],
            Self::Written => &[],
        }
    }
}

impl Transition for Half {
    fn states(&self) -> usize {
        2
    }
    fn parameters(&self) -> &[f64] {
        self.own()
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        out.copy_from_slice(&[self.p(at) * x[0], x[0] + self.p(at) * x[1]]);
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&[self.p(at), T::zero(), T::zero(), T::one()]);
    }
}

impl Sde for Half {
    fn states(&self) -> usize {
        2
    }
    fn noises(&self) -> usize {
        1
    }
    fn parameters(&self) -> &[f64] {
        self.own()
    }
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        dx.copy_from_slice(&[-self.p(at) * x[0], x[0] - self.p(at) * x[1]]);
    }
    fn diffusion<T: Real>(&self, at: &At<T>, _: &[T], g: &mut [T]) {
        g.copy_from_slice(&[self.p(at), T::one()]);
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

const SENSOR: Components<1> = Components { states: 2, which: [1], std: [0.5] };

/// The beliefs of two predictions and an update, and of one more prediction with the parameter set to 0.25.
fn steps(mut f: AnyFilter<'_>, set: bool) -> Vec<f64> {
    let mut all = Vec::new();
    for (time, z) in [(0.5, 1.5), (1.25, 0.7)] {
        f.predict(time).unwrap();
        all.extend([f.mean(), &f.cov()].concat());
        f.update(&[z]).unwrap();
        all.extend([f.mean(), &f.cov()].concat());
    }
    if set {
        f.set_parameters(&[0.25]).unwrap();
        f.predict(1.5).unwrap();
        all.extend(f.mean());
    }
    all
}

#[test]
fn a_parameter_is_the_number_that_it_stands_for() {
    let prior = Gaussian::from_std(&[2.0, 1.0], &[0.5, 0.7]).unwrap();
    for (name, choice) in choices(2) {
        let of = |model: &Half, set| steps(choice.start(model, &SENSOR, 0.0, &prior).unwrap(), set);
        let (own, written) = (of(&Half::Parameter, true), of(&Half::Written, false));
        assert_eq!(own[..written.len()], written, "{name}");
        let [.., before, _, _, _, _, _, after, _] = own[..] else { panic!("{name}: {own:?}") };
        assert!((after - 0.25 * before).abs() < 1e-14, "{name}: {before} {after}");
    }
    for (name, choice) in continuous_choices(2) {
        let of =
            |model: &Half, set| steps(choice.start_continuous(model, &SENSOR, 0.0, &prior).unwrap(), set);
        let (own, written) = (of(&Half::Parameter, true), of(&Half::Written, false));
        assert_eq!(own[..written.len()], written, "{name}");
        let [.., before, _, _, _, _, _, after, _] = own[..] else { panic!("{name}: {own:?}") };
        // e^(−p t) over a quarter; a step of Euler's is a first-order one
        let expected = f64::exp(-0.25 * 0.25) * before;
        assert!((after - expected).abs() < 3e-3 * expected.abs(), "{name}: {before} {after}");
    }
}

/// Mean and covariance of a filter of this type after a prediction.
fn predicted<X: Over<Half>>(method: X, model: &Half) -> Vec<f64> {
    let prior = Gaussian::from_std(&[2.0, 1.0], &[0.5, 0.7]).unwrap();
    let mut filter: Filter<_, _, _, _> = method.start(model, 0.0, &prior).unwrap();
    filter.predict(0.75).unwrap();
    [filter.mean(), &filter.cov()].concat()
}

#[test]
fn so_it_is_for_the_type_of_a_method() {
    macro_rules! types {
        ($($method:ident)*) => {$(
            let of = |model: Half| predicted($method::DEFAULT, &model);
            assert_eq!(of(Half::Parameter), of(Half::Written), "{}", stringify!($method));
        )*};
    }
    types!(CdEkf CdCkf1 SrCdCkf SrCdCkf2 Lskf);
}
