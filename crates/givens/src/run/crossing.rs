//! A smoothed belief that is handed from one stretch of the way back to the next.

use crate::filter::Belief;
use crate::scalar::Real;
use crate::smoother::Smoothed;

/// A [`Smoothed`] belief in memory of its own: where a smoother stands on its way back.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Crossing<T> {
    mean: Vec<T>,
    factor: Vec<T>,
    cov: Vec<T>,
    shift: Vec<T>,
    root: Vec<T>,
}

impl<T: Real> Crossing<T> {
    pub fn of(smoothed: &Smoothed<T>) -> Self {
        let Smoothed { belief, shift, root } = smoothed;
        Self {
            mean: belief.mean.to_vec(),
            factor: belief.factor.to_vec(),
            cov: belief.cov.to_vec(),
            shift: shift.to_vec(),
            root: root.to_vec(),
        }
    }

    /// The same in numbers of another kind.
    pub fn of_kind<U: Real>(&self) -> Crossing<U> {
        let all = |of: &[T]| of.iter().map(|x| U::of(x.first())).collect();
        Crossing {
            mean: all(&self.mean),
            factor: all(&self.factor),
            cov: all(&self.cov),
            shift: all(&self.shift),
            root: all(&self.root),
        }
    }

    pub fn lend(&mut self) -> Smoothed<'_, T> {
        let Self { mean, factor, cov, shift, root } = self;
        Smoothed { belief: Belief { mean, factor, cov, moved: &mut [] }, shift, root }
    }
}
