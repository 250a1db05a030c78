//! One triangularisation: [T11 0; T21 T22] = Tria([Z S_R; X 0]) (2010 eq 36; 2011 eq 27).

use super::Sensed;
use crate::filter::memory::{larger, put_columns, put_identity, take, whole_packs};
use crate::kernels::{plus_magnitudes, sweep, sweep_scratch, tria};
use crate::scalar::{Mask, Real};

/// Which rows stand below Z in the block.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Below {
    /// X.
    State,
    /// X, then I for the smoother.
    Both,
    /// I alone; the state's rows follow by a product. So a downdate meets no pivot that is zero for want of variance.
    Unit,
}

/// Scalars of scratch of [`joint`], for `rest` columns of E and noise.
pub(super) const fn joint_scratch(n: usize, d: usize, rest: usize) -> usize {
    d * whole_packs(larger(rest, d)) + sweep_scratch(d, n)
}

/// Writes the block, d rows of [T11 0] and those `below`, of length d + n, from the `factor` S of n states. Since
/// X = [S 0], only the rest of Z and S_R
/// need a full triangularisation; a sweep of rotations absorbs D.
#[inline(always)]
pub(super) fn joint<T: Real>(
    block: &mut [T],
    below: Below,
    sensed: &Sensed<T>,
    n: usize,
    factor: &[T],
    mut scratch: &mut [T],
) -> T::Mask {
    let (d, stride) = (sensed.d, sensed.stride);
    let (rest, size) = (stride - n, d + n);
    let wide = whole_packs(larger(rest, d));
    let noise = take(&mut scratch, d * wide);
    for i in 0..d {
        noise[i * wide..][..rest].copy_from_slice(&sensed.dev[i * stride + n..][..rest]);
    }
    let plain = plain(noise, wide, rest, sensed);
    let sick = if plain.all() { T::Mask::splat(false) } else { tria(noise, d, rest, wide).sick & !plain };
    block.fill(T::zero());
    for i in 0..d {
        let row = &mut block[i * size..][..d];
        if !plain.all() {
            row.copy_from_slice(&noise[i * wide..][..d]);
        }
        if plain.any() {
            for x in row.iter_mut() {
                *x = T::select(plain, T::zero(), *x);
            }
            let own = sensed.dev[i * stride + n + sensed.bends + i].abs();
            row[i] = T::select(plain, own, row[i]);
        }
        block[i * size + d..][..n].copy_from_slice(&sensed.dev[i * stride..][..n]);
    }
    if below != Below::Unit {
        put_columns(&mut block[d * size..], size, d, factor, n);
    }
    if below != Below::State {
        let last = block.len() - n * size;
        put_identity(&mut block[last..], size, d, n);
    }
    sick | sweep(block, d, n, scratch).sick
}

/// The lanes in which S_R is diagonal, and E below the rounding of every R_ij: linear measures of independent noise. [E S_R] is
/// then triangular as it stands, but for rounding.
#[inline(always)]
fn plain<T: Real>(noise: &[T], wide: usize, rest: usize, sensed: &Sensed<T>) -> T::Mask {
    let (d, bends) = (sensed.d, sensed.bends);
    let (mut plain, none) = (T::Mask::splat(true), T::Mask::splat(false));
    for (i, row) in noise.chunks_exact(wide).take(d).enumerate() {
        let (bent, root) = row[..rest].split_at(bends);
        let Some(&deviation) = root.get(i) else { return none };
        // of two such rows the product is below ε √(R_ii R_jj)
        let bound = T::of(Real::sqrt(0.01 * T::EPSILON)) * deviation.abs();
        // most measures that are bent show it at once
        if !bent.first().is_none_or(|x| x.abs().le(bound).any()) {
            return none;
        }
        let size = plus_magnitudes(T::zero(), bent);
        let beside = plus_magnitudes(plus_magnitudes(T::zero(), &root[..i]), &root[i + 1..]);
        plain = plain & size.le(bound) & beside.same(T::zero());
        if !plain.any() {
            return none;
        }
    }
    plain
}
