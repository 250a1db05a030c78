//! Continuous dynamics behind a pointer.

use super::{Answers, Call, Question, answer, asking};
use crate::model::{At, Linear, Sde, Varies};
use crate::scalar::{Real, numbers, numbers_mut, words, words_mut};

struct Asked<'a, M>(&'a M);

impl<M: Sde> Answers for Asked<'_, M> {
    #[inline(always)]
    fn answer<T: Real>(&self, at: &At<T>, call: Call) {
        match call {
            Call::One { x, out } => self.0.drift(at, numbers(x), numbers_mut(out)),
            Call::Points { points, x, out, scratch } => {
                self.0.drift_points(at, points, numbers(x), numbers_mut(out), numbers_mut(scratch));
            }
            Call::Linear { x, s, value, image, stride, scratch } => {
                let out = Linear { value: numbers_mut(value), image: numbers_mut(image), stride };
                self.0.drift_linear(at, numbers(x), numbers(s), out, numbers_mut(scratch));
            }
            Call::Noise { x, out } => self.0.diffusion(at, numbers(x), numbers_mut(out)),
            Call::Expansion { points, x, f, l0, lf, scratch } => self.0.expansion_points(
                at,
                points,
                numbers(x),
                numbers_mut(f),
                numbers_mut(l0),
                numbers_mut(lf),
                numbers_mut(scratch),
            ),
            Call::NoiseRoot { .. } => {}
        }
    }
}

behind_a_pointer! {
    AnySde is a Sde by SdeCalls;
    known {
        fn states() -> usize;
        fn noises() -> usize;
        fn serves_packs() -> bool;
        fn controls() -> usize;
        fn diffusion_varies() -> Varies;
    }
    passing {
        fn parameters() -> &[f64];
        fn drift_scratch(points: usize) -> usize;
        fn expansion_scratch(points: usize) -> usize;
    }
    asking {
        #[inline(always)]
        fn drift<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
            asking::at_one(at, x, out, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn drift_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
            asking::at_points(at, points, x, out, scratch, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn drift_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
            asking::linear(at, x, s, out, scratch, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
            asking::noise(at, x, out, |question| self.model.ask(question));
        }
        #[inline(always)]
        fn expansion_points<T: Real>(
            &self,
            at: &At<T>,
            points: usize,
            x: &[T],
            f: &mut [T],
            l0: &mut [T],
            lf: &mut [T],
            scratch: &mut [T],
        ) {
            let call = Call::Expansion {
                points,
                x: words(x),
                f: words_mut(f),
                l0: words_mut(l0),
                lf: words_mut(lf),
                scratch: words_mut(scratch),
            };
            if !asking::asked(at, call, |question| self.model.ask(question)) {
                asking::unknown(f);
            }
        }
    }
}
