//! What moves the moments of a continuous model: the mean of its drift, the part of the drift that moves with x, and a
//! root of the diffusion.

use super::noise::{check_spread, diffusion};
use crate::filter::error::Fault;
use crate::filter::memory::take;
use crate::filter::sizes::Sizes;
use crate::model::{
    At, Flow, Map, SLACK, Sde, Varies, drift_scratch, flow_scratch, scratch_for, side_by_side_scratch,
};
use crate::rule::{Rule, Shape, Spread};
use crate::scalar::Real;

/// E\[f\], D and N with Cov\[f, x\] = D Sᵀ and E\[G Gᵀ\] = N J Nᵀ.
pub(super) struct Imaged<'a, T> {
    /// E\[f\], length n.
    pub velocity: &'a mut [T],
    /// D, n × n.
    pub dev: &'a mut [T],
    /// N, n × columns, the negative ones last.
    pub noise: &'a mut [T],
}

/// How the drift is averaged over a belief.
pub(super) trait Image: Copy {
    /// D depends on S by D = J S alone, and N not at all: the image may be asked for J itself.
    fn first_order(&self) -> bool;
    /// Length n of the state.
    fn states(&self) -> usize;
    /// Columns of N, of positive and of negative weight.
    fn noises(&self) -> (usize, usize);
    /// Scalars of scratch.
    fn scratch(&self) -> usize;
    /// Evaluates them at N(`mean`, S Sᵀ), S = `factor`.
    fn image<T: Real>(
        &self,
        at: &At<T>,
        table: &[T],
        mean: &[T],
        factor: &[T],
        out: &mut Imaged<T>,
        scratch: &mut [T],
    ) -> Result<(), Fault>;
    /// N alone, at the same.
    fn noise<T: Real>(
        &self,
        at: &At<T>,
        table: &[T],
        mean: &[T],
        factor: &[T],
        noise: &mut [T],
        scratch: &mut [T],
    ) -> Result<(), Fault>;
}

/// By a rule.
pub(super) struct ByRule<'a, M, R> {
    pub model: &'a M,
    pub rule: &'a R,
}

impl<M, R> Clone for ByRule<'_, M, R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M, R> Copy for ByRule<'_, M, R> {}

/// Columns of N, of positive and of negative weight.
pub(super) fn by_rule_noises<M: Sde>(model: &M, shape: Shape) -> (usize, usize) {
    let (n, q) = (model.states(), model.noises());
    if flow(model).diffusion { (q * (1 + n + shape.plus), q * shape.minus) } else { (q, 0) }
}

/// Scalars of scratch of the image by a rule of this shape.
pub(super) fn by_rule_scratch<M: Sde>(model: &M, shape: Shape) -> usize {
    let map = flow(model);
    let beside = model.controls() + model.parameters().len();
    let map_scratch = scratch_for(|points| map.scratch(points), shape.points, beside);
    image_scratch(model.states(), map.outputs(), shape, map_scratch)
}

const fn image_scratch(n: usize, outputs: usize, shape: Shape, map: usize) -> usize {
    let columns = n.saturating_add(shape.plus).saturating_add(shape.minus).saturating_add(1);
    let points = shape.points.saturating_add(SLACK);
    let spread = n.saturating_add(outputs).saturating_mul(points).saturating_add(map).saturating_add(SLACK);
    // the first two are for the noise alone, which is asked for with its own mean and D
    let alone = n.saturating_add(1).saturating_mul(n);
    outputs.saturating_mul(columns).saturating_add(spread).saturating_add(alone)
}

