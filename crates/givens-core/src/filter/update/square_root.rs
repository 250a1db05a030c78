//! The update in square-root form: [T11 0; T21 T22] = Tria([Z S_R; X 0]), W = T21/T11, m = m⁻ + W ν, S = T22.
//!
//! X = S [I 0], so the same rotations of I give A and B with T21 = S A and T22 = S B: what a smoother needs.

use super::joint::{Below, joint, joint_scratch};
use super::posterior::{Posterior, Rows};
use super::separate::{separate, separate_scratch};
use super::{Block, InnovationMut, Sensed};
use crate::filter::error::{Fault, Matrix};
use crate::filter::form::Belief;
use crate::filter::lanes::split;
use crate::filter::memory::{larger, take};
use crate::filter::quantity::Quantity;
use crate::kernels::{copy_lower, dot, downdate, product_lower};
use crate::scalar::{Mask, Real};

/// Scalars of scratch of [`update`], for `rest` columns of E and noise.
pub(super) const fn square_root_scratch(n: usize, d: usize, rest: usize, smoothing: bool) -> usize {
    let rows = if smoothing { d + 2 * n } else { d + n };
    let block = larger(joint_scratch(n, d, rest), separate_scratch(n, d, rest));
    n * n + 2 * n + (d + n) + rows * (d + n) + block
}

#[inline(always)]
pub(super) fn update<'a, T: Real>(
    by: Block,
    sensed: &Sensed<T>,
    belief: &Belief<T>,
    innovation: &mut InnovationMut<T>,
    learning: bool,
    mut scratch: &'a mut [T],
) -> Result<(Posterior<'a, T>, T::Mask), Fault> {
    let (n, d) = (belief.mean.len(), sensed.d);
    let size = d + n;
    let below = match (by, sensed.lost, learning) {
        (Block::Joint, 0, false) => Below::State,
        (Block::Joint, 0, true) => Below::Both,
        _ => Below::Unit,
    };
    let factor = take(&mut scratch, if below == Below::Unit { n * n } else { 0 });
    let mean = take(&mut scratch, n);
    let moved = take(&mut scratch, n);
    let column = take(&mut scratch, size);
    let block = take(&mut scratch, (size + if below == Below::Both { n } else { 0 }) * size);
    let mut sick = match by {
        Block::Joint => joint(block, below, sensed, n, belief.factor, scratch),
        Block::Separate => separate(block, sensed, scratch),
    };
    for k in 0..sensed.lost {
        column.fill(T::zero());
        for (v, row) in column.iter_mut().zip(sensed.minus.chunks_exact(sensed.lost)).take(d) {
            *v = row[k];
        }
        sick = sick | split(downdate(block, size, size, column), d, Matrix::Innovation, Matrix::Posterior)?;
    }
    sick = sick | pivots(block, size, &innovation.predicted[..d])?;
    copy_lower(innovation.factor, d, block, size);
    innovation.whiten(block, size, d)?;

    let block = &*block;
    let top = Rows { of: &block[d * size..], stride: size };
    let turn = Rows { of: &block[block.len() - n * size..], stride: size };
    let white = &innovation.white[..d];
    if below != Below::State {
        for (i, x) in moved.iter_mut().enumerate() {
            *x = dot(turn.row(i, d), white);
        }
    }
    let b = Rows { of: &turn.of[d..], stride: size };
    let posterior = if below == Below::Unit {
        belief.advanced(moved, mean);
        factor.copy_from_slice(belief.factor);
        product_lower(factor, n, n, b.of, size);
        Rows { of: factor, stride: n }
    } else {
        for (i, (to, &m)) in mean.iter_mut().zip(&*belief.mean).enumerate() {
            *to = m + dot(top.row(i, d), white);
        }
        Rows { of: &top.of[d..], stride: size }
    };
    let learnt = if learning { Some((&*moved, b)) } else { None };
    Ok((Posterior { mean, factor: posterior, cov: &[], learnt }, sick))
}

/// The innovation covariance must have every pivot: it is divided by. One below the spacing of numbers at the predicted
/// measure is none; of one that has overflowed, the measurement would be nothing.
#[inline(always)]
pub(super) fn pivots<T: Real>(root: &[T], stride: usize, predicted: &[T]) -> Result<T::Mask, Fault> {
    let mut sick = T::Mask::splat(false);
    for (i, z) in predicted.iter().enumerate() {
        let pivot = root[i * stride + i];
        let zero = !(T::of(T::EPSILON) * z.abs()).lt(pivot);
        if zero.all() {
            return Err(Fault::SingularInnovation { measure: i });
        }
        let endless = !pivot.finite();
        if endless.all() {
            return Err(Fault::NotFinite { quantity: Quantity::Innovation, component: i });
        }
        sick = sick | zero | endless;
    }
    Ok(sick)
}
