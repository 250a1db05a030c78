//! A model of a fixed step is moved by whole numbers of it, or says that it cannot be.

use givens::filter::{Fault, Filter, Gaussian, Method, SrCkf};
use givens::model::{At, Noise, Transition};
use givens::scalar::Real;

/// Counts its steps, of a length of its own.
struct Steps(f64);

impl Transition for Steps {
    fn states(&self) -> usize {
        1
    }
    fn period(&self) -> Option<f64> {
        Some(self.0)
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        // the step that the model is given is its own
        out[0] = x[0] + at.dt / T::of(self.0);
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn process_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        out[0] = T::one();
    }
}

/// Number of steps from a time to another, by mean and variance.
fn counted(period: f64, from: f64, to: f64) -> Result<f64, Fault> {
    let (model, prior) = (Steps(period), Gaussian::from_std(&[0.0], &[1.0]).unwrap());
    let mut filter: Filter<_, _, _, _> = SrCkf::DEFAULT.start(&model, from, &prior).unwrap();
    filter.predict(to).map_err(|error| error.fault)?;
    assert!((filter.factor()[0].powi(2) - 1.0 - filter.mean()[0]).abs() < 1e-9);
    Ok(filter.mean()[0].round())
}

#[test]
fn a_gap_of_whole_steps_is_as_many_of_them() {
    for (period, from, to, steps) in [
        (0.5, 0.0, 0.0, 0.0),
        (0.5, 1.0, 1.5, 1.0),
        (0.1, 0.0, 0.7, 7.0),
        (0.1, 0.3, 2.3, 20.0),
        (3.0, -6.0, 6.0, 4.0),
        // within a millionth of a step, and of times that are late to a hundredth of one
        (0.5, 1.0, 1.500_000_4, 1.0),
        (0.01, 1_700_000_000.01, 1_700_000_000.07, 6.0),
    ] {
        assert_eq!(counted(period, from, to), Ok(steps), "{from} to {to} by {period}");
    }
}

#[test]
fn other_gaps_are_refused() {
    for (period, from, to) in [(0.5, 0.0, 1.25), (0.5, 1.0, 1.500_002), (0.1, 0.0, 0.05), (3.0, 0.0, 1.0)] {
        let gap = to - from;
        assert_eq!(counted(period, from, to), Err(Fault::NotWholeSteps { gap, period }));
    }
    // so late that the spacing of times is longer than half a step
    let late = counted(0.01, 1e15, 1e15 + 1.0);
    assert_eq!(late, Err(Fault::NotWholeSteps { gap: 1.0, period: 0.01 }));
    // more steps than anyone means
    let many = counted(1e-3, 0.0, 2e4);
    assert!(matches!(many, Err(Fault::Mismatch { why }) if why.contains("ten million")), "{many:?}");
}
