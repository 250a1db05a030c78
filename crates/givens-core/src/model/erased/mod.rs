//! Models behind a pointer: filters over them are compiled once, whatever the models.
//!
//! A function of a model is generic over its numbers, and a pointer cannot be asked for such; so all numbers cross as the
//! `f64` that they are made of, and their [`Grain`] tells what these are. A model is compiled for every grain, and for packs
//! within the instructions that they need.

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
use crate::scalar::{Dual2, Grain, Job, Pack, Real, numbers, numbers_mut};

/// Time, length of the step, controls and parameters, as floats.
#[derive(Clone, Copy, Debug)]
struct AtFloats<'a> {
    t: &'a [f64],
    dt: &'a [f64],
    u: &'a [f64],
    p: &'a [f64],
}

/// What is asked of a model, and where the answer is written; all numbers as floats.
#[derive(Debug)]
enum Call<'a> {
    /// Its function at one point.
    One { x: &'a [f64], out: &'a mut [f64] },
    /// Its function at many.
    Points { points: usize, x: &'a [f64], out: &'a mut [f64], scratch: &'a mut [f64] },
    /// Its first-order part.
    Linear {
        x: &'a [f64],
        s: &'a [f64],
        value: &'a mut [f64],
        image: &'a mut [f64],
        stride: usize,
        scratch: &'a mut [f64],
    },
    /// Its noise, at a state if it has one.
    Noise { x: &'a [f64], out: &'a mut [f64] },
    /// A root of that, the sick lanes (one for those that are), and their pivots.
    NoiseRoot { root: &'a mut [f64], sick: &'a mut [f64], pivot: &'a mut [f64] },
    /// Its Itô derivatives.
    Expansion {
        points: usize,
        x: &'a [f64],
        f: &'a mut [f64],
        l0: &'a mut [f64],
        lf: &'a mut [f64],
        scratch: &'a mut [f64],
    },
}

/// A question to a model behind a pointer. It is made by [`AnyTransition`], [`AnySde`] and [`AnyObservation`] alone.
#[derive(Debug)]
pub struct Question<'a> {
    grain: Grain,
    at: AtFloats<'a>,
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
    match grain {
        Grain { set: None, depth: 0 } => as_numbers::<f64, M>(model, at, call),
        Grain { set: None, depth: 1 } => as_numbers::<Dual2<f64>, M>(model, at, call),
        Grain { set: None, .. } => as_numbers::<Dual2<Dual2<f64>>, M>(model, at, call),
        Grain { set: Some(set), depth } => {
            // whoever has such numbers has been asked by a machine that has the set
            let _ = set.run_in_registers(Inside { model, at, call, depth });
        }
    }
}

#[inline(always)]
fn as_numbers<T: Real, M: Answers>(model: &M, at: &AtFloats, call: Call) {
    let at = At::<T> { t: one(at.t), dt: one(at.dt), u: numbers(at.u), p: numbers(at.p) };
    model.answer(&at, call);
}

/// A call within the instructions of a pack.
struct Inside<'s, M> {
    model: &'s M,
    at: &'s AtFloats<'s>,
    call: Call<'s>,
    depth: usize,
}

impl<M: Answers> Job<f64> for Inside<'_, M> {
    type Output = ();
    const AVX512: bool = false;
    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) {
        match self.depth {
            0 => as_numbers::<P, M>(self.model, self.at, self.call),
            _ => as_numbers::<Dual2<P>, M>(self.model, self.at, self.call),
        }
    }
}

#[inline(always)]
fn answer_root<T: Real>(health: Health<T>, sick: &mut [f64], pivot: &mut [f64]) {
    let told = T::select(health.sick, T::one(), T::zero());
    numbers_mut(sick).copy_from_slice(&[told]);
    numbers_mut(pivot).copy_from_slice(&[health.pivot]);
}

/// One number, where floats make it.
#[inline(always)]
fn one<T: Real>(of: &[f64]) -> T {
    match numbers::<T>(of) {
        [number, ..] => *number,
        [] => T::of(f64::NAN),
    }
}
