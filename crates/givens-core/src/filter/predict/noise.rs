//! The noise of a continuous step beside the image of the state: [D E N], N of columns that are known and of columns
//! that the rule has spread.

use super::settle::{Moved, settle, settle_scratch};
use crate::filter::backward::Backward;
use crate::filter::error::{Fault, Quantity};
use crate::filter::form::{Belief, Form};
use crate::filter::memory::{larger, take, whole_packs};
use crate::kernels::wild_row;
use crate::model::{At, Sde, Varies};
use crate::rule::{Shape, Spread, spread_scratch};
use crate::scalar::{Dual2, Mask, Real, as_duals};

/// The image of a state and, below it, of the entries of an n × q matrix that multiplies the noise: what a rule makes of
/// both, and the columns of noise that do not depend on the state.
pub(super) struct Stacked<'a, T> {
    /// n rows, and n q more if `entries`.
    pub spread: Spread<'a, T>,
    /// Whether the matrix's own spread counts, times this.
    pub entries: Option<T>,
    /// Columns q of the matrix.
    pub q: usize,
    /// The known columns of noise, n rows of `known`.
    pub noise: &'a [T],
    /// Their number.
    pub known: usize,
    /// Negative columns of the rule.
    pub lost: usize,
}

/// Scalars of scratch for n states, q noises, at most `known` known columns, a map of `outputs` outputs with its scratch.
pub(super) const fn stacked_scratch(
    n: usize,
    q: usize,
    known: usize,
    outputs: usize,
    shape: Shape,
    map: usize,
    smoothing: bool,
) -> usize {
    let width = n + shape.plus;
    let times = 1 + if outputs > n { q } else { 0 };
    let stride = whole_packs(times * width + known);
    let own = outputs * (width + shape.minus + 1) + n * known;
    let end = n * stride + n * times * shape.minus + settle_scratch(n, stride, smoothing);
    own + larger(spread_scratch(shape, n, outputs, map), end)
}

/// Puts the columns side by side, those of zeros left out, and ends the step.
#[inline(always)]
pub(super) fn finish<T: Real, F: Form>(
    stacked: Stacked<T>,
    belief: &mut Belief<T>,
    back: Option<&mut Backward<T>>,
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let Stacked { spread, entries, q, noise, known, lost } = stacked;
    let n = belief.mean.len();
    let width = spread.stride;
    // a noise whose entries do not move with the state spreads nothing
    let mut spreads = 0;
    let q_spread = if entries.is_some() { q } else { 0 };
    for j in 0..q_spread {
        spreads += usize::from(moves(&spread, lost, n, q, j));
    }
    let mut kept = 0;
    for j in 0..known {
        kept += usize::from(!empty(noise, known, j));
    }
    let columns = width * (1 + spreads) + kept;
    let stride = whole_packs(columns);
    let all_lost = lost * (1 + spreads);
    let dev = take(&mut scratch, n * stride);
    let minus = take(&mut scratch, n * all_lost);
    let scale = entries.unwrap_or(T::zero());
    for i in 0..n {
        let row = &mut dev[i * stride..(i + 1) * stride];
        row[..width].copy_from_slice(&spread.dev[i * width..(i + 1) * width]);
        minus[i * all_lost..][..lost].copy_from_slice(&spread.minus[i * lost..(i + 1) * lost]);
    }
    let mut column = width;
    for j in 0..known {
        if !empty(noise, known, j) {
            for i in 0..n {
                dev[i * stride + column] = noise[i * known + j];
            }
            column += 1;
        }
    }
    let mut block = 0;
    for j in 0..q_spread {
        if !moves(&spread, lost, n, q, j) {
            continue;
        }
        for i in 0..n {
            let from = n + i * q + j;
            let to = &mut dev[i * stride + width + kept + block * width..][..width];
            for (to, &x) in to.iter_mut().zip(&spread.dev[from * width..]) {
                *to = scale * x;
            }
            let away = &mut minus[i * all_lost + (block + 1) * lost..][..lost];
            for (to, &x) in away.iter_mut().zip(&spread.minus[from * lost..]) {
                *to = scale * x;
            }
        }
        block += 1;
    }
    let mean = &spread.mean[..n];
    settle::<T, F>(Moved { mean, dev, columns, stride, minus, lost: all_lost }, belief, back, scratch)
}

