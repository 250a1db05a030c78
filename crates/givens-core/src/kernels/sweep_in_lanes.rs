//! The same sweep of one matrix of `f64`, several rows side by side in the lanes of packs.

use super::rotations::{PACKS, Rotations, rotations_scratch};
use super::side_by_side::{gather, scatter};
use crate::scalar::{Grain, Job, LANES, NARROW, Pack, Real, floats_mut};

/// The fewest columns of S for which that pays, by measurement.
const FEWEST: usize = 12;

/// Scalars of scratch of [`sweep`](super::sweep()): 2 n where n is small, or where there are no packs.
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

#[cfg(test)]
mod tests {
    use super::{FEWEST, LANES, NARROW, sweep_in_lanes, sweep_scratch};

    /// How many rows are absorbed of [L D; 0 S], given L and D.
    fn absorbed(d: usize, n: usize, of: impl Fn(usize, usize) -> f64) -> usize {
        let size = d + n;
        let below = |i: usize, j: usize| f64::from(i == j);
        let at = |i: usize, j: usize| if i < d { of(i, j) } else { below(i, j) };
        let mut a: Vec<f64> = (0..size * size).map(|k| at(k / size, k % size)).collect();
        let more = |spare| vec![0.0; sweep_scratch(d, n) + spare];
        let mut again = a.clone();
        let absorbed = sweep_in_lanes(&mut a, d, n, &mut more(0));
        assert_eq!(
            sweep_in_lanes(&mut again, d, n, &mut more(7)),
            absorbed,
            "with more scratch than it takes"
        );
        absorbed
    }

    #[test]
    fn a_machine_with_registers_absorbs_all_rows_in_them() {
        if LANES == 1 || !NARROW.available() {
            return;
        }
        for (d, n) in [(1, FEWEST), (2, FEWEST), (5, 20), (8, 13), (9, 30), (20, 33)] {
            for unit in [1.0, 2_f64.powi(-350), 2_f64.powi(350)] {
                let of = |i: usize, j: usize| match (j < d, i == j) {
                    (true, true) => 2.0 * unit,
                    (true, false) if j > i => 0.0,
                    _ => unit * crate::scalar::Real::sin((7 * i + 3 * j + i * j) as f64),
                };
                assert_eq!(absorbed(d, n, of), d, "{d}, {n} in {unit:e}");
            }
        }
    }

    #[test]
    fn few_columns_take_two_scalars_each() {
        assert_eq!(sweep_scratch(5, FEWEST - 1), 2 * (FEWEST - 1));
    }

    #[test]
    fn a_row_stops_it_of_which_nothing_is_left() {
        if LANES == 1 || !NARROW.available() {
            return;
        }
        for (d, n) in [(8, 20), (20, 13)] {
            for lost in [1, 2, d - 1] {
                // L is the unit matrix but for row `lost`, of which the first column has 1 and its own what is left
                let stops = |left: f64| {
                    absorbed(d, n, |i, j| match (i == lost, i == j) {
                        (true, true) => left,
                        (true, false) => f64::from(j == 0),
                        (false, own) => f64::from(own),
                    })
                };
                let bound = (d + n) as f64 * f64::EPSILON;
                assert_eq!((stops(0.5 * bound), stops(2.0 * bound)), (lost, d), "{lost} of {d}, {n}");
            }
        }
    }
}
