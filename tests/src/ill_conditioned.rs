//! The update of `golden/ill_conditioned.json`: P = I, H = [1 1 1; 1 1 1+δ], R = δ² I, in `f64` and in `f32`.

use crate::{golden, lower, numbers};
use givens::filter::{
    Block, Cdkf, Ckf, Ckf5, Ekf, Filter, Over, Prior, Qkf, Sizes, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf, SrUkf,
    StepError, Ukf,
};
use givens::model::{At, Noise, Observation, Transition};
use givens::rule::Rule;
use givens::scalar::Real;

/// A state that stays where it is.
pub struct Still;

impl Transition for Still {
    fn states(&self) -> usize {
        3
    }
    fn transition<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out.copy_from_slice(x);
    }
    fn noise(&self) -> Noise {
        Noise::Root(0)
    }
    fn process_noise<T: Real>(&self, _: &At<T>, _: &mut [T]) {}
}

/// Two sums of the state that are nearly the same.
pub struct Sums {
    /// H₂₃, 1 + δ as the scalar rounds it.
    pub corner: f64,
    /// Standard deviation of both.
    pub delta: f64,
}

impl Observation for Sums {
    fn states(&self) -> usize {
        3
    }
    fn measures(&self) -> usize {
        2
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = x[0] + x[1] + x[2];
        out[1] = T::of(self.corner).mul_add(x[2], x[0] + x[1]);
    }
    fn noise(&self) -> Noise {
        Noise::Root(2)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&[self.delta, 0.0, 0.0, self.delta].map(T::of));
    }
}

/// One δ and what exact arithmetic makes of it.
pub struct Case {
    /// The sensor.
    pub sensor: Sums,
    /// The exact posterior covariance.
    pub cov: Vec<f64>,
}

/// The cases of a scalar, `f64` or `f32`, from δ = 10⁻³ on.
#[must_use]
pub fn cases(scalar: &str) -> Vec<Case> {
    let cases = &golden("ill_conditioned.json")[scalar];
    let of = |case: &serde_json::Value| Case {
        sensor: Sums { corner: case["corner"].as_f64().unwrap(), delta: case["delta"].as_f64().unwrap() },
        cov: lower(&numbers(&case["cov"])),
    };
    cases.as_array().unwrap().iter().map(of).collect()
}

/// ‖P − P_exact‖ / ‖P_exact‖, Frobenius, of one method.
///
/// # Errors
/// The update's own.
pub fn error<T: Real, X: Over<Still>>(method: X, case: &Case) -> Result<f64, StepError> {
    let shape = method.rule().shape(3);
    let sizes = Sizes::of_model(&Still, shape).with_sensor(&case.sensor, shape);
    let mut eye = [0.0; 9];
    (0..3).for_each(|i| eye[4 * i] = 1.0);
    let memory = vec![T::zero(); Filter::<X, Still, T, Vec<T>>::memory_len(&method, sizes, false)];
    let prior = Prior { time: 0.0, mean: &[0.0; 3], factor: &eye, cov: &eye };
    let mut filter = Filter::start_in(method, &Still, sizes, false, prior, memory)?;
    filter.update(&case.sensor, &[1.1, 1.3])?;
    let norm = |of: &mut dyn Iterator<Item = f64>| of.map(|x| x * x).sum::<f64>().sqrt();
    let cov = filter.cov();
    let mut difference = cov.iter().zip(&case.cov).map(|(x, y)| x.first() - y);
    Ok(norm(&mut difference) / norm(&mut case.cov.iter().copied()))
}

/// A method by name, its form, and its error on a case.
pub type Tried<T> = (String, bool, Box<dyn Fn(&Case) -> Result<f64, StepError>>, std::marker::PhantomData<T>);

/// Every rule in covariance form, then in square-root form with both updates.
#[must_use]
#[allow(clippy::needless_update)] // of the methods without options
pub fn methods<T: Real>() -> Vec<Tried<T>> {
    let mut all: Vec<Tried<T>> = Vec::new();
    macro_rules! try_all {
        ($($name:literal $cov:ident $sr:ident { $($option:ident: $value:expr),* };)*) => {$(
            let covariance = $cov { $($option: $value,)* ..Default::default() };
            all.push(($name.into(), false, Box::new(move |case| error::<T, _>(covariance, case)), Default::default()));
            for (block, update) in [("joint", Block::Joint), ("separate", Block::Separate)] {
                let root = $sr { $($option: $value,)* update, ..Default::default() };
                let name = format!("sr-{}, {block}", $name);
                all.push((name, true, Box::new(move |case| error::<T, _>(root, case)), Default::default()));
            }
        )*};
    }
    try_all! {
        "ekf" Ekf SrEkf {};
        "ckf" Ckf SrCkf {};
        "ckf5" Ckf5 SrCkf5 {};
        "ukf" Ukf SrUkf {};
        "ukf α=.5 β=2" Ukf SrUkf { alpha: 0.5, beta: 2.0, kappa: Some(0.0) };
        "cdkf" Cdkf SrCdkf {};
        "qkf" Qkf SrQkf {};
    }
    all.sort_by_key(|tried| tried.1);
    all
}
