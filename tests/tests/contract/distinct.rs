//! A standard deviation of a few spacings of numbers at the mean, or less, is an error, not a covariance that collapses.

use givens::filter::{
    Cdkf, Ckf, Ckf5, Ekf, Fault, Filter, Method, Prior, Qkf, Sizes, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf,
    SrUkf, StepError, Ukf,
};
use givens::model::{At, Noise, Observation, Transition};
use givens::scalar::Real;

/// A position and a velocity that goes on; the position is measured, with this standard deviation.
#[derive(Clone, Copy)]
struct Straight(f64);

impl Transition for Straight {
    fn states(&self) -> usize {
        2
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        out.copy_from_slice(&[at.dt.mul_add(x[1], x[0]), x[1]]);
    }
    fn noise(&self) -> Noise {
        Noise::Root(0)
    }
    fn process_noise<T: Real>(&self, _: &At<T>, _: &mut [T]) {}
}

impl Observation for Straight {
    fn states(&self) -> usize {
        2
    }
    fn measures(&self) -> usize {
        1
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = x[0];
    }
    fn noise(&self) -> Noise {
        Noise::Root(1)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out[0] = T::of(self.0);
    }
}

type Own<'m, X, T> = Filter<'m, X, Straight, T, Vec<T>>;

fn start<T: Real, X>(method: X, model: &Straight, mean: [f64; 2], std: [f64; 2]) -> Own<'_, X, T>
where
    X: givens::filter::Over<Straight>,
{
    let sizes = Sizes::new(2, 1);
    let factor = [std[0], 0.0, 0.0, std[1]];
    let cov = factor.map(|s| s * s);
    let prior = Prior { time: 0.0, mean: &mean, factor: &factor, cov: &cov };
    let memory = vec![T::zero(); Own::<X, T>::memory_len(&method, sizes, false)];
    Filter::start_in(method, model, sizes, false, prior, memory).unwrap()
}

macro_rules! every_type {
    ($check:ident) => {
        $check("ukf", Ukf::default());
        $check("cdkf", Cdkf::default());
        $check("qkf", Qkf::default());
        $check("ckf", Ckf::default());
        $check("ckf5", Ckf5::default());
        $check("sr-ukf", SrUkf::default());
        $check("sr-cdkf", SrCdkf::default());
        $check("sr-qkf", SrQkf::default());
        $check("sr-ckf", SrCkf::default());
        $check("sr-ckf5", SrCkf5::default());
    };
}

fn indistinct(result: Result<(), StepError>) -> Option<usize> {
    match result {
        Ok(()) => None,
        Err(StepError { fault: Fault::Indistinct { component }, .. }) => Some(component),
        Err(other) => panic!("{other}"),
    }
}

fn refuses<X: Method + givens::filter::Over<Straight>>(name: &str, method: X) {
    let model = Straight(1.0);
    // the spacing at 1e16 is 2, at 4e6 in single precision 0.25
    let far = || start::<f64, X>(method, &model, [1e16, 1.0], [0.1, 1.0]);
    assert_eq!(indistinct(far().predict(1.0)), Some(0), "{name}");
    assert_eq!(indistinct(far().update(&model, &[1e16])), Some(0), "{name}");
    let single = || start::<f32, X>(method, &model, [1.0, 4e6], [1.0, 0.05]);
    assert_eq!(indistinct(single().predict(1.0)), Some(1), "{name}");
    let mut refused = far();
    assert!(refused.predict(1.0).is_err());
    assert_eq!((refused.time(), refused.mean()), (0.0, &[1e16, 1.0][..]), "{name}: the belief is as before");
    // nothing to lose
    let mut known = start::<f64, X>(method, &model, [1e16, 1.0], [0.0, 10.0]);
    assert_eq!(indistinct(known.predict(1.0)), None, "{name}");
}

#[test]
fn points_that_coincide_with_the_mean_are_refused() {
    every_type!(refuses);
}

#[test]
fn a_rule_without_points_has_a_mean_that_is_rounded_too() {
    refuses("ekf", Ekf::default());
    refuses("sr-ekf", SrEkf::default());
}

#[test]
fn points_of_a_small_alpha_coincide_first() {
    let model = Straight(1.0);
    // before the points, the mean is lost: its rounding is weighted by 1/α²
    let filter = |alpha| start::<f64, _>(SrUkf { alpha, ..SrUkf::DEFAULT }, &model, [4e6, 1.0], [1e-2, 1.0]);
    assert_eq!(indistinct(filter(1e-3).predict(1.0)), None);
    assert_eq!(indistinct(filter(1e-8).predict(1.0)), Some(0));
}

/// A measurement without noise leaves a standard deviation of rounding, far below the spacing at the mean: zero, not a loss.
fn goes_on<X: Method + givens::filter::Over<Straight>>(name: &str, method: X) {
    let (model, exact) = (Straight(1.0), Straight(0.0));
    let mut filter = start::<f64, X>(method, &model, [1e6, 3.0], [1.0, 0.5]);
    for k in 1..=6 {
        let t = f64::from(k);
        assert_eq!(indistinct(filter.predict(t)), None, "{name}, row {k}");
        let sensor = if k % 2 == 0 { &model } else { &exact };
        if filter.cov()[0] > 1e-9 {
            assert_eq!(indistinct(filter.update(sensor, &[1e6 + 3.0 * t])), None, "{name}, row {k}");
            assert_eq!(indistinct(filter.update(&model, &[1e6 + 3.0 * t])), None, "{name}, row {k}");
        }
    }
}

#[test]
fn a_measurement_without_noise_is_no_loss() {
    every_type!(goes_on);
}

