//! A chosen method over many trajectories.

use super::choice::Choice;
use super::dispatch::Job;
use crate::batch::{Batch, Track};
use crate::filter::{Fault, Over, StepError};
use crate::model::{Observation, Sde, Transition};
use crate::run::Outcome;

impl Choice {
    /// Runs a discrete method over many trajectories; see [`Batch::run`]. A continuous one fails at the first row of each.
    pub fn run_batch<M: Transition + Sync, H: Observation + Sync>(
        &self,
        tracks: &[Track<M, H>],
        batch: &Batch,
    ) -> Vec<Option<Outcome>> {
        self.discrete(All { tracks, batch }).unwrap_or_else(|fault| refused(fault, tracks, batch))
    }

    /// Runs a continuous method over many trajectories; see [`Batch::run`]. A discrete one fails at the first row of each.
    pub fn run_batch_continuous<M: Sde + Sync, H: Observation + Sync>(
        &self,
        tracks: &[Track<M, H>],
        batch: &Batch,
    ) -> Vec<Option<Outcome>> {
        self.continuous(All { tracks, batch }).unwrap_or_else(|fault| refused(fault, tracks, batch))
    }
}

/// The outcomes of a method that is not for these models.
fn refused<M, H: Observation>(fault: Fault, tracks: &[Track<M, H>], batch: &Batch) -> Vec<Option<Outcome>> {
    let one = |track: &Track<M, H>| {
        let mut outcome = Outcome::new(track.prior.mean().len(), track.sensors.measures(), batch.goal);
        outcome.failure = Some((0, StepError { fault, time: track.data.start(), step: 0 }));
        Some(outcome)
    };
    tracks.iter().map(one).collect()
}

struct All<'s, 't, M, H> {
    tracks: &'s [Track<'t, M, H>],
    batch: &'s Batch<'s>,
}

impl<M: Sync, H: Observation + Sync> Job<M> for All<'_, '_, M, H> {
    type Done = Vec<Option<Outcome>>;
    fn with<X: Over<M> + Send + Sync + 'static>(self, method: X) -> Self::Done {
        self.batch.run(method, self.tracks)
    }
}
