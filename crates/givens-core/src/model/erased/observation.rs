//! Sensors behind a pointer.

use super::{Answers, Call, Question, answer, answer_root, asking};
use crate::kernels::Health;
use crate::model::{At, Linear, Noise, Observation};
use crate::scalar::{Real, numbers, numbers_mut};

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

behind_a_pointer! {
    AnyObservation is a Observation by ObservationCalls;
    known {
        fn states() -> usize;
        fn measures() -> usize;
        fn serves_packs() -> bool;
        fn controls() -> usize;
        fn parameters() -> usize;
        fn noise() -> Noise;
    }
    passing {
        fn angle(i: usize) -> Option<f64>;
        fn observe_scratch(points: usize) -> usize;
    }
    asking {
        #[inline(always)]
        fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
            asking::at_one(at, x, out, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn observe_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
            asking::at_points(at, points, x, out, scratch, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn observe_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
            asking::linear(at, x, s, out, scratch, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
            asking::noise(at, &[], out, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn noise_root<T: Real>(&self, at: &At<T>, root: &mut [T]) -> Health<T> {
            asking::noise_root(at, root, |question| self.model.ask(question))
        }
    }
}
