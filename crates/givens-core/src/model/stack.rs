//! Several sensors are one: a tuple of observations stacks their measures in order.

use super::{At, Linear, Noise, Observation};
use crate::kernels::Health;
use crate::scalar::Real;

/// Copies a d × `from` matrix into the top left of rows of length `to`, last row first, and clears the rest.
#[inline(always)]
fn widen<T: Real>(block: &mut [T], d: usize, from: usize, to: usize) {
    for i in (0..d).rev() {
        for j in (0..to).rev() {
            block[i * to + j] = if j < from { block[i * from + j] } else { T::zero() };
        }
    }
}

impl<A: Observation, B: Observation> Observation for (A, B) {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn measures(&self) -> usize {
        self.0.measures() + self.1.measures()
    }
    fn angle(&self, i: usize) -> Option<f64> {
        let first = self.0.measures();
        if i < first { self.0.angle(i) } else { self.1.angle(i - first) }
    }
    fn controls(&self) -> usize {
        self.0.controls().max(self.1.controls())
    }
    fn parameters(&self) -> usize {
        self.0.parameters().max(self.1.parameters())
    }
    fn serves_packs(&self) -> bool {
        self.0.serves_packs() && self.1.serves_packs()
    }
    #[inline(always)]
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let (a, b) = out.split_at_mut(self.0.measures());
        self.0.observe(at, x, a);
        self.1.observe(at, x, b);
    }
    /// A root: the roots of both, side by side on the diagonal.
    fn noise(&self) -> Noise {
        let columns = self.0.noise().columns(self.0.measures()) + self.1.noise().columns(self.1.measures());
        Noise::Root(columns)
    }
    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        let health = self.noise_root(at, out);
        out[0] = T::select(health.sick, T::of(f64::NAN), out[0]);
    }
    #[inline(always)]
    fn noise_root<T: Real>(&self, at: &At<T>, root: &mut [T]) -> Health<T> {
        let (da, db) = (self.0.measures(), self.1.measures());
        let (qa, qb) = (self.0.noise().columns(da), self.1.noise().columns(db));
        let (a, b) = root.split_at_mut(da * (qa + qb));
        let first = self.0.noise_root(at, &mut a[..da * qa]);
        widen(a, da, qa, qa + qb);
        let second = self.1.noise_root(at, &mut b[..db * qb]);
        widen(b, db, qb, qa + qb);
        for row in b[..db * (qa + qb)].chunks_exact_mut((qa + qb).max(1)) {
            row.rotate_right(qa);
        }
        first.and(second.shifted(da))
    }
    #[inline(always)]
    fn observe_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        let (a, b) = out.split_at_mut(self.0.measures() * points);
        self.0.observe_points(at, points, x, a, scratch);
        self.1.observe_points(at, points, x, b, scratch);
    }
    fn observe_scratch(&self, points: usize) -> usize {
        self.0.observe_scratch(points).max(self.1.observe_scratch(points))
    }
    #[inline(always)]
    fn observe_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let (a, b) = out.split_at(self.0.measures());
        self.0.observe_linear(at, x, s, a, scratch);
        self.1.observe_linear(at, x, s, b, scratch);
    }
}
