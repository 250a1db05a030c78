//! Nanoseconds per number of the elementary functions: packs of every instruction set that this machine has, beside
//! the platform's functions.
//!
//!     cargo run --release -p givens-core --example elementary
#![allow(clippy::print_stdout, reason = "it is a table")]

use core::hint::black_box;
use givens_core::scalar::{Element, InstructionSet, Job, Pack, Real};
use std::time::Instant;

const NUMBERS: usize = 1024;

/// f of every number; functions of two take the number and its neighbour a pack further.
struct Apply<'a, E, const FUNCTION: usize> {
    x: &'a [E],
    out: &'a mut [E],
}

const FUNCTIONS: [&str; 9] = ["sin_cos", "atan2", "exp", "ln", "tanh", "pow", "hypot", "tan", "erf"];

#[inline(always)]
fn function<T: Real, const FUNCTION: usize>(x: T) -> T {
    match FUNCTION {
        0 => {
            let (s, c) = x.sin_cos();
            s + c
        }
        1 => x.atan2(T::of(1.25)),
        2 => x.exp(),
        3 => (x * x).ln(),
        4 => x.tanh(),
        5 => x.abs().pow(T::of(1.7)),
        6 => x.hypot(T::of(0.6)),
        7 => x.tan(),
        _ => x.erf(),
    }
}

impl<E: Element, const FUNCTION: usize> Job<E> for Apply<'_, E, FUNCTION> {
    type Output = ();

    #[inline(always)]
    fn run<P: Pack<Element = E>>(self) {
        for (x, out) in self.x.chunks_exact(P::WIDTH).zip(self.out.chunks_exact_mut(P::WIDTH)) {
            function::<P, FUNCTION>(P::load(x)).store(out);
        }
    }
}

/// The least time of many passes, in nanoseconds per number.
fn least(mut pass: impl FnMut()) -> f64 {
    let once = |pass: &mut dyn FnMut()| {
        let start = Instant::now();
        (0..20).for_each(|_| pass());
        start.elapsed().as_nanos() as f64 / (20 * NUMBERS) as f64
    };
    (0..60).map(|_| once(&mut pass)).fold(f64::INFINITY, f64::min)
}

fn row<E: Element, const FUNCTION: usize>() {
    let x: Vec<E> = (0..NUMBERS).map(|i| E::of((i as f64 * 0.618).fract() * 6.0 - 3.0)).collect();
    let mut out = vec![E::zero(); NUMBERS];
    let platform = least(|| {
        for (&x, out) in black_box(&x).iter().zip(&mut out) {
            *out = function::<E, FUNCTION>(x);
        }
        black_box(&mut out);
    });
    print!("{:>8} {platform:>9.2}", FUNCTIONS[FUNCTION]);
    for set in InstructionSet::ALL {
        if set.available() {
            let time = least(|| {
                let _ = set.run(Apply::<E, FUNCTION> { x: black_box(&x), out: black_box(&mut out) });
            });
            print!(" {time:>9.2}");
        }
    }
    println!();
}

fn table<E: Element>(precision: &str) {
    print!("{precision:>8}  platform");
    for set in InstructionSet::ALL.into_iter().filter(|set| set.available()) {
        print!(" {:>9}", format!("{set:?}"));
    }
    println!();
    row::<E, 0>();
    row::<E, 1>();
    row::<E, 2>();
    row::<E, 3>();
    row::<E, 4>();
    row::<E, 5>();
    row::<E, 6>();
    row::<E, 7>();
    row::<E, 8>();
}

fn main() {
    table::<f64>("f64");
    table::<f32>("f32");
}
