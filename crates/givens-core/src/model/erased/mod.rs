//! Models behind a pointer: filters over them are compiled once, whatever the models.
//!
//! A function of a model is generic over its numbers, and a pointer cannot be asked for such; so all numbers cross as the
//! words that they are made of, and their [`Grain`] tells what these are. A model is compiled for every grain, in `f64` and in
//! `f32`, and for packs within the instructions that they need.

#[macro_use]
mod pointer;
mod asking;
mod observation;
mod sde;
mod transition;

pub use observation::{AnyObservation, ObservationCalls};
pub use sde::{AnySde, SdeCalls};
pub use transition::{AnyTransition, TransitionCalls};

use super::At;
use crate::kernels::Health;
use crate::scalar::{Dual2, Element, Grain, Job, Pack, Real, Word, numbers, numbers_mut};

/// Time, length of the step, controls and parameters, as words.
#[derive(Clone, Copy, Debug)]
struct AtWords<'a> {
    t: &'a [Word],
    dt: &'a [Word],
    u: &'a [Word],
    p: &'a [Word],
}

/// What is asked of a model, and where the answer is written; all numbers as words.
#[derive(Debug)]
enum Call<'a> {
    /// Its function at one point.
    One { x: &'a [Word], out: &'a mut [Word] },
    /// Its function at many.
    Points { points: usize, x: &'a [Word], out: &'a mut [Word], scratch: &'a mut [Word] },
    /// Its first-order part.
    Linear {
        x: &'a [Word],
        s: &'a [Word],
        value: &'a mut [Word],
        image: &'a mut [Word],
        stride: usize,
        scratch: &'a mut [Word],
    },
    /// Its noise, at a state if it has one.
    Noise { x: &'a [Word], out: &'a mut [Word] },
    /// A root of that, the sick lanes (one for those that are), and their pivots.
    NoiseRoot { root: &'a mut [Word], sick: &'a mut [Word], pivot: &'a mut [Word] },
    /// Its Itô derivatives.
    Expansion {
        points: usize,
        x: &'a [Word],
        f: &'a mut [Word],
        l0: &'a mut [Word],
        lf: &'a mut [Word],
        scratch: &'a mut [Word],
    },
}

/// A question to a model behind a pointer. It is made by [`AnyTransition`], [`AnySde`] and [`AnyObservation`] alone.
#[derive(Debug)]
pub struct Question<'a> {
    grain: Grain,
    at: AtWords<'a>,
    call: Call<'a>,
}

/// A model's answer to a call with numbers of type `T`.
trait Answers {
    fn answer<T: Real>(&self, at: &At<T>, call: Call);
}

/// Finds the type of the numbers, and lets the model answer.
#[inline(always)]
fn answer<M: Answers>(model: &M, question: Question) {
    let Question { grain, ref at, call } = question;
    if grain.single {
        answer_in::<f32, M>(model, grain, at, call);
    } else {
        answer_in::<f64, M>(model, grain, at, call);
    }
}

#[inline(always)]
fn answer_in<E: Element, M: Answers>(model: &M, grain: Grain, at: &AtWords, call: Call) {
    match grain {
        Grain { set: None, depth: 0, .. } => as_numbers::<E, M>(model, at, call),
        Grain { set: None, depth: 1, .. } => as_numbers::<Dual2<E>, M>(model, at, call),
        Grain { set: None, .. } => as_numbers::<Dual2<Dual2<E>>, M>(model, at, call),
        Grain { set: Some(set), depth, .. } => {
            // whoever has such numbers has been asked by a machine that has the set
            let _ = set.run_in_registers::<E, _>(Inside { model, at, call, depth });
        }
    }
}

#[inline(always)]
fn as_numbers<T: Real, M: Answers>(model: &M, at: &AtWords, call: Call) {
    let at = At::<T> { t: one(at.t), dt: one(at.dt), u: numbers(at.u), p: numbers(at.p) };
    model.answer(&at, call);
}

/// A call within the instructions of a pack.
struct Inside<'s, M> {
    model: &'s M,
    at: &'s AtWords<'s>,
    call: Call<'s>,
    depth: usize,
}

impl<E: Element, M: Answers> Job<E> for Inside<'_, M> {
    type Output = ();
    #[inline(always)]
    fn run<P: Pack<Element = E>>(self) {
        match self.depth {
            0 => as_numbers::<P, M>(self.model, self.at, self.call),
            _ => as_numbers::<Dual2<P>, M>(self.model, self.at, self.call),
        }
    }
}

#[inline(always)]
fn answer_root<T: Real>(health: Health<T>, sick: &mut [Word], pivot: &mut [Word]) {
    let told = T::select(health.sick, T::one(), T::zero());
    numbers_mut(sick).copy_from_slice(&[told]);
    numbers_mut(pivot).copy_from_slice(&[health.pivot]);
}

/// One number, where words make it.
#[inline(always)]
fn one<T: Real>(of: &[Word]) -> T {
    match numbers::<T>(of) {
        [number, ..] => *number,
        [] => T::of(f64::NAN),
    }
}
