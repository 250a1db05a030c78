//! What a filter carries from step to step, as plain data: a filter that starts from it goes on with the same numbers.

use super::error::{Fault, StepError};
use super::form::Form;
use super::methods::{Method, Over};
use super::quantity::Quantity;
use super::sizes::Sizes;
use super::stepper::Filter;
use crate::ode::Work;
use crate::scalar::{Mask, Real};

/// All that a filter carries from step to step, in borrowed slices, whatever its method.
///
/// What only a smoother reads is not in it: one that follows the resumed filter begins there.
#[derive(Clone, Copy, Debug)]
pub struct Carried<'a, T> {
    /// The time at which the belief holds.
    pub time: f64,
    /// Predictions and updates so far.
    pub step: usize,
    /// The mean, length n.
    pub mean: &'a [T],
    /// The lower-triangular root of the covariance, n × n, diagonal ≥ 0.
    pub factor: &'a [T],
    /// The covariance itself, n × n, in covariance form; in square-root form it is empty and not read.
    pub cov: &'a [T],
    /// The root, n × n, that the last prediction left for the update to draw its points from; empty if there is none.
    pub moved: &'a [T],
    /// What of each standard deviation may be rounding that an update without noise has left, length n.
    pub floor: &'a [T],
    /// The controls, if they are known.
    pub controls: Option<&'a [T]>,
    /// The parameters.
    pub parameters: &'a [T],
    /// What the solvers have done so far.
    pub work: Work,
}

impl<'m, X: Over<M>, M, T: Real, B: AsMut<[T]>> Filter<'m, X, M, T, B> {
    /// Starts a filter, in the caller's memory of at least [`memory_len`](Self::memory_len) scalars, where another one of
    /// the same method was: it goes on with the same numbers to the bit, if `smoothing` is the same too.
    ///
    /// # Errors
    /// An option out of its range, a slice of the wrong length, a number that is not finite, a factor that is not lower
    /// triangular with a non-negative diagonal.
    pub fn resume_in(
        method: X,
        model: &'m M,
        sizes: Sizes,
        smoothing: bool,
        from: Carried<T>,
        memory: B,
    ) -> Result<Self, StepError> {
        let Carried { time, step, mean, factor, cov, moved, floor, controls, parameters, work } = from;
        let fail = |fault| StepError { fault, time, step };
        let lengths = [mean.len(), factor.len(), cov.len()];
        let mut filter = Self::laid_out(method, model, sizes, smoothing, time, lengths, memory)?;
        if !triangular(sizes.states, factor) {
            let why = "the factor of a belief is lower triangular with a non-negative diagonal";
            return Err(fail(Fault::Mismatch { why }));
        }
        let is_controlled = filter.controlled || controls.is_some();
        let parts = filter.parts();
        let (belief, estimate) = (parts.belief, Quantity::Estimate);
        let moved_to = if moved.is_empty() { &mut [][..] } else { belief.moved };
        let (controls_to, controls) = controls.map_or((&mut [][..], &[][..]), |u| (&mut *parts.u, u));
        let known = if X::Form::SQUARE_ROOT { &[][..] } else { cov };
        for (to, from, of, quantity) in [
            (belief.mean, mean, "mean", estimate),
            (belief.factor, factor, "factor", estimate),
            (belief.cov, known, "covariance", estimate),
            (moved_to, moved, "the root that a prediction left", estimate),
            (parts.floor, floor, "floor", estimate),
            (controls_to, controls, "controls", Quantity::Control),
            (parts.p, parameters, "parameters", Quantity::Parameter),
        ] {
            put(to, from, of, quantity).map_err(fail)?;
        }
        filter.controlled = is_controlled;
        (filter.step, filter.work, filter.moved) = (step, work, !moved.is_empty());
        filter.probed()
    }
}

impl<X: Method, M, T: Real, B: AsRef<[T]>> Filter<'_, X, M, T, B> {
    /// What the filter carries to its next step, for [`resume_in`](Filter::resume_in).
    pub fn carried(&self) -> Carried<'_, T> {
        let Sizes { states: n, controls, parameters, .. } = self.layout.sizes;
        let (moved, rest) = self.memory.as_ref().split_at(self.layout.moved_len());
        let skip = self.layout.kept + self.layout.shape.table;
        let (u, rest) = rest[skip..].split_at(controls);
        let (p, rest) = rest.split_at(parameters);
        Carried {
            time: self.time,
            step: self.step,
            mean: self.mean(),
            factor: self.factor(),
            cov: self.own_cov(),
            moved: if self.moved { moved } else { &[] },
            floor: &rest[..n],
            controls: self.controlled.then_some(u),
            parameters: p,
            work: self.work,
        }
    }
}

