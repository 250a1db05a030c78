//! Filters in lockstep: one filter over packs is as many as they have lanes, each at its own time.

use super::memory::take;
use super::methods::Over;
use super::predict::{Plan, TimeUpdate};
#[cfg(doc)]
use super::sizes::Sizes;
use super::stepper::Filter;
use super::steps::Grow;
use super::update::Present;
use crate::kernels::plus_magnitudes;
use crate::model::Observation;
use crate::scalar::{LaneMask, MAX_WIDTH, Mask, Pack, Real};

/// The steps that each lane's gap takes.
#[derive(Clone, Copy)]
struct Plans {
    of: [Plan; MAX_WIDTH],
    width: usize,
}

impl Plans {
    /// The most that any takes.
    #[inline(always)]
    fn longest(&self) -> usize {
        self.of[..self.width].iter().map(|plan| plan.count).max().unwrap_or(0)
    }

    /// The lanes that have a step `k`, as bits.
    #[inline(always)]
    fn active(&self, k: usize) -> u32 {
        let mut bits = 0;
        for (i, plan) in self.of[..self.width].iter().enumerate() {
            bits |= u32::from(k < plan.count) << i;
        }
        bits
    }

    /// Where step `k` starts, and how long it is. A lane without one goes along with the first that has.
    #[inline(always)]
    fn step<P: Pack>(&self, k: usize, active: u32, from: &[f64]) -> ((f64, P), (f64, P)) {
        let (mut start, mut length) = ([P::Element::zero(); MAX_WIDTH], [P::Element::zero(); MAX_WIDTH]);
        let lead = active.trailing_zeros() as usize % self.width;
        let steps = k as f64;
        for i in 0..self.width {
            let i_or_lead = if active >> i & 1 == 1 { i } else { lead };
            start[i] = P::Element::of(from[i_or_lead] + steps * self.of[i_or_lead].dt);
            length[i] = P::Element::of(self.of[i_or_lead].dt);
        }
        let at = from[lead] + steps * self.of[lead].dt;
        ((at, P::load(&start)), (self.of[lead].dt, P::load(&length)))
    }
}

