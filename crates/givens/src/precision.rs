//! The numbers that a method computes with.

use crate::filter::Over;
use crate::scalar::Element;

/// A method whose numbers are `f32`, for whole runs: half the memory of filter and smoother, and twice as many tracks in a pack.
///
/// Estimates are given in `f64` all the same, and hold what the arithmetic of `f32` gave: about seven digits, of a mean as of
/// a standard deviation. Times and the differences between them are kept in `f64`; a model sees its step, and the time, as
/// `f32`. A standard deviation of less than eight to sixteen spacings of numbers at its mean (1e-6 of it) is an
/// error, as it is in `f64` (docs/algorithms.md R7).
///
/// ```
/// use givens::filter::{Gaussian, SrCkf};
/// use givens::model::zoo::{CoordinatedTurn, RangeBearing};
/// use givens::{Data, Single};
///
/// let mut data = Data::new(2).starting_at(0.0);
/// data.push(1.0, &[1640.0, 0.65])?;
/// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
/// let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
/// let double = givens::filter(&SrCkf::default(), &turn, &radar, &data, &prior)?;
/// let single = givens::filter(&Single(SrCkf::default()), &turn, &radar, &data, &prior)?;
/// let (x, y) = (double.mean(0)[0], single.mean(0)[0]);
/// assert!(x != y && (x - y).abs() < 1e-3 * double.std(0, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Single<X>(pub X);

/// What a run can be made with: every method for models of type `M`, in `f64`, and [`Single`] of it, in `f32`; with a
/// gate, [`Gated`](crate::Gated) of either.
pub trait Computes<M>: Copy {
    /// The method.
    type Method: Over<M>;
    /// Its numbers.
    type Number: Element;
    /// The method by itself.
    fn method(self) -> Self::Method;
    /// The probability beyond which a measurement is not taken in, if there is a gate; see [`Gated`](crate::Gated).
    fn gate(self) -> Option<f64> {
        None
    }
}

impl<M, X: Over<M>> Computes<M> for X {
    type Method = X;
    type Number = f64;
    fn method(self) -> X {
        self
    }
}

impl<M, X: Over<M>> Computes<M> for Single<X> {
    type Method = X;
    type Number = f32;
    fn method(self) -> X {
        self.0
    }
}