/// Whether the entries of noise `j` move with the state, in any lane: n rows of n × q such entries below those of the state.
#[inline(always)]
fn moves<T: Real>(spread: &Spread<T>, lost: usize, n: usize, q: usize, j: usize) -> bool {
    let width = spread.stride;
    let mut still = T::Mask::splat(true);
    for i in 0..n {
        let row = n + i * q + j;
        for x in spread.dev[row * width..][..width].iter().chain(&spread.minus[row * lost..][..lost]) {
            still = still & x.same(T::zero());
        }
    }
    !still.all()
}

/// Whether column `j` of a matrix of rows of length `stride` is zero in every lane.
#[inline(always)]
fn empty<T: Real>(a: &[T], stride: usize, j: usize) -> bool {
    let mut zero = T::Mask::splat(true);
    for row in a.chunks_exact(stride) {
        zero = zero & row[j].same(T::zero());
    }
    zero.all()
}

/// The first component of a stacked spread that is not finite, as a fault.
#[inline(always)]
pub(super) fn check_spread<T: Real>(
    spread: &Spread<T>,
    n: usize,
    q: usize,
    points: usize,
) -> Result<(), Fault> {
    match spread.not_finite(spread.stride) {
        None => Ok(()),
        Some(component) if component < n => {
            let derived = points == 0 && spread.mean[component].finite().any();
            let quantity = if derived { Quantity::DriftDerivative } else { Quantity::Drift };
            Err(Fault::NotFinite { quantity, component })
        }
        Some(entry) => Err(Fault::NotFinite { quantity: Quantity::Diffusion, component: (entry - n) / q }),
    }
}

/// G, n × q, checked.
#[inline(always)]
pub(super) fn diffusion<T: Real, M: Sde>(model: &M, at: &At<T>, x: &[T], g: &mut [T]) -> Result<(), Fault> {
    model.diffusion(at, x, g);
    match wild_row(g, model.noises()) {
        Some(component) => Err(Fault::NotFinite { quantity: Quantity::Diffusion, component }),
        None => Ok(()),
    }
}

/// Scalars of scratch of [`diffusion_rate`].
pub(super) const fn rate_scratch(n: usize, q: usize, beside: usize) -> usize {
    3 * (n + n * q + beside)
}

/// G to `g` and ∂G/∂t to `rate`, both n × q.
#[inline(always)]
pub(super) fn diffusion_rate<T: Real, M: Sde>(
    model: &M,
    at: &At<T>,
    x: &[T],
    g: &mut [T],
    rate: &mut [T],
    scratch: &mut [T],
) -> Result<(), Fault> {
    if model.diffusion_varies() == Varies::Never {
        rate.fill(T::zero());
        return diffusion(model, at, x, g);
    }
    let (point, rest) = as_duals(scratch).split_at_mut(x.len());
    let (image, rest) = rest.split_at_mut(g.len());
    let (u, rest) = rest.split_at_mut(at.u.len());
    let p = &mut rest[..at.p.len()];
    for (dual, &x) in point.iter_mut().zip(x).chain(u.iter_mut().zip(at.u)).chain(p.iter_mut().zip(at.p)) {
        *dual = Dual2::constant(x);
    }
    let when = At { t: Dual2::variable(at.t), dt: Dual2::constant(at.dt), u, p };
    model.diffusion(&when, point, image);
    for ((g, rate), dual) in g.iter_mut().zip(rate).zip(&*image) {
        (*g, *rate) = (dual.v, dual.d);
    }
    match wild_row(g, model.noises()) {
        Some(component) => Err(Fault::NotFinite { quantity: Quantity::Diffusion, component }),
        None => Ok(()),
    }
}
