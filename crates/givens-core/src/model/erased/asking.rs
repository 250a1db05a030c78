//! The functions of a model, asked behind a pointer: where it does not serve such numbers, it answers NaN.

use super::{AtWords, Call, Question};
use crate::kernels::Health;
use crate::model::{At, Linear};
use crate::scalar::{Grain, Real, words, words_mut};

/// At one point.
#[inline(always)]
pub fn at_one<T: Real>(at: &At<T>, x: &[T], out: &mut [T], ask: impl FnOnce(Question)) {
    if !asked(at, Call::One { x: words(x), out: words_mut(out) }, ask) {
        unknown(out);
    }
}

/// At many.
#[inline(always)]
pub fn at_points<T: Real>(
    at: &At<T>,
    points: usize,
    x: &[T],
    out: &mut [T],
    scratch: &mut [T],
    ask: impl FnOnce(Question),
) {
    let call = Call::Points { points, x: words(x), out: words_mut(out), scratch: words_mut(scratch) };
    if !asked(at, call, ask) {
        unknown(out);
    }
}

/// Its first-order part.
#[inline(always)]
pub fn linear<T: Real>(
    at: &At<T>,
    x: &[T],
    s: &[T],
    out: Linear<T>,
    scratch: &mut [T],
    ask: impl FnOnce(Question),
) {
    let Linear { value, image, stride } = out;
    let call = Call::Linear {
        x: words(x),
        s: words(s),
        value: words_mut(value),
        image: words_mut(image),
        stride,
        scratch: words_mut(scratch),
    };
    if !asked(at, call, ask) {
        unknown(value);
    }
}

/// Its noise, at a state if it has one.
#[inline(always)]
pub fn noise<T: Real>(at: &At<T>, x: &[T], out: &mut [T], ask: impl FnOnce(Question)) {
    if !asked(at, Call::Noise { x: words(x), out: words_mut(out) }, ask) {
        unknown(out);
    }
}

/// A root of its noise.
#[inline(always)]
pub fn noise_root<T: Real>(at: &At<T>, root: &mut [T], ask: impl FnOnce(Question)) -> Health<T> {
    let (mut sick, mut pivot) = ([T::zero()], [T::zero()]);
    let (told, which) = (words_mut(&mut sick), words_mut(&mut pivot));
    let call = Call::NoiseRoot { root: words_mut(root), sick: told, pivot: which };
    if !asked(at, call, ask) {
        unknown(root);
    }
    Health { sick: !sick[0].same(T::zero()), pivot: pivot[0] }
}

/// Asks with the numbers of `at` as words. False if a model behind a pointer does not serve such numbers.
#[inline(always)]
pub fn asked<T: Real>(at: &At<T>, call: Call, ask: impl FnOnce(Question)) -> bool {
    let Some(grain) = Grain::of::<T>() else { return false };
    let (t, dt) = ([at.t], [at.dt]);
    let at = AtWords { t: words(&t), dt: words(&dt), u: words(at.u), p: words(at.p) };
    ask(Question { grain, at, call });
    true
}

/// What stands where a model cannot be asked.
#[inline(always)]
pub fn unknown<T: Real>(out: &mut [T]) {
    for out in out {
        *out = T::of(f64::NAN);
    }
}
