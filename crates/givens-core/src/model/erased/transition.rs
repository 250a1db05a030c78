//! Discrete dynamics behind a pointer.

use super::{Answers, Call, Question, answer, answer_root, asked, root_of, unknown};
use crate::kernels::Health;
use crate::model::{At, Linear, Noise, Transition};
use crate::scalar::{Real, floats, floats_mut, numbers, numbers_mut};
use core::fmt::Debug;

/// What can be asked of a [`Transition`] behind a pointer; every one is it.
pub trait TransitionCalls: Sync {
    /// See [`Transition::states`].
    fn states(&self) -> usize;
    /// See [`Transition::period`].
    fn period(&self) -> Option<f64>;
    /// See [`Transition::controls`].
    fn controls(&self) -> usize;
    /// See [`Transition::parameters`].
    fn parameters(&self) -> &[f64];
    /// See [`Transition::noise`].
    fn noise(&self) -> Noise;
    /// See [`Transition::transition_scratch`].
    fn scratch(&self, points: usize) -> usize;
    /// Its functions.
    fn ask(&self, question: Question);
}

struct Asked<'a, M>(&'a M);

impl<M: Transition> Answers for Asked<'_, M> {
    #[inline(always)]
    fn answer<T: Real>(&self, at: &At<T>, call: Call) {
        match call {
            Call::One { x, out } => self.0.transition(at, numbers(x), numbers_mut(out)),
            Call::Points { points, x, out, scratch } => {
                self.0.transition_points(at, points, numbers(x), numbers_mut(out), numbers_mut(scratch));
            }
            Call::Linear { x, s, value, image, stride, scratch } => {
                let out = Linear { value: numbers_mut(value), image: numbers_mut(image), stride };
                self.0.transition_linear(at, numbers(x), numbers(s), out, numbers_mut(scratch));
            }
            Call::Noise { out, .. } => self.0.process_noise(at, numbers_mut(out)),
            Call::NoiseRoot { root, sick, pivot } => {
                answer_root(self.0.noise_root(at, numbers_mut(root)), sick, pivot);
            }
            Call::Expansion { .. } => {}
        }
    }
}

impl<M: Transition + Sync> TransitionCalls for M {
    fn states(&self) -> usize {
        Transition::states(self)
    }
    fn period(&self) -> Option<f64> {
        Transition::period(self)
    }
    fn controls(&self) -> usize {
        Transition::controls(self)
    }
    fn parameters(&self) -> &[f64] {
        Transition::parameters(self)
    }
    fn noise(&self) -> Noise {
        Transition::noise(self)
    }
    fn scratch(&self, points: usize) -> usize {
        self.transition_scratch(points)
    }
    fn ask(&self, question: Question) {
        answer(&Asked(self), question);
    }
}

/// Any [`Transition`], behind a pointer.
#[derive(Clone, Copy)]
pub struct AnyTransition<'m>(pub &'m dyn TransitionCalls);

impl Debug for AnyTransition<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("AnyTransition").field(&self.0.states()).finish()
    }
}

impl Transition for AnyTransition<'_> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn period(&self) -> Option<f64> {
        self.0.period()
    }
    fn controls(&self) -> usize {
        self.0.controls()
    }
    fn parameters(&self) -> &[f64] {
        self.0.parameters()
    }
    fn noise(&self) -> Noise {
        self.0.noise()
    }
    fn transition_scratch(&self, points: usize) -> usize {
        self.0.scratch(points)
    }
    #[inline(always)]
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let of = floats(x);
        let to = floats_mut(out);
        if !asked(at, Call::One { x: of, out: to }, |question| self.0.ask(question)) {
            unknown(out);
        }
    }
    #[inline(always)]
    fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
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
    fn transition_points<T: Real>(
        &self,
        at: &At<T>,
        points: usize,
        x: &[T],
        out: &mut [T],
        scratch: &mut [T],
    ) {
        let (of, to, scratch) = (floats(x), floats_mut(out), floats_mut(scratch));
        let call = Call::Points { points, x: of, out: to, scratch };
        if !asked(at, call, |question| self.0.ask(question)) {
            unknown(out);
        }
    }
    #[inline(always)]
    fn transition_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
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
