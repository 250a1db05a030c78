//! Continuous dynamics behind a pointer.

use super::{Answers, Call, Question, answer, asked, unknown};
use crate::model::{At, Linear, Sde, Varies};
use crate::scalar::{Real, floats, floats_mut, numbers, numbers_mut};
use core::fmt::Debug;

/// What can be asked of a [`Sde`] behind a pointer; every one is it.
pub trait SdeCalls: Sync {
    /// See [`Sde::states`].
    fn states(&self) -> usize;
    /// See [`Sde::noises`].
    fn noises(&self) -> usize;
    /// See [`Sde::controls`].
    fn controls(&self) -> usize;
    /// See [`Sde::parameters`].
    fn parameters(&self) -> &[f64];
    /// See [`Sde::diffusion_varies`].
    fn diffusion_varies(&self) -> Varies;
    /// See [`Sde::drift_scratch`].
    fn drift_scratch(&self, points: usize) -> usize;
    /// See [`Sde::expansion_scratch`].
    fn expansion_scratch(&self, points: usize) -> usize;
    /// Its functions.
    fn ask(&self, question: Question);
}

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

impl<M: Sde + Sync> SdeCalls for M {
    fn states(&self) -> usize {
        Sde::states(self)
    }
    fn noises(&self) -> usize {
        Sde::noises(self)
    }
    fn controls(&self) -> usize {
        Sde::controls(self)
    }
    fn parameters(&self) -> &[f64] {
        Sde::parameters(self)
    }
    fn diffusion_varies(&self) -> Varies {
        Sde::diffusion_varies(self)
    }
    fn drift_scratch(&self, points: usize) -> usize {
        Sde::drift_scratch(self, points)
    }
    fn expansion_scratch(&self, points: usize) -> usize {
        Sde::expansion_scratch(self, points)
    }
    fn ask(&self, question: Question) {
        answer(&Asked(self), question);
    }
}

/// Any [`Sde`], behind a pointer.
#[derive(Clone, Copy)]
pub struct AnySde<'m>(pub &'m dyn SdeCalls);

impl Debug for AnySde<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("AnySde").field(&self.0.states()).finish()
    }
}

impl Sde for AnySde<'_> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn noises(&self) -> usize {
        self.0.noises()
    }
    fn controls(&self) -> usize {
        self.0.controls()
    }
    fn parameters(&self) -> &[f64] {
        self.0.parameters()
    }
    fn diffusion_varies(&self) -> Varies {
        self.0.diffusion_varies()
    }
    fn drift_scratch(&self, points: usize) -> usize {
        self.0.drift_scratch(points)
    }
    fn expansion_scratch(&self, points: usize) -> usize {
        self.0.expansion_scratch(points)
    }
    #[inline(always)]
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let of = floats(x);
        let to = floats_mut(out);
        if !asked(at, Call::One { x: of, out: to }, |question| self.0.ask(question)) {
            unknown(out);
        }
    }
    #[inline(always)]
    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        let (of, to) = (floats(x), floats_mut(g));
        if !asked(at, Call::Noise { x: of, out: to }, |question| self.0.ask(question)) {
            unknown(g);
        }
    }
    #[inline(always)]
    fn drift_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        let (of, to, scratch) = (floats(x), floats_mut(out), floats_mut(scratch));
        let call = Call::Points { points, x: of, out: to, scratch };
        if !asked(at, call, |question| self.0.ask(question)) {
            unknown(out);
        }
    }
    #[inline(always)]
    fn drift_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
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
            x: floats(x),
            f: floats_mut(f),
            l0: floats_mut(l0),
            lf: floats_mut(lf),
            scratch: floats_mut(scratch),
        };
        if !asked(at, call, |question| self.0.ask(question)) {
            unknown(f);
        }
    }
}
