//! A chosen method over many trajectories.

use super::choice::Choice;
use super::dispatch::{Computing, Job, Packed};
use super::words::Precision;
use crate::batch::{Batch, Track, refused, widest};
use crate::filter::predict::{OneTransition, TimeUpdate};
use crate::model::{AnyObservation, AnySde, AnyTransition, Observation, Sde, Transition};
use crate::run::Outcome;
use crate::{Single, gate};
use std::collections::HashMap;

impl Choice {
    /// Runs a discrete method over many trajectories; see [`Batch::run`]. A continuous one fails at the first row of each.
    /// In packs go square-root forms, but for central differences.
    pub fn run_batch<M: Transition + Sync, H: Observation + Sync>(
        &self,
        tracks: &[Track<M, H>],
        batch: &Batch,
    ) -> Vec<Option<Outcome>> {
        let models = Pointed::new(tracks.iter().map(|track| track.model), |model| AnyTransition::new(model));
        let sensors =
            Pointed::new(tracks.iter().map(|track| track.sensors), |sensors| AnyObservation::new(sensors));
        self.run_any_batch(&behind(tracks, &models, &sensors), batch)
    }

    /// Runs a continuous method over many trajectories; see [`Batch::run`]. A discrete one fails at the first row of each.
    /// In packs go square-root forms by Itô–Taylor steps.
    pub fn run_batch_continuous<M: Sde + Sync, H: Observation + Sync>(
        &self,
        tracks: &[Track<M, H>],
        batch: &Batch,
    ) -> Vec<Option<Outcome>> {
        let models = Pointed::new(tracks.iter().map(|track| track.model), |model| AnySde::new(model));
        let sensors =
            Pointed::new(tracks.iter().map(|track| track.sensors), |sensors| AnyObservation::new(sensors));
        self.run_any_batch_continuous(&behind(tracks, &models, &sensors), batch)
    }

    // not generic: every filter of run time is compiled here, once; in packs, those by points or derivatives over one
    // transition or by Itô and Taylor, in square-root form

    fn run_any_batch(
        &self,
        tracks: &[Track<AnyTransition, AnyObservation>],
        batch: &Batch,
    ) -> Vec<Option<Outcome>> {
        if let Err(fault) = self.discrete::<AnyTransition, _>(Nothing) {
            return refused(fault, tracks, batch.goal);
        }
        let limits = &match gate::limits(self.gate, widest(tracks)) {
            Ok(limits) => limits,
            Err(fault) => return refused(fault, tracks, batch.goal),
        };
        let alone = |batch: &Batch, track: &Track<AnyTransition, AnyObservation>| {
            self.discrete(Alone { track, batch, limits }).ok().flatten()
        };
        match self.packed(OneTransition) {
            Some(packed) => self.in_packs(packed, tracks, batch, limits, alone),
            None => batch.run_by(tracks, 1, |_, _, _| Vec::new(), alone),
        }
    }

    fn run_any_batch_continuous(
        &self,
        tracks: &[Track<AnySde, AnyObservation>],
        batch: &Batch,
    ) -> Vec<Option<Outcome>> {
        if let Err(fault) = self.continuous::<AnySde, _>(Nothing) {
            return refused(fault, tracks, batch.goal);
        }
        let limits = &match gate::limits(self.gate, widest(tracks)) {
            Ok(limits) => limits,
            Err(fault) => return refused(fault, tracks, batch.goal),
        };
        let alone = |batch: &Batch, track: &Track<AnySde, AnyObservation>| {
            self.continuous(Alone { track, batch, limits }).ok().flatten()
        };
        match self.ito_taylor().and_then(|time| self.packed(time)) {
            Some(packed) => self.in_packs(packed, tracks, batch, limits, alone),
            None => batch.run_by(tracks, 1, |_, _, _| Vec::new(), alone),
        }
    }
}

impl Choice {
    fn in_packs<U, M: Sync, H: Observation + Sync>(
        &self,
        packed: Packed<U>,
        tracks: &[Track<M, H>],
        batch: &Batch,
        limits: &[f64],
        alone: impl Fn(&Batch, &Track<M, H>) -> Option<Outcome> + Sync,
    ) -> Vec<Option<Outcome>>
    where
        U: TimeUpdate<M> + Sync,
    {
        match (packed, self.precision) {
            (Packed::Points(by), Precision::F64) => batch.run_with(by, tracks, limits, alone),
            (Packed::Points(by), Precision::F32) => batch.run_with(Single(by), tracks, limits, alone),
            (Packed::Taylor(by), Precision::F64) => batch.run_with(by, tracks, limits, alone),
            (Packed::Taylor(by), Precision::F32) => batch.run_with(Single(by), tracks, limits, alone),
        }
    }
}

/// Each model once, however many tracks have it: those that have one in common go together.
struct Pointed<D> {
    all: Vec<D>,
    /// Of every track, which.
    of: Vec<usize>,
}

impl<D> Pointed<D> {
    fn new<'m, M: 'm>(models: impl Iterator<Item = &'m M>, pointer: impl Fn(&'m M) -> D) -> Self {
        let (mut all, mut seen) = (Vec::new(), HashMap::new());
        let of = models.map(|model| {
            *seen.entry(core::ptr::from_ref(model)).or_insert_with(|| {
                all.push(pointer(model));
                all.len() - 1
            })
        });
        let of = of.collect();
        Self { all, of }
    }
}

/// The same tracks over models and sensors behind pointers.
fn behind<'a, M, H, D, E>(
    tracks: &[Track<'a, M, H>],
    models: &'a Pointed<D>,
    sensors: &'a Pointed<E>,
) -> Vec<Track<'a, D, E>> {
    let track = |(k, track): (usize, &Track<'a, M, H>)| Track {
        model: &models.all[models.of[k]],
        sensors: &sensors.all[sensors.of[k]],
        data: track.data,
        prior: track.prior,
        parameters: track.parameters,
        at: track.at,
    };
    tracks.iter().enumerate().map(track).collect()
}

/// Whether the method is for such models.
struct Nothing;

impl<M> Job<M> for Nothing {
    type Done = ();
    fn with<X: Computing<M>>(self, _: X) {}
}

/// One track by itself.
struct Alone<'s, 't, M, H> {
    track: &'s Track<'t, M, H>,
    batch: &'s Batch<'s>,
    limits: &'s [f64],
}

impl<M, H: Observation> Job<M> for Alone<'_, '_, M, H> {
    type Done = Option<Outcome>;
    fn with<X: Computing<M>>(self, method: X) -> Self::Done {
        self.batch.alone(method, self.track, self.limits)
    }
}
