//! Discrete dynamics behind a pointer.

use super::{Answers, Call, Question, answer, answer_root, asking};
use crate::kernels::Health;
use crate::model::{At, Linear, Noise, Transition};
use crate::scalar::{Real, numbers, numbers_mut};

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

behind_a_pointer! {
    AnyTransition is a Transition by TransitionCalls;
    known {
        fn states() -> usize;
        fn period() -> Option<f64>;
        fn serves_packs() -> bool;
        fn controls() -> usize;
        fn noise() -> Noise;
    }
    passing {
        fn parameters() -> &[f64];
        fn transition_scratch(points: usize) -> usize;
    }
    asking {
        #[inline(always)]
        fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
            asking::at_one(at, x, out, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn transition_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
            asking::at_points(at, points, x, out, scratch, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn transition_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
            asking::linear(at, x, s, out, scratch, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
            asking::noise(at, &[], out, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn noise_root<T: Real>(&self, at: &At<T>, root: &mut [T]) -> Health<T> {
            asking::noise_root(at, root, |question| self.model.ask(question))
        }
    }
}
