//! Sensors behind a pointer.

use super::{Answers, Call, Question, answer, answer_root, asked, root_of, unknown};
use crate::kernels::Health;
use crate::model::{At, Linear, Noise, Observation};
use crate::scalar::{Real, floats, floats_mut, numbers, numbers_mut};
use core::fmt::Debug;

/// What can be asked of a [`Observation`] behind a pointer; every one is it.
pub trait ObservationCalls: Sync {
    /// See [`Observation::states`].
    fn states(&self) -> usize;
    /// See [`Observation::measures`].
    fn measures(&self) -> usize;
    /// See [`Observation::angle`].
    fn angle(&self, i: usize) -> Option<f64>;
    /// See [`Observation::controls`].
    fn controls(&self) -> usize;
    /// See [`Observation::parameters`].
    fn parameters(&self) -> usize;
    /// See [`Observation::noise`].
    fn noise(&self) -> Noise;
    /// See [`Observation::observe_scratch`].
    fn scratch(&self, points: usize) -> usize;
    /// Its functions.
    fn ask(&self, question: Question);
}

struct Asked<'a, M>(&'a M);

impl<M: Observation> Answers for Asked<'_, M> {
    #[inline(always)]
    fn answer<T: Real>(&self, at: &At<T>, call: Call) {
        match call {
            Call::One { x, out } => self.0.observe(at, numbers(x), numbers_mut(out)),
            Call::Points { points, x, out, scratch } => {
                self.0.observe_points(at, points, numbers(x), numbers_mut(out), numbers_mut(scratch));
            }
            Call::Linear { x, s, value, image, stride, scratch } => {
                let out = Linear { value: numbers_mut(value), image: numbers_mut(image), stride };
                self.0.observe_linear(at, numbers(x), numbers(s), out, numbers_mut(scratch));
            }
            Call::Noise { out, .. } => self.0.measurement_noise(at, numbers_mut(out)),
            Call::NoiseRoot { root, sick, pivot } => {
                answer_root(self.0.noise_root(at, numbers_mut(root)), sick, pivot);
            }
            Call::Expansion { .. } => {}
        }
    }
}

impl<M: Observation + Sync> ObservationCalls for M {
    fn states(&self) -> usize {
        Observation::states(self)
    }
    fn measures(&self) -> usize {
        Observation::measures(self)
    }
    fn angle(&self, i: usize) -> Option<f64> {
        Observation::angle(self, i)
    }
    fn controls(&self) -> usize {
        Observation::controls(self)
    }
    fn parameters(&self) -> usize {
        Observation::parameters(self)
    }
    fn noise(&self) -> Noise {
        Observation::noise(self)
    }
    fn scratch(&self, points: usize) -> usize {
        self.observe_scratch(points)
    }
    fn ask(&self, question: Question) {
        answer(&Asked(self), question);
    }
}

/// Any [`Observation`], behind a pointer.
#[derive(Clone, Copy)]
pub struct AnyObservation<'m>(pub &'m dyn ObservationCalls);

impl Debug for AnyObservation<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("AnyObservation").field(&self.0.states()).finish()
    }
}

impl Observation for AnyObservation<'_> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn measures(&self) -> usize {
        self.0.measures()
    }
    fn angle(&self, i: usize) -> Option<f64> {
        self.0.angle(i)
    }
    fn controls(&self) -> usize {
        self.0.controls()
    }
    fn parameters(&self) -> usize {
        self.0.parameters()
    }
    fn noise(&self) -> Noise {
        self.0.noise()
    }
    fn observe_scratch(&self, points: usize) -> usize {
        self.0.scratch(points)
    }
    #[inline(always)]
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let of = floats(x);
        let to = floats_mut(out);
        if !asked(at, Call::One { x: of, out: to }, |question| self.0.ask(question)) {
            unknown(out);
        }
    }
    #[inline(always)]
    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        let to = floats_mut(out);
        if !asked(at, Call::Noise { x: &[], out: to }, |question| self.0.ask(question)) {
            unknown(out);
        }
    }
    #[inline(always)]
    fn noise_root<T: Real>(&self, at: &At<T>, root: &mut [T]) -> Health<T> {
        root_of(at, root, |question| self.0.ask(question))
    }
    #[inline(always)]
    fn observe_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        let (of, to, scratch) = (floats(x), floats_mut(out), floats_mut(scratch));
        let call = Call::Points { points, x: of, out: to, scratch };
        if !asked(at, call, |question| self.0.ask(question)) {
            unknown(out);
        }
    }
    #[inline(always)]
    fn observe_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let Linear { value, image, stride } = out;
        let scratch = floats_mut(scratch);
        let call = Call::Linear {
            x: floats(x),
            s: floats(s),
            value: floats_mut(value),
            image: floats_mut(image),
            stride,
            scratch,
        };
        if !asked(at, call, |question| self.0.ask(question)) {
            unknown(value);
        }
    }
}
