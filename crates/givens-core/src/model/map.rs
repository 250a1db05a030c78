//! What a rule sees of a model: a map from the state to d numbers, some of them angles.

use super::{At, Observation, Transition};
use crate::scalar::{Dual2, Real, as_duals};

/// A map that a rule pushes a Gaussian through: a transition or a sensor, seen alike.
pub trait Map {
    /// Length d of the result.
    fn outputs(&self) -> usize;
    /// The period of component `i`, if it is an angle.
    fn angle(&self, i: usize) -> Option<f64> {
        let _ = i;
        None
    }
    /// Scalars of scratch that the two methods below need for `points` points.
    fn scratch(&self, points: usize) -> usize;
    /// All points at once: `x` is n × `points` and `out` d × `points`, component by component.
    fn points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]);
    /// g(x) to `value` and J S to the first n columns of `out`, in rows of length `stride`.
    fn linear<T: Real>(
        &self,
        at: &At<T>,
        x: &[T],
        s: &[T],
        value: &mut [T],
        out: &mut [T],
        stride: usize,
        scratch: &mut [T],
    );
}

/// The transition of a model, as a map.
#[derive(Clone, Copy, Debug)]
pub struct Moving<'a, M>(pub &'a M);

impl<M: Transition> Map for Moving<'_, M> {
    fn outputs(&self) -> usize {
        self.0.states()
    }
    fn scratch(&self, points: usize) -> usize {
        self.0.transition_scratch(points)
    }
    #[inline(always)]
    fn points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        self.0.transition_points(at, points, x, out, scratch);
    }
    #[inline(always)]
    fn linear<T: Real>(
        &self,
        at: &At<T>,
        x: &[T],
        s: &[T],
        value: &mut [T],
        out: &mut [T],
        stride: usize,
        scratch: &mut [T],
    ) {
        self.0.transition_linear(at, x, s, value, out, stride, scratch);
    }
}

/// The measures of a sensor, as a map.
#[derive(Clone, Copy, Debug)]
pub struct Sensed<'a, H>(pub &'a H);

impl<H: Observation> Map for Sensed<'_, H> {
    fn outputs(&self) -> usize {
        self.0.measures()
    }
    fn angle(&self, i: usize) -> Option<f64> {
        self.0.angle(i)
    }
    fn scratch(&self, points: usize) -> usize {
        self.0.observe_scratch(points)
    }
    #[inline(always)]
    fn points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        self.0.observe_points(at, points, x, out, scratch);
    }
    #[inline(always)]
    fn linear<T: Real>(
        &self,
        at: &At<T>,
        x: &[T],
        s: &[T],
        value: &mut [T],
        out: &mut [T],
        stride: usize,
        scratch: &mut [T],
    ) {
        self.0.observe_linear(at, x, s, value, out, stride, scratch);
    }
}

/// Scratch of [`points_one_by_one`].
#[must_use]
pub const fn points_scratch(n: usize, d: usize) -> usize {
    n + d
}

/// Evaluates a map of n inputs and d outputs at points stored component by component, one after the other.
#[inline(always)]
pub fn points_one_by_one<T: Real>(
    n: usize,
    d: usize,
    points: usize,
    x: &[T],
    out: &mut [T],
    scratch: &mut [T],
    map: impl Fn(&[T], &mut [T]),
) {
    let (point, rest) = scratch.split_at_mut(n);
    let image = &mut rest[..d];
    for j in 0..points {
        for i in 0..n {
            point[i] = x[i * points + j];
        }
        map(point, image);
        for i in 0..d {
            out[i * points + j] = image[i];
        }
    }
}

/// Scratch of [`linear_by_duals`]; `beside` is the number of controls and parameters together.
#[must_use]
pub const fn linear_scratch(n: usize, d: usize, beside: usize) -> usize {
    3 * (n + d + beside)
}

/// The first-order part of a map by duals, one direction (a column of `s`) after the other.
#[inline(always)]
pub fn linear_by_duals<T: Real>(
    d: usize,
    at: &At<T>,
    x: &[T],
    s: &[T],
    value: &mut [T],
    out: &mut [T],
    stride: usize,
    scratch: &mut [T],
    map: impl Fn(&At<Dual2<T>>, &[Dual2<T>], &mut [Dual2<T>]),
) {
    let n = x.len();
    let (point, rest) = as_duals(scratch).split_at_mut(n);
    let (image, rest) = rest.split_at_mut(d);
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
        map(&at, point, image);
        for i in 0..d {
            out[i * stride + j] = image[i].d;
            value[i] = image[i].v;
        }
    }
}
