//! The same sweep of one matrix of `f64`, several rows side by side in the lanes of packs.

use super::rotations::{PACKS, Rotations, rotations_scratch};
use super::side_by_side::{gather, scatter};
use crate::scalar::{Grain, Job, LANES, NARROW, Pack, Real, floats_mut};

/// The fewest columns of S for which that pays, by measurement.
const FEWEST: usize = 12;

/// Scalars of scratch of [`sweep`](super::sweep()).
#[must_use]
pub const fn sweep_scratch(d: usize, n: usize) -> usize {
    if n < FEWEST || LANES == 1 {
        return n.saturating_mul(2);
    }
    let lanes = d.saturating_add(n).saturating_mul(PACKS * LANES);
    rotations_scratch(d, n).saturating_add(lanes)
}

/// [`sweep`](super::sweep()) of `f64`, where the machine has registers for packs and n is not too small for them: the number
/// of rows of D that are absorbed. The next one has nothing left, or numbers too far
/// apart.
#[inline(always)]
pub(super) fn sweep_in_lanes<T: Real>(a: &mut [T], d: usize, n: usize, scratch: &mut [T]) -> usize {
    if !Grain::is_double::<T>() || LANES == 1 || n < FEWEST {
        return 0;
    }
    sweep_f64(floats_mut(a), d, n, floats_mut(scratch))
}

#[inline(never)]
fn sweep_f64(a: &mut [f64], d: usize, n: usize, scratch: &mut [f64]) -> usize {
    if scratch.len() < sweep_scratch(d, n) {
        return 0;
    }
    let (rotations, lanes) = scratch.split_at_mut(rotations_scratch(d, n));
    let job = Sweep { a, rotations: Rotations::none(d, n, rotations), lanes, d, n };
    NARROW.run_in_registers(job).unwrap_or(0)
}

struct Sweep<'a> {
    a: &'a mut [f64],
    rotations: Rotations<'a>,
    lanes: &'a mut [f64],
    d: usize,
    n: usize,
}

impl Job<f64> for Sweep<'_> {
    type Output = usize;
    const AVX512: bool = false;
    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) -> usize {
        let Self { a, mut rotations, lanes, d, n } = self;
        let (size, side) = (d + n, PACKS * P::WIDTH);
        let (above, below) = a.split_at_mut(d * size);
        // the rows of D find the rotations, some rows at a time: first turned by all rotations so far, then one by one
        let mut going = true;
        for first in (0..d).step_by(side) {
            let rows = &mut above[first * size..];
            let height = side.min(d - first);
            gather(rows, size, height, lanes, 0..size, side);
            rotations.turn::<P>(lanes, d, n);
            let mut absorbed = 0;
            while going && absorbed < height {
                let q = first + absorbed;
                going = rotations.absorb::<P>(lanes, d, absorbed);
                if going {
                    let done = &mut rows[absorbed * size..][..size];
                    for (to, from) in done.iter_mut().zip(lanes.chunks_exact(side)).take(q) {
                        *to = from[absorbed];
                    }
                    done[q] = rotations.pivot();
                    done[d..].fill(0.0);
                    rotations.turn_by_last::<P>(lanes, d);
                    absorbed += 1;
                }
            }
            scatter(rows, size, lanes, absorbed, height, size, side);
        }
        // then the rows of each S, of which all rotations are known, as far as their triangle reaches
        for s in below.chunks_exact_mut(n * size) {
            for first in (0..n).step_by(side) {
                let rows = &mut s[first * size..];
                let height = side.min(n - first);
                let reach = first + height;
                lanes[..d * side].fill(0.0);
                gather(rows, size, height, lanes, d..d + reach, side);
                rotations.turn::<P>(lanes, d, reach);
                scatter(rows, size, lanes, 0, height, d + reach, side);
            }
        }
        rotations.done
    }
}
