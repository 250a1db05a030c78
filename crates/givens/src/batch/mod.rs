//! Many trajectories side by side: in packs of as many as a register holds, on all cores.

mod lockstep;
mod pack;
mod record;
mod workers;

use crate::filter::{Fault, Gaussian, StepError};
use crate::model::Observation;
use crate::run::{Goal, Outcome, Watch, run_until};
use crate::{Computes, Data, gate};
use core::num::NonZeroUsize;
use core::sync::atomic::{AtomicBool, AtomicUsize};
use lockstep::Lockstep;
use pack::{packable, units};
pub(crate) use workers::each;

pub use crate::scalar::InstructionSet;

/// One trajectory of a batch or of a stream: its measurements and its prior, over a model and sensors that may be its own.
#[derive(Debug)]
pub struct Track<'a, M, H, D: ?Sized = Data> {
    /// How the state moves.
    pub model: &'a M,
    /// What is measured; several sensors are a tuple.
    pub sensors: &'a H,
    /// The measurements; for a stream any [`Source`](crate::Source) of them.
    pub data: &'a D,
    /// The belief at [`Data::start`].
    pub prior: &'a Gaussian,
    /// Parameters of its own, in place of the model's, which are as many; empty: the model's.
    pub parameters: &'a [f64],
    /// Times at which the states are asked for besides, as in [`run_at`](crate::run_at).
    pub at: &'a [f64],
}

impl<'a, M, H, D: ?Sized> Track<'a, M, H, D> {
    /// A trajectory with the model's own parameters and without further times.
    pub const fn new(model: &'a M, sensors: &'a H, data: &'a D, prior: &'a Gaussian) -> Self {
        Self { model, sensors, data, prior, parameters: &[], at: &[] }
    }
}

impl<M, H, D: ?Sized> Clone for Track<'_, M, H, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M, H, D: ?Sized> Copy for Track<'_, M, H, D> {}

/// How a batch is run.
///
/// Each track comes out as by [`run`](crate::run()), but for rounding, and the same to the bit whatever other tracks are in the
/// batch, in whatever order, on however many threads; one that fails does not stop the others, and has the failure that it would
/// have had alone.
///
/// Tracks over one and the same model and sensors go in packs of as many as a vector register holds, each at its own times
/// and with its own missing components; their functions want `#[inline(always)]`, without which a pack's instructions are
/// calls. A track goes alone where a pack cannot serve it: solvers that choose their steps, fixed lag and fixed point, times
/// asked for besides, smoothing in covariance form or by a solver; more than 2²⁰/n² rows; and wherever the machine has no vectors.
/// A pack with one track takes as long as a full one: up to three times as long as that track alone.
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
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// What the estimates are given.
    pub goal: Goal,
    /// How many threads; all cores where it is not said.
    pub threads: Option<NonZeroUsize>,
    /// The vectors of the packs. [`InstructionSet::Portable`], or one that the machine lacks: every track goes alone, and
    /// comes out as from [`run`](crate::run()) to the bit.
    pub vectors: InstructionSet,
    /// Cancels the batch when it is set, before the next row of each track.
    pub cancel: Option<&'a AtomicBool>,
    /// Counts the rows of all tracks as they are taken in, to show how far the batch is.
    pub rows: Option<&'a AtomicUsize>,
}

impl Default for Batch<'_> {
    /// Filtering, on all cores, with the widest vectors of the machine.
    fn default() -> Self {
        Self { goal: Goal::Filter, threads: None, vectors: InstructionSet::best(), cancel: None, rows: None }
    }
}