fn triangular<T: Real>(n: usize, factor: &[T]) -> bool {
    let zero = T::zero();
    (0..n).all(|i| {
        let (own, above) = factor[i * n + i..(i + 1) * n].split_at(1);
        !own[0].lt(zero).all() && above.iter().all(|x| x.same(zero).any())
    })
}

fn put<T: Real>(to: &mut [T], from: &[T], of: &'static str, quantity: Quantity) -> Result<(), Fault> {
    if to.len() != from.len() {
        return Err(Fault::Length { of, expected: to.len(), found: from.len() });
    }
    if let Some(component) = from.iter().position(|x| (!x.finite()).all()) {
        return Err(Fault::NotFinite { quantity, component });
    }
    to.copy_from_slice(from);
    Ok(())
}

#[cfg(feature = "alloc")]
pub use owned::Snapshot;

#[cfg(feature = "alloc")]
mod owned {
    use super::Carried;
    use crate::filter::Filter;
    use crate::filter::methods::Method;
    use crate::ode::Work;
    use crate::scalar::Real;
    use alloc::vec::Vec;

    /// All that a filter carries from step to step, in memory of its own: plain data, to be kept, sent and started from.
    ///
    /// ```
    /// use givens_core::filter::{Gaussian, Method, SrCkf};
    /// use givens_core::model::zoo::{CoordinatedTurn, RangeBearing};
    ///
    /// let (model, radar) = (CoordinatedTurn::default(), RangeBearing::published());
    /// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
    /// let mut f = SrCkf::default().start(&model, 0.0, prior)?;
    /// f.predict(1.0)?;
    /// f.update(&radar, &[1640.0, 0.65])?;
    /// let snapshot = f.snapshot();
    /// let mut g = SrCkf::default().resume(&model, &snapshot)?;
    /// for filter in [&mut f, &mut g] {
    ///     filter.predict(2.0)?;
    ///     filter.update(&radar, &[1890.0, 0.56])?;
    /// }
    /// assert_eq!((f.mean(), f.factor()), (g.mean(), g.factor()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[derive(Clone, Debug, PartialEq)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    pub struct Snapshot<T = f64> {
        /// The time at which the belief holds.
        pub time: f64,
        /// Predictions and updates so far.
        pub step: usize,
        /// The mean, length n.
        pub mean: Vec<T>,
        /// The lower-triangular root of the covariance, n × n, diagonal ≥ 0.
        pub factor: Vec<T>,
        /// The covariance itself, n × n, in covariance form; in square-root form it is empty and not read.
        pub cov: Vec<T>,
        /// The root, n × n, that the last prediction left for the update to draw its points from; empty if there is
        /// none.
        pub moved: Vec<T>,
        /// What of each standard deviation may be rounding that an update without noise has left, length n.
        pub floor: Vec<T>,
        /// The controls, if they are known.
        pub controls: Option<Vec<T>>,
        /// The parameters.
        pub parameters: Vec<T>,
        /// What the solvers have done so far.
        pub work: Work,
    }

    impl<T> Snapshot<T> {
        /// The same in borrowed slices, for [`Filter::resume_in`].
        pub fn carried(&self) -> Carried<'_, T> {
            Carried {
                time: self.time,
                step: self.step,
                mean: &self.mean,
                factor: &self.factor,
                cov: &self.cov,
                moved: &self.moved,
                floor: &self.floor,
                controls: self.controls.as_deref(),
                parameters: &self.parameters,
                work: self.work,
            }
        }
    }

    impl<T: Clone> From<Carried<'_, T>> for Snapshot<T> {
        fn from(carried: Carried<T>) -> Self {
            Self {
                time: carried.time,
                step: carried.step,
                mean: carried.mean.to_vec(),
                factor: carried.factor.to_vec(),
                cov: carried.cov.to_vec(),
                moved: carried.moved.to_vec(),
                floor: carried.floor.to_vec(),
                controls: carried.controls.map(<[T]>::to_vec),
                parameters: carried.parameters.to_vec(),
                work: carried.work,
            }
        }
    }

    impl<X: Method, M, T: Real, B: AsRef<[T]>> Filter<'_, X, M, T, B> {
        /// What the filter carries to its next step, as data of its own: [`resume`](Method::resume) starts from it.
        pub fn snapshot(&self) -> Snapshot<T> {
            self.carried().into()
        }
    }
}