fn keeps<X: Method + givens::filter::Over<Straight>>(name: &str, method: X) {
    let model = Straight(1.0);
    // to 16 spacings refused, from 8 accepted, and the variance is the better the more there are
    let spacing = 4e6f64.next_up() - 4e6;
    for spacings in [0.01, 0.3, 0.5, 0.7, 1.0, 1.5, 2.3, 3.7, 7.3, 40.1, 1e3, 4e6] {
        let std = spacings * spacing;
        let mut filter = start::<f64, X>(method, &model, [4e6, 0.0], [std, 0.0]);
        let done = indistinct(filter.predict(1.0));
        let error = (filter.cov()[0] / (std * std) - 1.0).abs();
        assert!(done.is_some() || error <= 1.1 / spacings, "{name}, {spacings} spacings: {error}");
        assert!(done.is_none() || spacings <= 16.0, "{name}, {spacings} spacings: refused");
        assert!(done.is_some() || spacings >= 8.0, "{name}, {spacings} spacings: accepted");
    }
}

#[test]
fn what_is_accepted_keeps_its_variance() {
    every_type!(keeps);
}

/// A hundred measurements in single precision: refused, or the mean is that of doubles to a part of its standard deviation.
fn stays<X: Method + givens::filter::Over<Straight> + Copy>(name: &str, method: X) {
    let (mut worst, mut accepted) = (0.0f64, 0);
    for spacings in [0.7, 1.5, 3.1, 6.2, 9.0, 14.0, 22.0, 60.0, 500.0] {
        // the spacing at 4e6 in single precision is 0.25
        let std = 0.25 * spacings;
        let model = Straight(2.0 * std);
        let prior = ([4e6, 3.3 * std], [std, 0.1 * std]);
        let mut single = start::<f32, X>(method, &model, prior.0, prior.1);
        let mut double = start::<f64, X>(method, &model, prior.0, prior.1);
        for k in 1..=100 {
            let t = f64::from(k);
            let z = 4e6 + 3.3 * std * t + 2.0 * std * (t * t).sin();
            double.predict(t).unwrap();
            double.update(&model, &[z]).unwrap();
            if indistinct(single.predict(t)).or(indistinct(single.update(&model, &[z]))).is_some() {
                break;
            }
            let (mean, sd) = (double.mean()[0], double.cov()[0].sqrt());
            worst = worst.max((f64::from(single.mean()[0]) - mean).abs() / sd);
            accepted += 1;
        }
    }
    assert!(accepted > 100 && worst < 0.5, "{name}: {worst} σ in {accepted} rows");
}

#[test]
fn what_is_accepted_keeps_its_mean() {
    every_type!(stays);
    stays("ekf", Ekf::default());
    stays("sr-ekf", SrEkf::default());
}

/// A sensor far finer than the spacing of single precision at what it measures is refused; one without noise is not.
fn finer<X: Method + givens::filter::Over<Straight> + Copy>(name: &str, method: X) {
    for (std, refused) in [(1e-6, Some(0)), (1e-12, Some(0)), (0.0, None)] {
        let model = Straight(std);
        for mean in [0.0, 300.0, 1000.0] {
            let mut filter = start::<f32, X>(method, &model, [mean, 0.0], [1e3, 1.0]);
            assert_eq!(indistinct(filter.update(&model, &[345.584])), refused, "{name}: {std} at {mean}");
            assert_eq!(indistinct(filter.predict(1.0)).or(refused), refused, "{name}: {std} at {mean}");
        }
    }
}

#[test]
fn a_sensor_finer_than_numbers_is_refused() {
    finer("sr-ekf", SrEkf::default());
    finer("sr-ukf", SrUkf::default());
    finer("sr-cdkf", SrCdkf::default());
    finer("sr-qkf", SrQkf::default());
    finer("sr-ckf", SrCkf::default());
    finer("sr-ckf5", SrCkf5::default());
}

/// The height of the first state above 10⁶, to a few picometres: at that mean, doubles are a tenth of a nanometre apart.
struct Height;

impl Observation for Height {
    fn states(&self) -> usize {
        2
    }
    fn measures(&self) -> usize {
        1
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = x[0] - T::of(1e6);
    }
    fn noise(&self) -> Noise {
        Noise::Root(1)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out[0] = T::of(1e-12);
    }
}

fn as_before<X: Method + givens::filter::Over<Straight>>(name: &str, method: X) {
    let model = Straight(1.0);
    let mut filter = start::<f64, X>(method, &model, [1e6, 3.0], [1.0, 0.5]);
    filter.update(&model, &[1e6 + 0.3]).unwrap();
    let (mean, cov) = (filter.mean().to_vec(), filter.cov());
    assert_eq!(indistinct(filter.update(&Height, &[0.25])), Some(0), "{name}");
    assert_eq!((filter.mean(), filter.cov()), (&mean[..], cov), "{name}");
    assert!(filter.innovation().nu.is_empty() && filter.innovation().nis == 0.0, "{name}");
    // and it goes on as if the measurement had not been
    let mut other = start::<f64, X>(method, &model, [1e6, 3.0], [1.0, 0.5]);
    other.update(&model, &[1e6 + 0.3]).unwrap();
    for filter in [&mut filter, &mut other] {
        filter.predict(1.0).unwrap();
        filter.update(&model, &[1e6 + 3.1]).unwrap();
    }
    assert_eq!((filter.mean(), filter.cov()), (other.mean(), other.cov()), "{name}");
}

#[test]
fn a_mean_of_rounding_is_refused_and_the_belief_is_as_before() {
    every_type!(as_before);
}