impl Batch<'_> {
    /// Runs a method over all tracks; a method of run time by [`Choice::run_batch`](crate::registry::Choice::run_batch). The
    /// outcomes stand in the order of the tracks; a track that was not done when the batch was cancelled has none.
    pub fn run<X, M, H>(&self, method: X, tracks: &[Track<M, H>]) -> Vec<Option<Outcome>>
    where
        X: Computes<M, Method: Sync> + Sync,
        M: Sync,
        H: Observation + Sync,
    {
        match gate::limits(method.gate(), widest(tracks)) {
            Ok(limits) => {
                self.run_with(method, tracks, &limits, |batch, track| batch.alone(method, track, &limits))
            }
            Err(fault) => refused(fault, tracks, self.goal),
        }
    }

    /// The same with the limits of the gate; `alone` runs a track that no pack serves.
    pub(crate) fn run_with<X, M, H>(
        &self,
        method: X,
        tracks: &[Track<M, H>],
        limits: &[f64],
        alone: impl Fn(&Batch, &Track<M, H>) -> Option<Outcome> + Sync,
    ) -> Vec<Option<Outcome>>
    where
        X: Computes<M, Method: Sync> + Sync,
        M: Sync,
        H: Observation + Sync,
    {
        let by = method.method();
        let width = if packable(&by, self.goal) { lockstep::width::<X::Number>(self.vectors) } else { 1 };
        let pack = |batch: &Batch, of: &[Track<M, H>], whole: bool| {
            let job =
                Lockstep { method: by, tracks: of, whole, goal: self.goal, limits, watch: batch.watch() };
            self.vectors.run_in_registers::<X::Number, _>(job).unwrap_or_default()
        };
        self.run_by(tracks, width, pack, alone)
    }

    /// Shares the tracks out, in packs of up to `width`. What a pack could not do is done again: in a pack of its own, where no
    /// other lane can disagree with it, then alone.
    pub(crate) fn run_by<M: Sync, H: Sync>(
        &self,
        tracks: &[Track<M, H>],
        width: usize,
        pack: impl Fn(&Batch, &[Track<M, H>], bool) -> Vec<Option<Outcome>> + Sync,
        alone: impl Fn(&Batch, &Track<M, H>) -> Option<Outcome> + Sync,
    ) -> Vec<Option<Outcome>> {
        let units = units(tracks, width);
        // what is done again was counted
        let uncounted = Batch { rows: None, ..*self };
        let done = each(&units, self.threads, |unit| {
            let own: Vec<Track<M, H>> = unit.tracks.iter().map(|&k| tracks[k]).collect();
            let Some(whole) = unit.whole else { return own.iter().map(|track| alone(self, track)).collect() };
            let again = |track| {
                let one = core::slice::from_ref(track);
                let apart = if own.len() > 1 { pack(&uncounted, one, whole).pop().flatten() } else { None };
                apart.or_else(|| alone(&uncounted, track))
            };
            let lanes = pack(self, &own, whole);
            let lanes = lanes.into_iter().chain(core::iter::repeat_with(|| None));
            own.iter().zip(lanes).map(|(track, lane)| lane.or_else(|| again(track))).collect::<Vec<_>>()
        });
        let mut outcomes: Vec<Option<Outcome>> = tracks.iter().map(|_| None).collect();
        for (unit, done) in units.iter().zip(done) {
            for (&k, outcome) in unit.tracks.iter().zip(done) {
                outcomes[k] = outcome;
            }
        }
        outcomes
    }

    fn watch(&self) -> Watch<'_> {
        Watch { cancel: self.cancel, rows: self.rows }
    }

    /// One track by itself.
    pub(crate) fn alone<X: Computes<M>, M, H: Observation>(
        &self,
        method: X,
        track: &Track<M, H>,
        limits: &[f64],
    ) -> Option<Outcome> {
        if self.watch().stopped() {
            return None;
        }
        let Track { model, sensors, data, prior, parameters, at } = *track;
        let (rows, t0) = (data.rows().collect::<Vec<_>>(), data.start());
        run_until(method, model, sensors, &rows, t0, prior, parameters, self.goal, limits, at, self.watch())
    }
}

/// The most components that a measurement of any track has.
pub(crate) fn widest<M, H: Observation>(tracks: &[Track<M, H>]) -> usize {
    tracks.iter().map(|track| track.sensors.measures()).max().unwrap_or(0)
}

/// The outcomes of a method that is not for these models.
pub(crate) fn refused<M, H: Observation>(
    fault: Fault,
    tracks: &[Track<M, H>],
    goal: Goal,
) -> Vec<Option<Outcome>> {
    let one = |track: &Track<M, H>| {
        let mut outcome = Outcome::new(track.prior.mean().len(), track.sensors.measures(), goal);
        outcome.failure = Some((0, StepError { fault, time: track.data.start(), step: 0 }));
        Some(outcome)
    };
    tracks.iter().map(one).collect()
}