/// The sizes with scratch for a model that overrides no provided method, whose diffusion reads the state or not.
pub(super) const fn by_rule_sizes(sizes: Sizes, shape: Shape, with_state: bool) -> Sizes {
    let (n, q, beside) = (sizes.states, sizes.process_noise, sizes.beside());
    let drift = drift_scratch(n, beside);
    if !with_state {
        let map = flow_scratch(n, None, beside, drift);
        let map = side_by_side_scratch(map, map, beside);
        return sizes.with_model_scratch(image_scratch(n, n, shape, map));
    }
    let entries = n.saturating_mul(q);
    let map = flow_scratch(n, Some(entries), beside, drift);
    let map = side_by_side_scratch(map, map, beside);
    let columns = n.saturating_add(shape.plus).saturating_add(shape.minus).saturating_add(1);
    let sizes = sizes.with_model_scratch(image_scratch(n, n.saturating_add(entries), shape, map));
    Sizes { process_noise: q.saturating_mul(columns), ..sizes }
}

/// The drift, and the diffusion below it if the state moves it.
fn flow<M: Sde>(model: &M) -> Flow<'_, M> {
    Flow { model, step: false, diffusion: model.diffusion_varies() == Varies::WithState }
}

impl<'a, M: Sde, R: Rule> ByRule<'a, M, R> {
    fn flow(&self) -> Flow<'a, M> {
        flow(self.model)
    }

    fn shape(&self) -> Shape {
        self.rule.shape(self.model.states())
    }
}

impl<M: Sde, R: Rule> Image for ByRule<'_, M, R> {
    fn first_order(&self) -> bool {
        R::FIRST_ORDER && !self.flow().diffusion
    }

    fn states(&self) -> usize {
        self.model.states()
    }

    fn noises(&self) -> (usize, usize) {
        by_rule_noises(self.model, self.shape())
    }

    fn scratch(&self) -> usize {
        by_rule_scratch(self.model, self.shape())
    }

    #[inline(always)]
    fn image<T: Real>(
        &self,
        at: &At<T>,
        table: &[T],
        mean: &[T],
        factor: &[T],
        out: &mut Imaged<T>,
        mut scratch: &mut [T],
    ) -> Result<(), Fault> {
        let (n, q, shape, map) = (mean.len(), self.model.noises(), self.shape(), self.flow());
        // without a diffusion that moves, D is all that is asked for
        let stride = if map.diffusion { n + shape.plus } else { n };
        let (outputs, lost) = (map.outputs(), shape.minus);
        let average = take(&mut scratch, outputs);
        let dev = take(&mut scratch, outputs * stride);
        let minus = take(&mut scratch, outputs * lost);
        let mut spread = Spread { mean: average, dev, stride, minus };
        self.rule.spread(table, &map, at, mean, factor, &mut spread, scratch);
        check_spread(&spread, stride, [n, q], shape.points)?;
        out.velocity.copy_from_slice(&spread.mean[..n]);
        for (to, from) in out.dev.chunks_exact_mut(n).zip(spread.dev.chunks_exact(stride)) {
            to.copy_from_slice(&from[..n]);
        }
        if !map.diffusion {
            return diffusion(self.model, at, mean, out.noise);
        }
        let (plus, minus) = self.noises();
        for i in 0..n {
            let row = &mut out.noise[i * (plus + minus)..][..plus + minus];
            row[..q].copy_from_slice(&spread.mean[n + i * q..][..q]);
            for j in 0..q {
                let from = n + i * q + j;
                row[q + j * stride..][..stride].copy_from_slice(&spread.dev[from * stride..][..stride]);
                row[plus + j * lost..][..lost].copy_from_slice(&spread.minus[from * lost..][..lost]);
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn noise<T: Real>(
        &self,
        at: &At<T>,
        table: &[T],
        mean: &[T],
        factor: &[T],
        noise: &mut [T],
        scratch: &mut [T],
    ) -> Result<(), Fault> {
        if !self.flow().diffusion {
            return diffusion(self.model, at, mean, noise);
        }
        let n = mean.len();
        let (velocity, rest) = scratch.split_at_mut(n);
        let (dev, rest) = rest.split_at_mut(n * n);
        self.image(at, table, mean, factor, &mut Imaged { velocity, dev, noise }, rest)
    }
}
