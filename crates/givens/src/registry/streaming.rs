//! A chosen method over one long trajectory, streamed.

use super::choice::Choice;
use super::dispatch::{Computing, Job};
use crate::batch::Track;
use crate::filter::{Fault, StepError};
use crate::model::{AnyObservation, AnySde, AnyTransition, Observation, Sde, Transition};
use crate::stream::{Ended, Sink, Source, Stream};

impl Choice {
    /// Streams a discrete method over a trajectory; see [`Stream::run`]. A continuous one fails at the first row.
    pub fn stream<M: Transition + Sync, H: Observation + Sync, D: Source + ?Sized>(
        &self,
        track: &Track<M, H, D>,
        stream: &Stream,
        sink: &mut dyn Sink,
    ) -> Ended {
        let (model, sensors) = (&AnyTransition::new(track.model), &AnyObservation::new(track.sensors));
        self.stream_any(Along { track: &behind(track, model, sensors, &track.data), stream, sink })
    }

    /// Streams a continuous method over a trajectory; see [`Stream::run`]. A discrete one fails at the first row.
    pub fn stream_continuous<M: Sde + Sync, H: Observation + Sync, D: Source + ?Sized>(
        &self,
        track: &Track<M, H, D>,
        stream: &Stream,
        sink: &mut dyn Sink,
    ) -> Ended {
        let (model, sensors) = (&AnySde::new(track.model), &AnyObservation::new(track.sensors));
        self.stream_any_continuous(Along { track: &behind(track, model, sensors, &track.data), stream, sink })
    }

    // not generic: every filter of run time is compiled here, once

    fn stream_any(&self, along: Along<AnyTransition>) -> Ended {
        let refused = along.refused();
        self.discrete(along).unwrap_or_else(refused)
    }

    fn stream_any_continuous(&self, along: Along<AnySde>) -> Ended {
        let refused = along.refused();
        self.continuous(along).unwrap_or_else(refused)
    }
}

/// The same track over a model, sensors and rows behind pointers.
fn behind<'a, M, H, D: ?Sized, N, E>(
    track: &Track<'a, M, H, D>,
    model: &'a N,
    sensors: &'a E,
    data: &'a dyn Source,
) -> Track<'a, N, E, dyn Source + 'a> {
    let Track { prior, parameters, at, .. } = *track;
    Track { model, sensors, data, prior, parameters, at }
}

/// What a method is streamed along.
struct Along<'s, 't, M> {
    track: &'s Track<'t, M, AnyObservation<'t>, dyn Source + 't>,
    stream: &'s Stream<'s>,
    sink: &'s mut dyn Sink,
}

impl<M> Along<'_, '_, M> {
    /// How a method ends that is not for this model.
    fn refused(&self) -> impl FnOnce(Fault) -> Ended + use<M> {
        let time = self.track.data.start();
        move |fault| Ended { failure: Some((0, StepError { fault, time, step: 0 })), ..Ended::default() }
    }
}

impl<M: Sync> Job<M> for Along<'_, '_, M> {
    type Done = Ended;
    fn with<X: Computing<M>>(self, method: X) -> Ended {
        self.stream.run(method, self.track, self.sink)
    }
}
