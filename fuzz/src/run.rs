//! Any model, method and data: an error that names its row, or numbers; the same from every way of running it.

use crate::bytes::Bytes;
use crate::world::{Moves, World, refused};
use crate::{method, promise};
use givens::batch::{Batch, Track};
use givens::filter::Gaussian;
use givens::registry::{Choice, Kind};
use givens::simulate::{Paths, Scheme, Stream as Randoms, simulate, simulate_continuous};
use givens::{Data, Draws, Goal, Outcome, Stream};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

pub(crate) fn body(data: &[u8]) {
    let bytes = &mut Bytes(data);
    let kind = if bytes.flag() { Kind::Continuous } else { Kind::Discrete };
    let way = bytes.byte();
    let Some(world) = World::any(bytes, kind) else { return };
    let Some(choice) = method::method(bytes, kind, world.states) else { return };
    let Some(prior) = world.prior(bytes) else { return };
    let data = world.data(bytes);
    let goal = goal(bytes, &world, &data);
    let mut at = if way & 4 == 0 { Vec::new() } else { bytes.plains(3) };
    at.retain(|&time| world.near(time));
    at.sort_by(f64::total_cmp);
    let case = Case { world: &world, choice, prior: &prior, data: &data, goal, at: &at };
    let outcome = case.run();
    promise::kept(&outcome, data.len(), &choice);
    match way % 4 {
        0 => case.streamed(&outcome, bytes),
        1 => case.batch(bytes),
        2 => case.sampled(bytes),
        _ => case.simulated(bytes),
    }
}

fn goal(bytes: &mut Bytes, world: &World, data: &Data) -> Goal {
    match bytes.below(6) {
        0 | 1 => Goal::Filter,
        2 | 3 => Goal::Interval,
        4 => Goal::Lag(if bytes.below(8) == 7 { bytes.length() } else { bytes.below(5) }),
        _ => match data.row(bytes.below(6)) {
            Some(row) => Goal::Point(row.time),
            None => Some(bytes.plain()).filter(|&time| world.near(time)).map_or(Goal::Interval, Goal::Point),
        },
    }
}

struct Case<'a> {
    world: &'a World,
    choice: Choice,
    prior: &'a Gaussian,
    data: &'a Data,
    goal: Goal,
    at: &'a [f64],
}

impl Case<'_> {
    fn run(&self) -> Outcome {
        let Self { world, choice, prior, data, goal, at } = self;
        let (rows, t0, sensors) = (data.rows(), data.start(), &world.sensors);
        match &world.moves {
            Moves::Discrete(model) => choice.run(model, sensors, rows, t0, prior, *goal, at),
            Moves::Continuous(model) => choice.run_continuous(model, sensors, rows, t0, prior, *goal, at),
        }
    }

    /// A stream gives the rows of the run to the bit.
    fn streamed(&self, whole: &Outcome, bytes: &mut Bytes) {
        let hold = bytes.below(4);
        let stream = Stream { goal: self.goal, hold, threads: NonZeroUsize::new(1), ..Stream::default() };
        let (mut rows, mut next) = (givens::Estimates::default(), None);
        let mut sink = |finished: givens::Finished| {
            // before the time of a fixed point there are rows without estimates
            if !finished.estimates.is_empty() {
                assert_eq!(finished.first, next.unwrap_or(finished.first));
                next = Some(finished.first + finished.estimates.len());
            }
            promise::finite(finished.at);
            for k in 0..finished.estimates.len() {
                assert!(rows.push(finished.estimates, k));
            }
            ControlFlow::Continue(())
        };
        let World { moves, sensors, .. } = self.world;
        let ended = match moves {
            Moves::Discrete(model) => {
                let track = Track { at: self.at, ..Track::new(model, sensors, self.data, self.prior) };
                self.choice.stream(&track, &stream, &mut sink)
            }
            Moves::Continuous(model) => {
                let track = Track { at: self.at, ..Track::new(model, sensors, self.data, self.prior) };
                self.choice.stream_continuous(&track, &stream, &mut sink)
            }
        };
        assert_eq!(
            ended.failure.is_some(),
            whole.failure.is_some(),
            "{:?} {:?}",
            ended.failure,
            whole.failure
        );
        if ended.failure.is_none() {
            promise::same(&rows, &whole.estimates);
        }
    }

    /// Tracks of a batch keep what is promised, each with its own rows.
    fn batch(&self, bytes: &mut Bytes) {
        let other = self.world.data(bytes);
        let datas = [self.data, &other, self.data];
        let batch = Batch { goal: self.goal, threads: NonZeroUsize::new(1), ..Batch::default() };
        let World { moves, sensors, .. } = self.world;
        let outcomes = match moves {
            Moves::Discrete(model) => {
                let tracks =
                    datas.map(|data| Track { at: self.at, ..Track::new(model, sensors, data, self.prior) });
                self.choice.run_batch(&tracks, &batch)
            }
            Moves::Continuous(model) => {
                let tracks =
                    datas.map(|data| Track { at: self.at, ..Track::new(model, sensors, data, self.prior) });
                self.choice.run_batch_continuous(&tracks, &batch)
            }
        };
        assert_eq!(outcomes.len(), datas.len());
        for (outcome, data) in outcomes.iter().zip(datas) {
            let outcome = outcome.as_ref().expect("nothing was cancelled");
            promise::kept(outcome, data.len(), &self.choice);
        }
    }

    fn sampled(&self, bytes: &mut Bytes) {
        let draws = Draws { count: 2, seed: bytes.word(), track: 0 };
        let (rows, t0, prior, sensors) =
            (self.data.rows(), self.data.start(), self.prior, &self.world.sensors);
        let drawn = match &self.world.moves {
            Moves::Discrete(model) => self.choice.sample(model, sensors, rows, t0, prior, draws),
            Moves::Continuous(model) => self.choice.sample_continuous(model, sensors, rows, t0, prior, draws),
        };
        match drawn {
            Ok(samples) => {
                assert!(samples.x.iter().all(|x| x.is_finite()), "{samples:?}");
                assert_eq!(samples.x.len(), 2 * self.data.len() * self.world.states);
            }
            Err(failure) => {
                promise::told(&failure.error, &self.choice);
                promise::finite(&failure.finished);
            }
        }
    }

    fn simulated(&self, bytes: &mut Bytes) {
        let stream = &mut Randoms::new(bytes.word(), 0, 0);
        let scheme = if bytes.flag() { Scheme::EulerMaruyama } else { Scheme::ItoTaylor };
        let paths = Paths { scheme, steps: self.choice.integrator.steps };
        let (rows, t0, prior, sensors) =
            (self.data.rows(), self.data.start(), self.prior, &self.world.sensors);
        let drawn = match &self.world.moves {
            Moves::Discrete(model) => simulate(model, sensors, rows, t0, prior, stream),
            Moves::Continuous(model) => simulate_continuous(model, sensors, rows, t0, prior, &paths, stream),
        };
        if let Some(drawn) = refused(drawn) {
            assert!(drawn.states.iter().all(|x| x.is_finite()), "{drawn:?}");
            assert!(drawn.z.iter().all(|z| !z.is_infinite()), "{drawn:?}");
        }
    }
}
