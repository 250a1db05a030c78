//! Continuous-time dynamics.

use super::At;
use super::map::{Drifting, Linear, linear_by_duals, linear_scratch, points_one_by_one, points_scratch};
use crate::scalar::{Dual2, Real, as_duals};

/// What the diffusion G of an [`Sde`] depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Varies {
    /// On nothing that changes between two measurements.
    Never,
    /// On time.
    WithTime,
    /// On the state (and perhaps on time).
    WithState,
}

/// dx = f(x, t) dt + G dβ, β a standard Brownian motion of length q (docs/algorithms.md C1).
///
/// Two bodies are required: the drift and the diffusion. The others follow from them by exact derivatives and are there
/// to be overridden by those who evaluate many points at once faster, or have derivatives at hand.
///
/// ```
/// use givens_core::model::{At, Sde};
/// use givens_core::scalar::Real;
///
/// /// A noisy pendulum: angle and rate.
/// struct Pendulum;
/// impl Sde for Pendulum {
///     fn states(&self) -> usize { 2 }
///     fn noises(&self) -> usize { 1 }
///     fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
///         dx[0] = x[1];
///         dx[1] = -T::of(9.81) * x[0].sin();
///     }
///     fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
///         g[0] = T::zero();
///         g[1] = T::of(0.1);
///     }
/// }
/// ```
pub trait Sde {
    /// Length n of the state.
    fn states(&self) -> usize;

    /// Columns q of G.
    fn noises(&self) -> usize;

    /// Number of controls that [`At::u`] brings.
    fn controls(&self) -> usize {
        0
    }

    /// The parameters that [`At::p`] brings, with the values they have unless a filter is given others.
    fn parameters(&self) -> &[f64] {
        &[]
    }

    /// Writes f(x, t) to `dx`; both have length n. [`At::dt`] is not to be used.
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]);

    /// Writes G, n × q row by row, per square root of the unit of time. Where it does not follow the state
    /// ([`diffusion_varies`](Self::diffusion_varies)) it is asked for once for all points.
    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]);

    /// What G depends on. A G that reads the state must say so: a filter refuses to start where it finds out otherwise.
    fn diffusion_varies(&self) -> Varies {
        Varies::WithTime
    }

    /// Whether its functions serve packs, too: the points of a filter in `f64` then go through them side by side. A model that
    /// asks a function of `f64` elsewhere must say no.
    fn serves_packs(&self) -> bool {
        true
    }

    /// Scalars of scratch that the methods below need for `points` points.
    fn drift_scratch(&self, points: usize) -> usize {
        let _ = points;
        drift_scratch(self.states(), self.controls() + self.parameters().len())
    }

    /// The drift at all points at once: `x` and `out` are n × `points`, component by component.
    #[inline(always)]
    fn drift_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        let n = self.states();
        points_one_by_one(n, n, at, points, x, out, scratch, &Drifting(self));
    }

    /// The first-order part: f(x) and J S, with J = ∂f/∂x and `s` = S, n × n.
    #[inline(always)]
    fn drift_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        linear_by_duals(self.states(), at, x, s, out, scratch, &Drifting(self));
    }

    /// Scalars of scratch that [`expansion_points`](Self::expansion_points) needs for `points` points.
    fn expansion_scratch(&self, points: usize) -> usize {
        let (n, beside) = (self.states(), self.controls() + self.parameters().len());
        let _ = points;
        expansion_scratch(n, self.noises(), beside)
    }

    /// The drift and its two Itô derivatives at all points at once, component by component (docs/algorithms.md C2, C3):
    /// f to `f` and L₀f to `l0`, n × `points`; row i q + j of `lf` is component i of Lf = J G along noise j.
    /// Where `lf` is empty, Lf is not wanted. 1 + q evaluations for each point.
    #[inline(always)]
    fn expansion_points<T: Real>(
        &self,
        at: &At<T>,
        points: usize,
        x: &[T],
        f: &mut [T],
        l0: &mut [T],
        lf: &mut [T],
        scratch: &mut [T],
    ) {
        expansion_by_duals(self, at, points, x, f, l0, lf, scratch);
    }
}

/// What [`Sde::drift_scratch`] provides, as a constant; `beside` is the number of controls and parameters together.
pub(crate) const fn drift_scratch(n: usize, beside: usize) -> usize {
    let (points, linear) = (points_scratch(n, n), linear_scratch(n, n, beside));
    if points > linear { points } else { linear }
}

/// Scalars of scratch of [`expansion_by_duals`]; `beside` is the number of controls and parameters together.
#[must_use]
pub const fn expansion_scratch(n: usize, q: usize, beside: usize) -> usize {
    let duals = n.saturating_mul(2).saturating_add(beside).saturating_mul(3);
    n.saturating_mul(q).saturating_add(n).saturating_add(duals)
}

/// States whose duals may stay in registers.
const FEW: usize = 16;

/// The drift and its two Itô derivatives by duals, point after point: what [`Sde::expansion_points`] provides, for
/// models that override it and sometimes cannot do better.
#[inline(always)]
pub fn expansion_by_duals<T: Real, M: Sde + ?Sized>(
    model: &M,
    at: &At<T>,
    points: usize,
    x: &[T],
    f: &mut [T],
    l0: &mut [T],
    lf: &mut [T],
    scratch: &mut [T],
) {
    let (n, q) = (model.states(), model.noises());
    let (g, rest) = scratch.split_at_mut(n * q);
    let (here, rest) = rest.split_at_mut(n);
    let (point, rest) = as_duals(rest).split_at_mut(n);
    let (image, rest) = rest.split_at_mut(n);
    // in arrays of its own, the compiler keeps a point of a model of known length in registers
    let (mut own_point, mut own_image) = ([Dual2::<T>::zero(); FEW], [Dual2::<T>::zero(); FEW]);
    let (point, image) = if n <= FEW { (&mut own_point[..n], &mut own_image[..n]) } else { (point, image) };
    let (u, rest) = rest.split_at_mut(at.u.len());
    let p = &mut rest[..at.p.len()];
    for (dual, &v) in u.iter_mut().zip(at.u).chain(p.iter_mut().zip(at.p)) {
        *dual = Dual2::constant(v);
    }
    let (u, p) = (&*u, &*p);
    let when = |speed: T| At { t: Dual2::along(at.t, speed), dt: Dual2::constant(at.dt), u, p };
    let follows = model.diffusion_varies() == Varies::WithState;
    for k in 0..points {
        for i in 0..n {
            here[i] = x[i * points + k];
        }
        if k == 0 || follows {
            model.diffusion(at, here, g);
        }
        for j in 0..q.max(1) {
            for i in 0..n {
                point[i] = Dual2::along(here[i], if q == 0 { T::zero() } else { g[i * q + j] });
            }
            model.drift(&when(T::zero()), point, image);
            for i in 0..n {
                let (place, half) = (i * points + k, T::of(0.5) * image[i].dd);
                if j == 0 {
                    (f[place], l0[place]) = (image[i].v, half);
                } else {
                    l0[place] += half;
                }
                if q > 0 && !lf.is_empty() {
                    lf[(i * q + j) * points + k] = image[i].d;
                }
            }
        }
        for i in 0..n {
            point[i] = Dual2::along(here[i], f[i * points + k]);
        }
        model.drift(&when(T::one()), point, image);
        for i in 0..n {
            l0[i * points + k] += image[i].d;
        }
    }
}
