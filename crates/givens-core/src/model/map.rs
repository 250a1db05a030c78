//! What a rule sees of a model: a map from the state to d numbers, some of them angles.

use super::{At, Observation, Sde, Transition};
use crate::scalar::{Dual2, Real, as_duals};

/// Where the first-order part of a map g is written: its value, and the image J S of a root S by its Jacobian J.
#[derive(Debug)]
pub struct Linear<'a, T> {
    /// g(x), length d.
    pub value: &'a mut [T],
    /// J S, d rows of length `stride`, in the first n columns; the others are left alone.
    pub image: &'a mut [T],
    /// Length of a row of `image`, at least n.
    pub stride: usize,
}

impl<T> Linear<'_, T> {
    /// The first `rows` outputs, and the others: for a map that is two, one above the other.
    #[inline(always)]
    #[must_use]
    pub fn split_at(self, rows: usize) -> (Self, Self) {
        let Linear { value, image, stride } = self;
        let (value, lower_value) = value.split_at_mut(rows);
        let (image, lower_image) = image.split_at_mut(rows * stride);
        (Linear { value, image, stride }, Linear { value: lower_value, image: lower_image, stride })
    }
}

/// A map that a rule pushes a Gaussian through: a transition or a sensor, seen alike.
pub trait Map {
    /// Length d of the result.
    fn outputs(&self) -> usize;
    /// The period of component `i`, if it is an angle.
    fn angle(&self, i: usize) -> Option<f64> {
        let _ = i;
        None
    }
    /// Whether the methods below serve packs, too.
    fn serves_packs(&self) -> bool {
        true
    }
    /// Scalars of scratch that the two methods below need for `points` points.
    fn scratch(&self, points: usize) -> usize;
    /// All points at once: `x` is n × `points` and `out` d × `points`, component by component.
    fn points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]);
    /// The first-order part: g(x) and J S, with J = ∂g/∂x and `s` = S, n × n.
    fn linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]);
}

/// A map at one point: what [`points_one_by_one`] and [`linear_by_duals`] go over. It is no closure, as a function can be
/// marked to be inlined: where it is not, a pack's instructions become calls.
pub trait AtPoint {
    /// Evaluates the map at `x`.
    fn at_point<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]);
}

/// The transition of a model, as a map.
#[derive(Clone, Copy, Debug)]
pub struct Moving<'a, M: ?Sized>(pub &'a M);

impl<M: Transition + ?Sized> AtPoint for Moving<'_, M> {
    #[inline(always)]
    fn at_point<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.0.transition(at, x, out);
    }
}

impl<M: Transition> Map for Moving<'_, M> {
    fn outputs(&self) -> usize {
        self.0.states()
    }
    fn serves_packs(&self) -> bool {
        self.0.serves_packs()
    }
    fn scratch(&self, points: usize) -> usize {
        self.0.transition_scratch(points)
    }
    #[inline(always)]
    fn points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        self.0.transition_points(at, points, x, out, scratch);
    }
    #[inline(always)]
    fn linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        self.0.transition_linear(at, x, s, out, scratch);
    }
}

/// The measures of a sensor, as a map.
#[derive(Clone, Copy, Debug)]
pub struct Sensed<'a, H: ?Sized>(pub &'a H);

impl<H: Observation + ?Sized> AtPoint for Sensed<'_, H> {
    #[inline(always)]
    fn at_point<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.0.observe(at, x, out);
    }
}

/// The drift of a continuous model, as a map.
#[derive(Clone, Copy, Debug)]
pub struct Drifting<'a, M: ?Sized>(pub &'a M);

impl<M: Sde + ?Sized> AtPoint for Drifting<'_, M> {
    #[inline(always)]
    fn at_point<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.0.drift(at, x, out);
    }
}

/// The entries of the diffusion of a continuous model, row by row, as a map.
#[derive(Clone, Copy, Debug)]
pub struct Diffusing<'a, M: ?Sized>(pub &'a M);

impl<M: Sde + ?Sized> AtPoint for Diffusing<'_, M> {
    #[inline(always)]
    fn at_point<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.0.diffusion(at, x, out);
    }
}

impl<H: Observation> Map for Sensed<'_, H> {
    fn outputs(&self) -> usize {
        self.0.measures()
    }
    fn angle(&self, i: usize) -> Option<f64> {
        self.0.angle(i)
    }
    fn serves_packs(&self) -> bool {
        self.0.serves_packs()
    }
    fn scratch(&self, points: usize) -> usize {
        self.0.observe_scratch(points)
    }
    #[inline(always)]
    fn points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        self.0.observe_points(at, points, x, out, scratch);
    }
    #[inline(always)]
    fn linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        self.0.observe_linear(at, x, s, out, scratch);
    }
}

/// Scratch of [`points_one_by_one`].
#[must_use]
pub const fn points_scratch(n: usize, d: usize) -> usize {
    n.saturating_add(d)
}

/// Evaluates a map of n inputs and d outputs at points stored component by component, one after the other.
#[inline(always)]
pub fn points_one_by_one<T: Real>(
    n: usize,
    d: usize,
    at: &At<T>,
    points: usize,
    x: &[T],
    out: &mut [T],
    scratch: &mut [T],
    map: &impl AtPoint,
) {
    let (point, rest) = scratch.split_at_mut(n);
    let image = &mut rest[..d];
    for j in 0..points {
        for i in 0..n {
            point[i] = x[i * points + j];
        }
        map.at_point(at, point, image);
        for i in 0..d {
            out[i * points + j] = image[i];
        }
    }
}

/// Scratch of [`linear_by_duals`]; `beside` is the number of controls and parameters together.
#[must_use]
pub const fn linear_scratch(n: usize, d: usize, beside: usize) -> usize {
    n.saturating_add(d).saturating_add(beside).saturating_mul(3)
}

/// The first-order part of a map by duals, one direction (a column of `s`) after the other.
#[inline(always)]
pub fn linear_by_duals<T: Real>(
    d: usize,
    at: &At<T>,
    x: &[T],
    s: &[T],
    out: Linear<T>,
    scratch: &mut [T],
    map: &impl AtPoint,
) {
    let (n, Linear { value, image, stride }) = (x.len(), out);
    let (point, rest) = as_duals(scratch).split_at_mut(n);
    let (y, rest) = rest.split_at_mut(d);
    let (u, rest) = rest.split_at_mut(at.u.len());
    let p = &mut rest[..at.p.len()];
    for (dual, &v) in u.iter_mut().zip(at.u).chain(p.iter_mut().zip(at.p)) {
        *dual = Dual2::constant(v);
    }
    let at = At { t: Dual2::constant(at.t), dt: Dual2::constant(at.dt), u, p };
    for j in 0..n {
        for i in 0..n {
            point[i] = Dual2::along(x[i], s[i * n + j]);
        }
        map.at_point(&at, point, y);
        for i in 0..d {
            image[i * stride + j] = y[i].d;
            value[i] = y[i].v;
        }
    }
}
