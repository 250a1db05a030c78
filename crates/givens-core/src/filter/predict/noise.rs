//! The noise of a continuous step beside the image of the state: [D E N], N of columns that are known and of columns
//! that the rule has spread.

use super::settle::{Moved, settle, settle_scratch};
use crate::filter::backward::Backward;
use crate::filter::error::Fault;
use crate::filter::form::{Belief, Form};
use crate::filter::memory::{larger, put_columns, take, whole_packs};
use crate::filter::quantity::Quantity;
use crate::kernels::wild_row;
use crate::model::{At, Map, Sde, Varies};
use crate::rule::{Rule, Shape, Spread, spread_scratch};
use crate::scalar::{Dual2, Mask, Real, as_duals};

/// [D E N] in the making. Columns of N that are zero are left out: they would cost as much as others.
pub(super) struct Stacked<'a, T: Real> {
    /// m⁻, and below it the mean of the entries of an n × q matrix that multiplies the noise, if it moves with the state.
    pub mean: &'a mut [T],
    /// How these entries spread, rows of length `width` and `lost`.
    entries: (&'a [T], &'a [T]),
    /// [D E N], n rows.
    dev: &'a mut [T],
    stride: usize,
    /// Columns of [D E], and of [D E N] so far.
    width: usize,
    columns: usize,
    /// The sum of the magnitudes of N: finite if all of it is.
    size: T,
    /// The lanes that have a column of zeros because others have one that is not zero.
    uneven: T::Mask,
    /// The negative columns of E, n rows of `all_lost`, of which the rule's own are the first.
    minus: &'a mut [T],
    lost: usize,
    all_lost: usize,
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
    let apart = if outputs > n { outputs * (width + shape.minus) } else { 0 };
    let own = outputs + n * (stride + times * shape.minus) + apart;
    own + larger(spread_scratch(shape, n, outputs, map), settle_scratch(n, stride, smoothing))
}

impl<'a, T: Real> Stacked<'a, T> {
    /// The image of the belief by a map of the state and, below it, of the entries of an n × q matrix, if it has any; with
    /// room for `known` columns. After a fault the belief is as before.
    #[inline(always)]
    pub fn spread<R: Rule, G: Map>(
        (rule, table): (&R, &[T]),
        map: &G,
        at: &At<T>,
        belief: &Belief<T>,
        [q, known]: [usize; 2],
        scratch: &mut &'a mut [T],
    ) -> Result<Self, Fault> {
        let (n, outputs) = (belief.mean.len(), map.outputs());
        let shape = rule.shape(n);
        let (width, lost) = (n + shape.plus, shape.minus);
        let times = 1 + if outputs > n { q } else { 0 };
        let (stride, all_lost) = (whole_packs(times * width + known), times * lost);
        let mean = take(scratch, outputs);
        let dev = take(scratch, n * stride);
        let minus = take(scratch, n * all_lost);
        let mut entries = (&[] as &[T], &[] as &[T]);
        if outputs == n {
            let mut spread = Spread { mean, dev, stride, minus };
            rule.spread(table, map, at, belief.mean, belief.factor, &mut spread, scratch);
            check_spread(&spread, width, [n, q], shape.points)?;
        } else {
            let (every, away) = (take(scratch, outputs * width), take(scratch, outputs * lost));
            let mut spread = Spread { mean, dev: every, stride: width, minus: away };
            rule.spread(table, map, at, belief.mean, belief.factor, &mut spread, scratch);
            check_spread(&spread, width, [n, q], shape.points)?;
            let (own, below) = every.split_at(n * width);
            let (own_lost, below_lost) = away.split_at(n * lost);
            put_columns(dev, stride, 0, own, width);
            put_columns(minus, all_lost, 0, own_lost, lost);
            entries = (below, below_lost);
        }
        let (size, uneven) = (T::zero(), T::Mask::splat(false));
        Ok(Self { mean, entries, dev, stride, width, columns: width, size, uneven, minus, lost, all_lost })
    }

    /// Adds the columns of a matrix n × q that the state does not move.
    #[inline(always)]
    pub fn known(&mut self, noise: &[T], q: usize) {
        for j in 0..q {
            self.column(|i| noise[i * q + j]);
        }
    }

    /// Adds the spread of the entries of the matrix, each times `scale`.
    #[inline(always)]
    pub fn entries(&mut self, q: usize, scale: T) {
        let ((entries, lost), width) = (self.entries, self.width);
        for j in 0..q {
            for l in 0..width {
                self.column(|i| scale * entries[(i * q + j) * width + l]);
            }
            for (i, row) in self.minus.chunks_exact_mut(self.all_lost.max(1)).enumerate() {
                let away = &mut row[(j + 1) * self.lost..][..self.lost];
                for (to, &x) in away.iter_mut().zip(&lost[(i * q + j) * self.lost..]) {
                    *to = scale * x;
                }
            }
        }
    }

    /// Adds a column unless it is zero in every lane. Where it is in some, these are to be served alone: what is computed of a
    /// lane does not depend on the others.
    #[inline(always)]
    fn column(&mut self, of: impl Fn(usize) -> T) {
        let mut sum = T::zero();
        for (i, row) in self.dev.chunks_exact_mut(self.stride).enumerate() {
            let x = of(i);
            row[self.columns] = x;
            sum += x.abs();
        }
        let nothing = sum.same(T::zero());
        if !nothing.all() {
            self.columns += 1;
            self.uneven = self.uneven | nothing;
        }
        self.size += sum;
    }

    /// Ends the step.
    #[inline(always)]
    pub fn settle<F: Form>(
        self,
        belief: &mut Belief<T>,
        back: Option<&mut Backward<T>>,
        scratch: &mut [T],
    ) -> Result<T::Mask, Fault> {
        let Self { mean, dev, columns, stride, width, size, uneven, minus, all_lost, .. } = self;
        // a power of a long step overflows where no number of the model does
        let endless = !size.finite();
        if endless.all() {
            let is_wild = |row: &[T]| row[width..columns].iter().any(|x| (!x.finite()).all());
            let component = dev.chunks_exact(stride.max(1)).position(is_wild).unwrap_or(0);
            return Err(Fault::NotFinite { quantity: Quantity::Diffusion, component });
        }
        let mean = &mean[..belief.mean.len()];
        let moved = Moved { mean, dev, columns, stride, minus, lost: all_lost };
        Ok(settle::<T, F>(moved, belief, back, scratch)? | endless | uneven)
    }
}

/// The first component of a stacked spread that is not finite, as a fault.
#[inline(always)]
pub(super) fn check_spread<T: Real>(
    spread: &Spread<T>,
    columns: usize,
    [n, q]: [usize; 2],
    points: usize,
) -> Result<(), Fault> {
    match spread.not_finite(columns) {
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
