//! A continuous model as a map: its drift, or one Euler step of it; its diffusion beside it where that moves with x.

use super::map::Diffusing;
use super::{At, Linear, Map, Sde, linear_by_duals, linear_scratch};
use crate::scalar::Real;

/// x ↦ f(x), or x ↦ x + δ f(x) with δ = [`At::dt`]; below it, if wanted, the entries of G(x) row by row.
#[derive(Clone, Copy, Debug)]
pub struct Flow<'a, M> {
    /// The model.
    pub model: &'a M,
    /// The Euler step in place of the drift.
    pub step: bool,
    /// G below.
    pub diffusion: bool,
}

/// Scalars of scratch of the map: n states, `below` them so many entries of a diffusion, `beside` controls and parameters;
/// `drift` is the model's own.
pub(crate) const fn flow_scratch(n: usize, below: Option<usize>, beside: usize, drift: usize) -> usize {
    let own = match below {
        None => 0,
        Some(entries) => {
            let (points, linear) = (n.saturating_add(entries), linear_scratch(n, entries, beside));
            if points > linear { points } else { linear }
        }
    };
    if own > drift { own } else { drift }
}

impl<M: Sde> Flow<'_, M> {
    fn entries(&self) -> usize {
        if self.diffusion { self.model.states() * self.model.noises() } else { 0 }
    }
}

impl<M: Sde> Map for Flow<'_, M> {
    fn outputs(&self) -> usize {
        self.model.states() + self.entries()
    }

    fn serves_packs(&self) -> bool {
        self.model.serves_packs()
    }

    fn scratch(&self, points: usize) -> usize {
        let beside = self.model.controls() + self.model.parameters().len();
        let below = self.diffusion.then(|| self.entries());
        flow_scratch(self.model.states(), below, beside, self.model.drift_scratch(points))
    }

    #[inline(always)]
    fn points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        let (f, g) = out.split_at_mut(self.model.states() * points);
        self.model.drift_points(at, points, x, f, scratch);
        if self.step {
            for (f, &x) in f.iter_mut().zip(x) {
                *f = at.dt.mul_add(*f, x);
            }
        }
        if self.diffusion {
            let (n, entries) = (self.model.states(), self.entries());
            super::points_one_by_one(n, entries, at, points, x, g, scratch, &Diffusing(self.model));
        }
    }

    #[inline(always)]
    fn linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let n = x.len();
        let (f, g) = out.split_at(n);
        let stride = f.stride;
        self.model.drift_linear(
            at,
            x,
            s,
            Linear { value: &mut *f.value, image: &mut *f.image, stride },
            scratch,
        );
        if self.step {
            for i in 0..n {
                f.value[i] = at.dt.mul_add(f.value[i], x[i]);
                for (f, &s) in f.image[i * stride..][..n].iter_mut().zip(&s[i * n..]) {
                    *f = at.dt.mul_add(*f, s);
                }
            }
        }
        if self.diffusion {
            linear_by_duals(self.entries(), at, x, s, g, scratch, &Diffusing(self.model));
        }
    }
}
