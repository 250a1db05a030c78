//! The Itô–Taylor expansion of order 1.5 of a continuous model, as a map (docs/algorithms.md C4).

use super::{At, Linear, Map, Sde};
use crate::scalar::{Dual2, Real, as_duals};

/// x ↦ f_d(x) = x + δ f + (δ²/2) L₀f with δ = [`At::dt`], taken `times` times in a row; below it, if wanted, the
/// entries of Lf (row i q + j: component i along noise j) at the start of the last step.
#[derive(Clone, Copy, Debug)]
pub struct Expanded<'a, M> {
    /// The model.
    pub model: &'a M,
    /// How many steps.
    pub times: usize,
    /// Lf below.
    pub noise: bool,
}

/// Scalars of scratch of the map: n states, q noises, `beside` controls and parameters, Lf below or not; `expansion` is the
/// model's own for all points, and for one.
pub(crate) const fn expanded_scratch(
    [n, q, beside]: [usize; 3],
    noise: bool,
    points: usize,
    expansion: [usize; 2],
) -> usize {
    let arrays = n.saturating_add(n);
    let outputs = if noise { n.saturating_mul(q).saturating_add(n) } else { n };
    let all = arrays.saturating_mul(points).saturating_add(expansion[0]);
    let one = arrays.saturating_add(expansion[1]);
    let duals = one.saturating_add(n).saturating_add(outputs).saturating_add(beside).saturating_mul(3);
    if all > duals { all } else { duals }
}

impl<M: Sde> Map for Expanded<'_, M> {
    fn outputs(&self) -> usize {
        let n = self.model.states();
        n + if self.noise { n * self.model.noises() } else { 0 }
    }

    fn serves_packs(&self) -> bool {
        self.model.serves_packs()
    }

    fn scratch(&self, points: usize) -> usize {
        let beside = self.model.controls() + self.model.parameters().len();
        let expansion = [points, 1].map(|points| self.model.expansion_scratch(points));
        expanded_scratch([self.model.states(), self.model.noises(), beside], self.noise, points, expansion)
    }

    #[inline(always)]
    fn points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        let all = self.model.states() * points;
        let (next, below) = out.split_at_mut(all);
        let (here, rest) = scratch.split_at_mut(all);
        let (l0, rest) = rest.split_at_mut(all);
        for k in 0..self.times {
            let at = At { t: at.t + T::of(k as f64) * at.dt, ..*at };
            let from = if k == 0 { x } else { &*here };
            // only what stands below is wanted of Lf
            let lf = if self.noise { &mut *below } else { &mut [] };
            self.model.expansion_points(&at, points, from, next, l0, lf, rest);
            let half = T::of(0.5) * at.dt;
            for ((f, &l0), &x) in next.iter_mut().zip(&*l0).zip(from) {
                *f = at.dt.mul_add(half.mul_add(l0, *f), x);
            }
            if k + 1 < self.times {
                here.copy_from_slice(next);
            }
        }
    }

    /// By nested derivatives: the expansion's own, of third order in the drift.
    #[inline(always)]
    fn linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let (n, d, stride) = (x.len(), self.outputs(), out.stride);
        let (point, rest) = as_duals(scratch).split_at_mut(n);
        let (image, rest) = rest.split_at_mut(d);
        let (u, rest) = rest.split_at_mut(at.u.len());
        let (p, rest) = rest.split_at_mut(at.p.len());
        for (dual, &v) in u.iter_mut().zip(at.u).chain(p.iter_mut().zip(at.p)) {
            *dual = Dual2::constant(v);
        }
        let at = At { t: Dual2::constant(at.t), dt: Dual2::constant(at.dt), u, p };
        for j in 0..n {
            for i in 0..n {
                point[i] = Dual2::along(x[i], s[i * n + j]);
            }
            self.points(&at, 1, point, image, rest);
            for i in 0..d {
                out.image[i * stride + j] = image[i].d;
                out.value[i] = image[i].v;
            }
        }
    }
}
