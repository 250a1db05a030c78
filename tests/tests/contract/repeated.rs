//! Two measures that say the same but for a little noise, of a state hardly known: the answer is Σ w z / Σ w, in closed form.

use givens::filter::{Block, Fault, Gaussian, Method, Over, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf, SrUkf};
use givens::model::{At, Noise, Observation, Transition};
use givens::scalar::Real;

/// A state that stays where it is, measured twice: x + v₁ and c x + v₂.
struct Twice {
    c: f64,
    s: f64,
}

impl Transition for Twice {
    fn states(&self) -> usize {
        1
    }
    fn transition<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = x[0];
    }
    fn noise(&self) -> Noise {
        Noise::Root(0)
    }
    fn process_noise<T: Real>(&self, _: &At<T>, _: &mut [T]) {}
}

impl Observation for Twice {
    fn states(&self) -> usize {
        1
    }
    fn measures(&self) -> usize {
        2
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out.copy_from_slice(&[x[0], T::of(self.c) * x[0]]);
    }
    fn noise(&self) -> Noise {
        Noise::Root(2)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&[self.s, 0.0, 0.0, self.s].map(T::of));
    }
}

/// The error of the mean in standard deviations and that of the standard deviation, relative, both in ε/s.
fn errors<X: Method + Over<Twice>>(method: X, model: &Twice) -> [f64; 2] {
    let prior = Gaussian::from_std(&[0.0], &[1.0]).unwrap();
    let mut filter = method.start(model, 0.0, prior).unwrap();
    let Twice { c, s } = *model;
    let (a, b) = (0.7, 0.7 * c + 0.85 * s);
    filter.update(model, &[a, b]).unwrap();
    let information = 1.0 + c * c + s * s;
    let (mean, std) = ((a + c * b) / information, s / information.sqrt());
    let of = |difference: f64| difference.abs() / std / (f64::EPSILON / s);
    [of(filter.mean()[0] - mean), of(filter.cov()[0].sqrt() - std)]
}

#[test]
fn every_square_root_method_loses_no_more_than_the_numbers_themselves() {
    for exponent in 2..=12 {
        let model = Twice { c: 0.81, s: 10f64.powi(-exponent) };
        macro_rules! hold {
            ($($method:ident)*) => {$(
                for update in [Block::Joint, Block::Separate] {
                    let [mean, std] = errors($method { update, ..$method::default() }, &model);
                    let what = format!("{} {update:?}, s = {:e}: {mean} {std}", stringify!($method), model.s);
                    assert!(mean < 4.0 && std < 4.0, "{what}");
                }
            )*};
        }
        #[allow(clippy::needless_update)] // of the methods without options
        {
            hold!(SrEkf SrUkf SrCdkf SrQkf SrCkf SrCkf5);
        }
    }
}

#[test]
fn the_covariance_form_loses_their_squares_or_says_so() {
    for exponent in 2..=12 {
        let model = Twice { c: 0.81, s: 10f64.powi(-exponent) };
        let prior = Gaussian::from_std(&[0.0], &[1.0]).unwrap();
        let mut filter = givens::filter::Ckf::default().start(&model, 0.0, prior).unwrap();
        match filter.update(&model, &[0.7, 0.7 * 0.81]) {
            Ok(()) => {
                let [mean, std] = errors(givens::filter::Ckf::default(), &model);
                assert!(mean.max(std) < 16.0 / model.s, "s = {:e}: {mean} {std}", model.s);
            }
            Err(error) => {
                assert!(
                    matches!(error.fault, Fault::NotPositive { .. } | Fault::SingularInnovation { .. }),
                    "{error}"
                );
                assert!(model.s < 1e-6, "s = {:e}", model.s);
            }
        }
    }
}
