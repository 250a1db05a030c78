//! One pack: several tracks, row by row, each at its own times.

use super::Track;
use super::record::Lanes;
use crate::filter::{Filter, Over, Prior};
use crate::gate::limit;
use crate::model::Observation;
use crate::rule::Rule;
use crate::run::{Goal, Outcome, Watch};
use crate::scalar::{Element, InstructionSet, Job, LaneMask, MAX_WIDTH, Mask, Pack, Real};
use crate::smoother::{History, Smoothed};
use core::ops::ControlFlow;

/// Tracks over one model and its sensors, at most as many as a pack has lanes. What comes of one is the same to the bit whatever
/// the others are: a lane that takes another way than the others is given back as not served, and one that is a pack's only
/// track is in all of its lanes.
pub(super) struct Lockstep<'s, 't, X, M, H> {
    pub method: X,
    pub tracks: &'s [Track<'t, M, H>],
    /// Whether every measurement has all of its components, in every track.
    pub whole: bool,
    pub goal: Goal,
    /// Of the gate, as in `Task`.
    pub limits: &'s [f64],
    pub watch: Watch<'s>,
}

/// Lanes of the packs of an instruction set; one where it is none of this machine's registers.
pub(super) fn width<E: Element>(vectors: InstructionSet) -> usize {
    struct Width;
    impl<E: Element> Job<E> for Width {
        type Output = usize;
        #[inline(always)]
        fn run<P: Pack<Element = E>>(self) -> usize {
            P::WIDTH
        }
    }
    vectors.run_in_registers::<E, _>(Width).unwrap_or(1)
}

impl<X: Over<M>, M, H: Observation, E: Element> Job<E> for Lockstep<'_, '_, X, M, H> {
    /// For each track what came of it, or none if it is to be run alone.
    type Output = Vec<Option<Outcome>>;

    #[inline(always)]
    fn run<P: Pack<Element = E>>(self) -> Self::Output {
        let Self { method, tracks, whole, goal, limits, watch } = self;
        let nothing = || tracks.iter().map(|_| None).collect();
        let everyone: Vec<_> = tracks.iter().copied().cycle().take(P::WIDTH).collect();
        let Some((mut filter, begun)) = begin::<P, X, M, H>(method, &everyone, goal) else {
            return nothing();
        };
        let n = filter.mean().len();
        let longest = tracks.iter().map(|track| track.data.len()).max().unwrap_or(0);
        let smoothing = goal != Goal::Filter;
        let records = if smoothing { longest } else { 0 };
        let mut history =
            History::<P, Vec<P>>::new(n, true, vec![P::zero(); History::<P, Vec<P>>::memory_len(n, records)]);
        let mut spare = vec![P::zero(); Filter::<X, M, P, Vec<P>>::spare_len(n)];
        let mut rows = Rows::<P>::begin(&everyone, filter.controls(), begun);
        let mut lanes = Lanes::<P>::new(tracks, n, goal);
        let own = u32::MAX >> (u32::BITS as usize - tracks.len());
        for k in 0..longest {
            if watch.stopped() || rows.well == 0 {
                return nothing();
            }
            rows.read(&everyone, k, limits);
            filter.set_controls_in_lanes(&rows.before);
            let moved = history.predict_lanes(&mut filter, &rows.from, &rows.to, &mut spare);
            lanes.predicted(&filter, k, rows.active);
            filter.set_controls_in_lanes(&rows.after);
            let (sensors, to, z) = (tracks[0].sensors, &rows.to, &rows.z);
            let present = (!whole).then_some(&rows.present[..]);
            let limit = (!limits.is_empty()).then_some(rows.limit);
            let measured = P::Mask::of_bits(rows.measured);
            let (taught, gated) =
                filter.update_lanes_gated(sensors, to, z, present, measured, limit, &mut spare);
            rows.well &= !((moved | taught).bits() & rows.active);
            lanes.updated(&filter, k, &rows.present, rows.active, gated.bits());
            watch.count((rows.active & rows.well & own).count_ones() as usize);
            rows.next();
        }
        let mut well = rows.well;
        if smoothing && longest > 0 {
            let mut way = Vec::with_capacity(longest * (n + n * n));
            let done = history.smooth(&filter, longest - 1, |_, smoothed: &Smoothed<P>| {
                way.extend_from_slice(smoothed.belief.mean);
                way.extend_from_slice(smoothed.belief.factor);
                if watch.stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            if watch.stopped() {
                return nothing();
            }
            well &= if done.is_ok() { lanes.smoothed(&way) } else { 0 };
        }
        lanes.finish(well)
    }
}

/// A filter over packs.
type OfPacks<'m, X, M, P> = Filter<'m, X, M, P, Vec<P>>;

/// It, and the lanes whose track has begun in it. A track that could not begin is left to be run alone, which
/// says why.
#[inline(always)]
fn begin<'m, P: Pack, X: Over<M>, M, H: Observation>(
    method: X,
    tracks: &[Track<'m, M, H>],
    goal: Goal,
) -> Option<(OfPacks<'m, X, M, P>, u32)> {
    let smoothing = goal != Goal::Filter;
    let Track { model, sensors, .. } = *tracks.first()?;
    let sizes = method.sizes(model).ok()?;
    let sizes = sizes.with_sensor_in_lanes(sensors, method.rule().shape(sizes.states));
    let prior = |track: &Track<'m, M, H>| Prior {
        time: track.data.start(),
        mean: track.prior.mean(),
        factor: track.prior.factor(),
        cov: track.prior.cov(),
    };
    let len = Filter::<X, M, P, Vec<P>>::memory_len(&method, sizes, smoothing);
    let mut one = vec![P::Element::zero(); len];
    let mut filter: Option<OfPacks<'m, X, M, P>> = None;
    let mut begun = 0;
    for (lane, track) in tracks.iter().enumerate() {
        if track.data.measures() != sensors.measures() || track.data.controls() != sizes.controls {
            continue;
        }
        let own = Filter::start_in(method, model, sizes, smoothing, prior(track), one.as_mut_slice());
        let Ok(mut own) = own else { continue };
        if !track.parameters.is_empty() && own.set_parameters(track.parameters).is_err() {
            continue;
        }
        if filter.is_none() {
            // every lane begins as a track that is well
            let start = Filter::start_in(method, model, sizes, smoothing, prior(track), vec![P::zero(); len]);
            let mut start = start.ok()?;
            (0..P::WIDTH).for_each(|lane| {
                start.fill_lane(lane, &mut own);
            });
            filter = Some(start);
        }
        begun |= u32::from(filter.as_mut()?.fill_lane(lane, &mut own)) << lane;
    }
    Some((filter?, begun))
}

/// The row at work, of every lane.
struct Rows<P: Pack> {
    /// Where each lane stands, and where it goes.
    from: [f64; MAX_WIDTH],
    to: [f64; MAX_WIDTH],
    z: Vec<P>,
    present: Vec<P::Mask>,
    /// The largest NIS that is taken in.
    limit: P,
    /// Controls on the way to the row, and from it on.
    before: Vec<P>,
    after: Vec<P>,
    /// The lanes in which nothing has gone wrong.
    well: u32,
    /// Those of them that have this row.
    active: u32,
    /// Those of them that have a measurement in it.
    measured: u32,
}

impl<P: Pack> Rows<P> {
    #[inline(always)]
    fn begin<M, H: Observation>(tracks: &[Track<M, H>], controls: usize, begun: u32) -> Self {
        let mut from = [0.0; MAX_WIDTH];
        for (from, track) in from.iter_mut().zip(tracks) {
            *from = track.data.start();
        }
        let (d, c) = (tracks[0].sensors.measures(), controls);
        Self {
            from,
            to: from,
            z: vec![P::zero(); d],
            present: vec![P::Mask::splat(false); d],
            limit: P::zero(),
            before: vec![P::zero(); c],
            after: vec![P::zero(); c],
            well: begun,
            active: 0,
            measured: 0,
        }
    }

