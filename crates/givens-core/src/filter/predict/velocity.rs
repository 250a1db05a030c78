//! The velocities of the level set (2021): how the drift at the columns of M moves the mean and M itself.

use super::image::{Image, Imaged};
use super::noise::diffusion;
use crate::filter::error::Fault;
use crate::filter::memory::take;
use crate::filter::quantity::Quantity;
use crate::filter::sizes::Sizes;
use crate::kernels::wild_row;
use crate::model::{
    At, Flow, SLACK, Sde, drift_scratch, evaluate_side_by_side, filled, misaligned, scratch_for,
    side_by_side_scratch,
};
use crate::scalar::Real;

/// Which points of the drift are taken, and what is made of them (docs/algorithms.md C11).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Velocity {
    /// v(x̄) and v(x̄ + M) − v(x̄) (2021 eq 43–44).
    Standard,
    /// The average v̄ of all v(x̄ ± M), and v(x̄ + M) − v̄ (2021 eq 48–51).
    AveragedPrinted,
    /// v̄, and central differences: what the paper's own program runs.
    Averaged,
    /// v̄ with one point for all of x̄ − M, the mean column below x̄ (2021 eq 64–65).
    Partial,
    /// The same with the first column in place of the mean one, as eq 64 prints it. Wrong already for a linear drift.
    PartialPrinted,
    /// Central, √n out: the cubature rule along M.
    #[default]
    Cubature,
}

impl Velocity {
    /// The points below x̄ as well as those above.
    const fn both(self) -> bool {
        matches!(self, Velocity::AveragedPrinted | Velocity::Averaged | Velocity::Cubature)
    }

    /// Evaluations of the drift for n states.
    const fn points(self, n: usize) -> usize {
        if self.both() { n.saturating_mul(2) } else { n.saturating_add(1) }
    }
}

/// The drift by a velocity; the table of a rule is not read.
pub(super) struct ByVelocity<'a, M> {
    pub model: &'a M,
    pub velocity: Velocity,
}

impl<M> Clone for ByVelocity<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for ByVelocity<'_, M> {}

/// Scalars of scratch of the image.
pub(super) fn by_velocity_scratch<M: Sde>(model: &M, velocity: Velocity) -> usize {
    let (n, points) = (model.states(), velocity.points(model.states()));
    let beside = model.controls() + model.parameters().len();
    image_scratch(n, points, scratch_for(|points| model.drift_scratch(points), points, beside))
}

const fn image_scratch(n: usize, points: usize, drift: usize) -> usize {
    let points = points.saturating_add(SLACK);
    n.saturating_mul(points).saturating_mul(2).saturating_add(drift).saturating_add(SLACK)
}

/// The sizes with scratch for a model that overrides no provided method.
pub(super) const fn by_velocity_sizes(sizes: Sizes, velocity: Velocity) -> Sizes {
    let n = sizes.states;
    let drift = drift_scratch(n, sizes.beside());
    let drift = side_by_side_scratch(drift, drift, sizes.beside());
    sizes.with_model_scratch(image_scratch(n, velocity.points(n), drift))
}

impl<M: Sde> Image for ByVelocity<'_, M> {
    fn first_order(&self) -> bool {
        false
    }

    fn states(&self) -> usize {
        self.model.states()
    }

    fn noises(&self) -> (usize, usize) {
        (self.model.noises(), 0)
    }

    fn scratch(&self) -> usize {
        by_velocity_scratch(self.model, self.velocity)
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
        let n = mean.len();
        let own = self.velocity.points(n);
        let flow = Flow { model: self.model, step: false, diffusion: false };
        let points = filled::<T, _>(&flow, own);
        let skip = misaligned(scratch);
        let _ = take(&mut scratch, skip);
        let x = take(&mut scratch, n * points);
        let v = take(&mut scratch, n * points);
        let radius = match self.velocity {
            Velocity::Cubature => T::of(n as f64).sqrt(),
            _ => T::one(),
        };
        let share = T::of(1.0 / n as f64);
        for i in 0..n {
            let (row, m) = (&mut x[i * points..(i + 1) * points], &factor[i * n..(i + 1) * n]);
            row[own..].fill(mean[i]);
            for j in 0..n {
                row[j] = radius.mul_add(m[j], mean[i]);
            }
            match self.velocity {
                Velocity::Standard => row[n] = mean[i],
                Velocity::Partial => row[n] = mean[i] - share * total(m),
                Velocity::PartialPrinted => row[n] = mean[i] - m[0],
                _ => {
                    for j in 0..n {
                        row[n + j] = (-radius).mul_add(m[j], mean[i]);
                    }
                }
            }
        }
        evaluate_side_by_side(&flow, at, points, x, v, scratch);
        let half = T::of(0.5);
        for i in 0..n {
            let row = &v[i * points..i * points + own];
            let (plus, rest) = row.split_at(n);
            if wild_row(row, 1).is_some() {
                return Err(Fault::NotFinite { quantity: Quantity::Drift, component: i });
            }
            let velocity = match self.velocity {
                Velocity::Standard => rest[0],
                Velocity::Partial | Velocity::PartialPrinted => half * share.mul_add(total(plus), rest[0]),
                _ => half * share * (total(plus) + total(rest)),
            };
            let dev = &mut out.dev[i * n..(i + 1) * n];
            for j in 0..n {
                dev[j] = match self.velocity {
                    Velocity::Averaged | Velocity::Cubature => half * (plus[j] - rest[j]) / radius,
                    _ => plus[j] - velocity,
                };
            }
            out.velocity[i] = velocity;
        }
        self.noise(at, table, mean, factor, out.noise, scratch)
    }

    #[inline(always)]
    fn noise<T: Real>(
        &self,
        at: &At<T>,
        _: &[T],
        mean: &[T],
        _: &[T],
        noise: &mut [T],
        _: &mut [T],
    ) -> Result<(), Fault> {
        diffusion(self.model, at, mean, noise)
    }
}

/// Σ xᵢ.
#[inline(always)]
fn total<T: Real>(row: &[T]) -> T {
    let mut sum = T::zero();
    for &x in row {
        sum += x;
    }
    sum
}