impl<X: Over<M>, M, P: Pack, B: Grow<P>> Filter<'_, X, M, P, B> {
    /// Packs of memory that [`predict_lanes`](Self::predict_lanes) needs beside the filter's, for n states.
    #[must_use]
    pub const fn spare_len(states: usize) -> usize {
        2 * states + 5 * states * states
    }

    /// Moves each lane from its own time to its own later one, as [`predict`](Self::predict) moves all; a lane whose times
    /// are equal stays as it is. The answer is the lanes that could not be moved: nothing of them is to be used any more.
    ///
    /// `from` and `to` have a time for every lane, and `spare` [`spare_len`](Self::spare_len) packs. The filter's own
    /// [`time`](Self::time) is that of one of the lanes.
    #[inline(always)]
    pub fn predict_lanes(&mut self, from: &[f64], to: &[f64], spare: &mut [P]) -> P::Mask {
        let nothing = Plan { count: 0, dt: 0.0 };
        let mut plans = Plans { of: [nothing; MAX_WIDTH], width: P::WIDTH.min(from.len()).min(to.len()) };
        let mut refused = 0_u32;
        for i in 0..plans.width {
            let gap = to[i] - from[i];
            let plan = self.method.time_update().plan(self.model, from[i], to[i]);
            match plan {
                Ok(plan) if gap >= 0.0 && gap.is_finite() && (self.controlled || plan.count == 0) => {
                    plans.of[i] = plan;
                }
                _ => refused |= 1 << i,
            }
        }
        let mut sick = P::Mask::of_bits(refused);
        self.stand_still();
        self.draw_from_moved();
        for k in 0..plans.longest() {
            let bits = plans.active(k);
            let active = P::Mask::of_bits(bits);
            let (start, length) = plans.step(k, bits, from);
            let some_rest = !active.all();
            if some_rest {
                self.keep(spare);
            }
            match self.one_step(start, length, k > 0) {
                Ok(more) => sick = sick | (more & active),
                // nothing of them was moved, nor of those that rest
                Err(_) => return sick | active,
            }
            if some_rest {
                self.restore(active, spare);
            }
        }
        self.step += usize::from(plans.longest() > 0);
        if let Some(&time) = to.first() {
            self.time = time;
        }
        sick | !self.all_finite()
    }

    /// Teaches each lane its own measurement: as [`update`](Self::update) does, or, where it is said which components are
    /// there, as [`update_present`](Self::update_present): `present[i]` tells in which lanes component i is. The answer is the
    /// lanes that could not take it in: nothing of them is to be used any more.
    ///
    /// `t` is the lanes' time; `z` and `present` have the sensor's length. A lane's number where it has no component is
    /// finite, and does not matter otherwise. What comes of a lane is the same to the bit whatever the others hold: with
    /// `present`, absent components are taken in as measures that say nothing, also where no lane has them. The filter must have
    /// been started with room for the sensor, by [`Sizes::with_sensor_in_lanes`].
    #[inline(always)]
    pub fn update_lanes<H: Observation>(
        &mut self,
        sensor: &H,
        t: &[f64],
        z: &[P],
        present: Option<&[P::Mask]>,
    ) -> P::Mask {
        let d = sensor.measures();
        let told = present.is_none_or(|present| present.len() == d);
        let whole = z.len() == d && told && sensor.states() == self.layout.sizes.states;
        let set = sensor.parameters() <= self.layout.sizes.parameters
            && sensor.controls() <= self.layout.sizes.controls
            && (sensor.controls() == 0 || self.controlled);
        let everybody = P::Mask::splat(true);
        let room = self.layout.sizes.hold(&self.layout.sizes.with_sensor_in_lanes(sensor, self.layout.shape));
        if !whole || !set || !room {
            return everybody;
        }
        self.parts().measured[..d].copy_from_slice(z);
        let mut at = [P::Element::zero(); MAX_WIDTH];
        for (at, &t) in at[..P::WIDTH].iter_mut().zip(t) {
            *at = P::Element::of(t);
        }
        let at = P::load(&at);
        // where every lane fails, there is no innovation: not that of the row before
        self.present = 0;
        self.parts().scores.fill(P::zero());
        self.draw_from_moved();
        let present = present.map_or(Present::All, Present::Lanes);
        let Ok(sick) = self.learn(sensor, at, present, None) else { return everybody };
        self.draw_from_moved();
        // a squared innovation that overflows is a fault also where the state is known, and the belief stays
        let scored = self.parts().scores[0].finite();
        sick | !(scored & self.all_finite())
    }

    /// Whoever draws the points of an update from a root that a prediction has left does so in all lanes, each from its own:
    /// where there is none, from the factor.
    #[inline(always)]
    fn draw_from_moved(&mut self) {
        if self.layout.moved && !self.moved {
            let belief = self.parts().belief;
            belief.moved.copy_from_slice(belief.factor);
            self.moved = true;
        }
    }

    /// Sets the controls of each lane, which hold until they are set again. False, and nothing done, if there are not as
    /// many of them.
    #[inline(always)]
    pub fn set_controls_in_lanes(&mut self, u: &[P]) -> bool {
        let to = self.parts().u;
        if to.len() != u.len() {
            return false;
        }
        to.copy_from_slice(u);
        self.controlled = true;
        true
    }

    /// Puts another filter, of the same method, model and sizes, into lane `lane`: the lane goes on as that one would.
    /// False, and nothing done, if its memory is another's.
    #[inline(always)]
    pub fn fill_lane<C: Grow<P::Element>>(
        &mut self,
        lane: usize,
        other: &mut Filter<'_, X, M, P::Element, C>,
    ) -> bool {
        if self.layout.sizes != other.layout.sizes || self.layout.len != other.layout.len {
            return false;
        }
        let scratch = self.parts().scratch.len();
        let kept = self.memory.as_mut().len() - scratch;
        let (to, from) = (&mut self.memory.as_mut()[..kept], &other.memory.as_mut()[..kept]);
        for (to, &x) in to.iter_mut().zip(from) {
            *to = to.with_lane(lane, x);
        }
        self.controlled = other.controlled;
        true
    }

    /// Lets `spare` remember what a prediction changes.
    #[inline(always)]
    fn keep(&mut self, mut spare: &mut [P]) {
        let parts = self.parts();
        let all = [
            &*parts.belief.mean,
            parts.floor,
            parts.belief.factor,
            parts.belief.cov,
            parts.belief.moved,
            parts.total.gain,
            parts.total.conditional,
        ];
        for from in all {
            take(&mut spare, from.len()).copy_from_slice(from);
        }
    }

    /// Takes it back in the lanes that are not `active`.
    #[inline(always)]
    fn restore(&mut self, active: P::Mask, mut spare: &mut [P]) {
        let parts = self.parts();
        let all = [
            parts.belief.mean,
            parts.floor,
            parts.belief.factor,
            parts.belief.cov,
            parts.belief.moved,
            parts.total.gain,
            parts.total.conditional,
        ];
        for to in all {
            let before = take(&mut spare, to.len());
            for (to, &mut before) in to.iter_mut().zip(before) {
                *to = P::select(active, *to, before);
            }
        }
    }

    /// The lanes whose mean and factor are finite numbers.
    #[inline(always)]
    fn all_finite(&mut self) -> P::Mask {
        let parts = self.parts();
        let sum = plus_magnitudes(P::zero(), parts.belief.mean);
        plus_magnitudes(sum, parts.belief.factor).finite()
    }
}