    /// Reads row `k` of every track that has one; a lane that has none, or is not well, stays where it is.
    #[inline(always)]
    fn read<M, H: Observation>(&mut self, tracks: &[Track<M, H>], k: usize, limits: &[f64]) {
        (self.active, self.measured) = (0, 0);
        self.present.fill(P::Mask::splat(false));
        for (lane, track) in tracks.iter().enumerate() {
            let row = track.data.row(k).filter(|_| self.well >> lane & 1 == 1);
            if row.is_some_and(|row| row.u.iter().any(|&u| !P::Element::of(u).finite())) {
                self.well &= !(1 << lane);
            }
            let row = row.filter(|_| self.well >> lane & 1 == 1);
            self.to[lane] = row.map_or(self.from[lane], |row| row.time);
            let Some(row) = row else { continue };
            self.active |= 1 << lane;
            let mut dof = 0;
            // where a component is missing, the number before stands for it
            for (i, &z) in row.z.iter().enumerate().filter(|(_, z)| !z.is_nan()) {
                dof += 1;
                self.z[i] = self.z[i].with_lane(lane, P::Element::of(z));
                self.present[i] = self.present[i] | P::Mask::of_bits(1 << lane);
            }
            self.measured |= u32::from(dof > 0) << lane;
            let most = limit(limits, dof).unwrap_or(f64::INFINITY);
            self.limit = self.limit.with_lane(lane, P::Element::of(most));
            for (i, &u) in row.u.iter().enumerate() {
                self.after[i] = self.after[i].with_lane(lane, P::Element::of(u));
                if k == 0 {
                    self.before[i] = self.before[i].with_lane(lane, P::Element::of(u));
                }
            }
        }
    }

    /// Goes on from this row.
    #[inline(always)]
    fn next(&mut self) {
        self.from = self.to;
        self.before.copy_from_slice(&self.after);
    }
}
