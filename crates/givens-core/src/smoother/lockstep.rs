//! The record of filters in lockstep.

use super::History;
use crate::filter::{Filter, Grow, Over};
use crate::scalar::{Mask, Pack};

impl<P: Pack, B: AsRef<[P]> + AsMut<[P]>> History<P, B> {
    /// Predicts each lane from its own time to its own later one, as
    /// [`Filter::predict_lanes`](crate::filter::Filter::predict_lanes) does, and records the update. The answer is the
    /// lanes that could not be moved; all of them if the filter does not go with this history.
    ///
    /// In square-root form each lane's way back is as of a history of its own. In covariance form a lane whose smoothed
    /// covariance does not exist is not told.
    #[inline(always)]
    pub fn predict_lanes<X: Over<M>, M, C: Grow<P>>(
        &mut self,
        filter: &mut Filter<'_, X, M, P, C>,
        from: &[f64],
        to: &[f64],
        spare: &mut [P],
    ) -> P::Mask {
        if self.capacity == 0 {
            return filter.predict_lanes(from, to, spare);
        }
        if self.open(filter).is_err() {
            return P::Mask::splat(true);
        }
        let sick = filter.predict_lanes(from, to, spare);
        self.seen = filter.moves();
        self.append(filter);
        sick
    }
}
