//! A smoothed belief that is handed from one stretch of the way back to the next.

use crate::filter::Belief;
use crate::smoother::Smoothed;

/// A [`Smoothed`] belief in memory of its own.
#[derive(Clone, Debug)]
pub(crate) struct Crossing {
    mean: Vec<f64>,
    factor: Vec<f64>,
    cov: Vec<f64>,
    shift: Vec<f64>,
    root: Vec<f64>,
}

impl Crossing {
    pub fn of(smoothed: &Smoothed<f64>) -> Self {
        let Smoothed { belief, shift, root } = smoothed;
        Self {
            mean: belief.mean.to_vec(),
            factor: belief.factor.to_vec(),
            cov: belief.cov.to_vec(),
            shift: shift.to_vec(),
            root: root.to_vec(),
        }
    }

    pub fn lend(&mut self) -> Smoothed<'_, f64> {
        let Self { mean, factor, cov, shift, root } = self;
        Smoothed { belief: Belief { mean, factor, cov, moved: &mut [] }, shift, root }
    }
}
