//! Many trajectories side by side, on all cores.

mod workers;

use crate::Data;
use crate::filter::{Gaussian, Over};
use crate::model::Observation;
use crate::run::{Goal, Outcome, run_until, stopped};
use core::num::NonZeroUsize;
use core::sync::atomic::AtomicBool;
use workers::each;

/// One trajectory of a batch: its measurements and its prior, over a model and sensors that may be its own.
#[derive(Debug)]
pub struct Track<'a, M, H> {
    /// How the state moves.
    pub model: &'a M,
    /// What is measured; several sensors are a tuple.
    pub sensors: &'a H,
    /// The measurements.
    pub data: &'a Data,
    /// The belief at [`Data::start`].
    pub prior: &'a Gaussian,
    /// Times at which the states are asked for besides, as in [`run_at`](crate::run_at).
    pub at: &'a [f64],
}

impl<'a, M, H> Track<'a, M, H> {
    /// A trajectory without further times.
    pub const fn new(model: &'a M, sensors: &'a H, data: &'a Data, prior: &'a Gaussian) -> Self {
        Self { model, sensors, data, prior, at: &[] }
    }
}

impl<M, H> Clone for Track<'_, M, H> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M, H> Copy for Track<'_, M, H> {}

/// How a batch is run.
///
/// Each track comes out as alone, to the bit, whatever the number of threads and whatever other tracks there are; one that
/// fails does not stop the others.
///
/// ```
/// use givens::Data;
/// use givens::batch::{Batch, Track};
/// use givens::filter::{Gaussian, SrCkf};
/// use givens::model::zoo::{CoordinatedTurn, RangeBearing};
///
/// let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
/// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
/// let mut tracks = vec![Data::new(2).starting_at(0.0); 3];
/// for (k, data) in tracks.iter_mut().enumerate() {
///     data.push(1.0, &[1640.0 + k as f64, 0.65])?;
/// }
/// let tracks: Vec<_> = tracks.iter().map(|data| Track::new(&turn, &radar, data, &prior)).collect();
/// let outcomes = Batch::default().run(SrCkf::default(), &tracks);
/// assert!(outcomes.iter().flatten().all(|outcome| outcome.estimates.len() == 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Batch<'a> {
    /// What the estimates are given.
    pub goal: Goal,
    /// How many threads; all cores where it is not said.
    pub threads: Option<NonZeroUsize>,
    /// Cancels the batch when it is set, before the next row of each track.
    pub cancel: Option<&'a AtomicBool>,
}

impl Batch<'_> {
    /// Runs a method over all tracks; a method of run time by [`Choice::run_batch`](crate::registry::Choice::run_batch). The
    /// outcomes stand in the order of the tracks; a track that was not done when the batch was cancelled has none.
    pub fn run<X, M, H>(&self, method: X, tracks: &[Track<M, H>]) -> Vec<Option<Outcome>>
    where
        X: Over<M> + Sync,
        M: Sync,
        H: Observation + Sync,
    {
        let one = |track: &Track<M, H>| {
            if stopped(self.cancel) {
                return None;
            }
            let Track { model, sensors, data, prior, at } = *track;
            let (rows, t0) = (data.rows(), data.start());
            run_until(method, model, sensors, rows, t0, prior, self.goal, at, self.cancel)
        };
        // the longest first: none of them is left to one thread at the end
        let mut order: Vec<usize> = (0..tracks.len()).collect();
        order.sort_by_key(|&k| core::cmp::Reverse(tracks[k].data.len()));
        each(&order, self.threads, |k| one(&tracks[k]))
    }
}
