//! The same triangularisation of one matrix of `f64`, its rows in packs.

use super::plus_dot;
use super::tria_panels::Panels;
use crate::scalar::{Grain, Job, LANES, LaneMask, NARROW, Pack, Real, floats_mut};

/// The longest row that is kept in packs while it is reflected: longer ones go faster four reflections at a time, by measurement.
const LONGEST: usize = 12;

/// The most rows.
const TALLEST: usize = 32;

/// [`tria`](super::tria()) of `f64`, where the machine has registers for packs, and the rows are neither too short nor too
/// long for them and end in room for a whole pack: the number of rows that are done. Those below are reflected by them, and
/// the next one has nothing left.
#[inline(always)]
pub(super) fn tria_in_packs<T: Real>(a: &mut [T], rows: usize, columns: usize, stride: usize) -> usize {
    let one = matches!(Grain::of::<T>(), Some(Grain { set: None, depth: 0 }));
    if !one || LANES == 1 {
        return 0;
    }
    tria_f64(floats_mut(a), rows, columns, stride)
}

#[inline(never)]
fn tria_f64(a: &mut [f64], rows: usize, columns: usize, stride: usize) -> usize {
    let packs = columns.div_ceil(LANES);
    if columns == 0 || packs * LANES > stride || a.len() < rows * stride {
        return 0;
    }
    if packs > LONGEST || rows > TALLEST {
        return NARROW.run_in_registers(Panels { a, rows, columns, stride }).unwrap_or(0);
    }
    NARROW.run_in_registers(Matrix { a, rows, columns, stride }).unwrap_or(0)
}

struct Matrix<'a> {
    a: &'a mut [f64],
    rows: usize,
    columns: usize,
    stride: usize,
}

impl Job<f64> for Matrix<'_> {
    type Output = usize;
    const AVX512: bool = false;
    /// While a reflection goes over the rows below, it takes the products that the next one needs: each row is read once.
    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) -> usize {
        let Self { a, rows, columns, stride } = self;
        let packs = columns.div_ceil(P::WIDTH);
        for row in a.chunks_exact_mut(stride).take(rows) {
            row[columns..packs * P::WIDTH].fill(0.0);
        }
        let bound = columns as f64 * f64::EPSILON;
        // row i from its head on, and its products with itself and with the rows below
        let (mut v, mut next) = ([P::zero(); LONGEST], [P::zero(); LONGEST]);
        let mut along = [0.0; TALLEST];
        for (v, x) in v.iter_mut().zip(a.chunks_exact(P::WIDTH).take(packs)) {
            *v = P::load(x);
        }
        for (along, row) in along.iter_mut().zip(a.chunks_exact(stride).take(rows)) {
            *along = dot(&v[..packs], &row[..packs * P::WIDTH]);
        }
        for i in 0..rows {
            if i >= columns {
                return i;
            }
            let (above, below) = a.split_at_mut((i + 1) * stride);
            let row = &mut above[i * stride..];
            let (first, lane) = (i / P::WIDTH, i % P::WIDTH);
            let rest = along[i];
            if rest <= bound * bound * (plus_dot(0.0, &row[..i], &row[..i]) + rest) {
                return i;
            }
            let norm = rest.sqrt();
            let head = row[i];
            let toward = norm.copysign(head);
            let scale = -(norm * (norm + head.abs())).recip();
            let flip = -1.0_f64.copysign(head);
            row[i] = norm;
            row[i + 1..].fill(0.0);
            let (v, next) = (&mut v[first..packs], &mut next[first..packs]);
            v[0] = v[0].with_lane(lane, head + toward);
            let mut lower = below.chunks_exact_mut(stride).take(rows - i - 1).zip(&mut along[i + 1..]);
            let Some((x, product)) = lower.next() else { break };
            let x = &mut x[first * P::WIDTH..packs * P::WIDTH];
            let by = P::splat(toward.mul_add(x[lane], *product) * scale);
            for ((to, &v), x) in next.iter_mut().zip(&*v).zip(x.chunks_exact_mut(P::WIDTH)) {
                *to = by.mul_add(v, P::load(x));
                to.store(x);
            }
            x[lane] *= flip;
            let left = P::Mask::of_bits(u32::MAX << lane << 1);
            next[0] = P::select(left, next[0], P::zero());
            *product = dot(next, x);
            for (x, product) in lower {
                let x = &mut x[first * P::WIDTH..packs * P::WIDTH];
                let by = P::splat(toward.mul_add(x[lane], *product) * scale);
                let mut sum = P::zero();
                for ((&next, &v), x) in next.iter().zip(&*v).zip(x.chunks_exact_mut(P::WIDTH)) {
                    let moved = by.mul_add(v, P::load(x));
                    moved.store(x);
                    sum = next.mul_add(moved, sum);
                }
                x[lane] *= flip;
                *product = sum.sum();
            }
            v.copy_from_slice(next);
        }
        rows
    }
}

/// Σ v x.
#[inline(always)]
fn dot<P: Pack<Element = f64>>(v: &[P], x: &[f64]) -> f64 {
    let mut sum = P::zero();
    for (&v, x) in v.iter().zip(x.chunks_exact(P::WIDTH)) {
        sum = v.mul_add(P::load(x), sum);
    }
    sum.sum()
}
