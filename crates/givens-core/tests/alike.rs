//! Two measures of the same state: the more alike they are, the fewer digits are left to tell them apart by. A filter that
//! keeps a covariance says where these are not enough, in any units; one that keeps a root goes on.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may stop at what it did not expect")]

use givens_core::filter::{Ckf, Fault, Gaussian, Matrix, Over, SrCkf, SrUkf, Ukf};
use givens_core::model::{At, Noise, Observation, Transition};
use givens_core::scalar::Real;

/// A state that stands still.
struct Still;

impl Transition for Still {
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

/// z_i = unit_i (x + v_i), with the same noise in each.
struct Alike {
    units: [f64; 2],
    std: f64,
}

impl Observation for Alike {
    fn states(&self) -> usize {
        1
    }
    fn measures(&self) -> usize {
        2
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out.copy_from_slice(&self.units.map(|unit| T::of(unit) * x[0]));
    }
    fn noise(&self) -> Noise {
        Noise::Root(2)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        let [a, b] = self.units.map(|unit| T::of(unit * self.std));
        out.copy_from_slice(&[a, T::zero(), T::zero(), b]);
    }
}

const PRIOR: f64 = 0.8;

/// The variance after an update, or why there is none. The pivot of the second measure is 2 r of P_zz = p + r.
fn updated<X: Over<Still>>(method: X, units: [f64; 2], share: f64) -> Result<f64, Fault> {
    let p = PRIOR * PRIOR;
    let std = (0.5 * share * f64::EPSILON * p).sqrt();
    let prior = Gaussian::from_std(&[0.3], &[PRIOR]).unwrap();
    let mut f = method.start(&Still, 0.0, prior).unwrap();
    f.predict(1.0).map_err(|error| error.fault)?;
    f.update(&Alike { units, std }, &units.map(|unit| 0.3 * unit)).map_err(|error| error.fault)?;
    Ok(f.cov()[0] / (0.5 * std * std / (1.0 + 0.5 * std * std / p)))
}

const UNITS: [[f64; 2]; 5] = [[1.0, 1.0], [1e-9, 1e-9], [1e9, 1e9], [1e-6, 1e6], [1e6, 1e-6]];

/// 1024 ε is the least that a covariance form divides by; a pivot is zero by rounding (docs/algorithms.md K4) below 64 ε here.
#[test]
fn a_covariance_form_says_where_two_measures_are_too_much_alike_for_it() {
    let lost = Fault::NotPositive { matrix: Matrix::Innovation, pivot: 1 };
    for units in UNITS {
        for share in [150.0, 250.0, 500.0] {
            assert_eq!(updated(Ckf::default(), units, share), Err(lost), "{units:?} {share}");
            assert_eq!(updated(Ukf::default(), units, share), Err(lost), "{units:?} {share}");
        }
        for share in [4e3, 1e5, 1e8] {
            // what is left is known to ε/share of the prior's variance
            for left in [updated(Ckf::default(), units, share), updated(Ukf::default(), units, share)] {
                let left = left.unwrap_or_else(|fault| panic!("{units:?} {share}: {fault}"));
                assert!((left - 1.0).abs() < 100.0 / share + 1e-6, "{units:?} {share}: {left}");
            }
        }
    }
}

#[test]
fn a_root_goes_on() {
    for units in UNITS {
        for share in [60.0, 250.0, 4e3, 1e8] {
            for left in [updated(SrCkf::default(), units, share), updated(SrUkf::default(), units, share)] {
                let left = left.unwrap_or_else(|fault| panic!("{units:?} {share}: {fault}"));
                assert!((left - 1.0).abs() < 1e-6, "{units:?} {share}: {left}");
            }
        }
    }
}
