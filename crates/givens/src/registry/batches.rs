//! A chosen method over many trajectories.

use super::choice::Choice;
use super::dispatch::Job;
use crate::batch::{Batch, Track, refused};
use crate::filter::{Form, Over};
use crate::model::{Observation, Sde, Transition};
use crate::run::Outcome;

impl Choice {
    /// Runs a discrete method over many trajectories; see [`Batch::run`]. A continuous one fails at the first row of each.
    pub fn run_batch<M: Transition + Sync, H: Observation + Sync>(
        &self,
        tracks: &[Track<M, H>],
        batch: &Batch,
    ) -> Vec<Option<Outcome>> {
        self.discrete(All { tracks, batch }).unwrap_or_else(|fault| refused(fault, tracks, batch.goal))
    }

    /// Runs a continuous method over many trajectories; see [`Batch::run`]. A discrete one fails at the first row of each.
    pub fn run_batch_continuous<M: Sde + Sync, H: Observation + Sync>(
        &self,
        tracks: &[Track<M, H>],
        batch: &Batch,
    ) -> Vec<Option<Outcome>> {
        self.continuous(All { tracks, batch }).unwrap_or_else(|fault| refused(fault, tracks, batch.goal))
    }
}

struct All<'s, 't, M, H> {
    tracks: &'s [Track<'t, M, H>],
    batch: &'s Batch<'s>,
}

impl<M: Sync, H: Observation + Sync> Job<M> for All<'_, '_, M, H> {
    type Done = Vec<Option<Outcome>>;
    fn with<X: Over<M> + Send + Sync + 'static>(self, method: X) -> Self::Done {
        // each method in packs is some seconds of compiling: those that users of many tracks choose have it
        if X::Form::SQUARE_ROOT {
            self.batch.run(method, self.tracks)
        } else {
            self.batch.run_alone(method, self.tracks)
        }
    }
}
