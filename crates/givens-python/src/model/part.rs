//! One function of a model, whatever it is made of, as the traits of models want it.

use core::any::TypeId;

use givens::model::{At, AtPoint, Linear, linear_by_duals};
use givens::scalar::Real;
use givens_expr::{Inputs, Program};

use super::function::{How, Place};

/// A function of n states with `outputs` values.
#[derive(Debug)]
pub struct Part {
    /// The argument that brings it, by which errors call it.
    pub what: &'static str,
    pub body: Body,
    pub outputs: usize,
    /// Rows of its values at one point, if they are a matrix; else one for each.
    pub rows: usize,
    /// ∂f/∂x, outputs × n row by row.
    pub jacobian: Option<How>,
}

/// What it is made of.
#[derive(Debug)]
pub enum Body {
    Program(Program),
    Called(How),
}

/// Whether a scalar is a plain number: one without derivatives. A function that is called takes `f64`, and what it gives is
/// rounded where a method computes in `f32`.
fn plain<T: Real>() -> bool {
    [TypeId::of::<f64>(), TypeId::of::<f32>()].contains(&TypeId::of::<T>())
}

fn numbers<T: Real>(from: &[T]) -> Vec<f64> {
    from.iter().map(|x| x.first()).collect()
}

/// Calls a function for plain numbers.
fn call<T: Real>(how: &How, what: &str, at: &At<T>, points: usize, x: &[T], out: &mut [T], rows: usize) {
    let (u, p, x) = (numbers(at.u), numbers(at.p), numbers(x));
    let place = Place { t: at.t.first(), dt: at.dt.first(), u: &u, p: &p };
    let mut values = vec![f64::NAN; out.len()];
    let shape = [rows, out.len() / rows.max(1)];
    how.call(what, &place, points, &x, &mut values, shape);
    out.iter_mut().zip(values).for_each(|(to, from)| *to = T::of(from));
}

impl Part {
    /// Whether it has all derivatives.
    pub fn is_smooth(&self) -> bool {
        matches!(self.body, Body::Program(_))
    }

    /// Whether it has first derivatives.
    pub fn has_slopes(&self) -> bool {
        self.is_smooth() || self.jacobian.is_some()
    }

    /// Whether calling it needs the interpreter.
    pub fn needs_python(&self) -> bool {
        let called = match &self.body {
            Body::Program(_) => false,
            Body::Called(how) => how.needs_python(),
        };
        called || self.jacobian.as_ref().is_some_and(How::needs_python)
    }

    /// Scalars of scratch for `points` points of `n` states, beside so many controls and parameters.
    pub fn scratch(&self, n: usize, points: usize, beside: usize) -> usize {
        match &self.body {
            Body::Program(program) => {
                let duals = program.scratch_len(1) + n + self.outputs + beside;
                program.scratch_len(points).max(3 * duals)
            }
            Body::Called(_) => 0,
        }
    }

    /// All points at once, component by component. A function that is called has no derivatives: not-a-number stands
    /// for them, and methods that read them are refused before.
    pub fn points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        match &self.body {
            Body::Program(program) => {
                program.eval(&Inputs { at: *at, x, z: &[] }, points, out, scratch);
            }
            Body::Called(how) if plain::<T>() => call(how, self.what, at, points, x, out, self.outputs),
            Body::Called(_) => out.fill(T::of(f64::NAN)),
        }
    }

    /// At one point, in memory of its own.
    pub fn one<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let len = match &self.body {
            Body::Program(program) => program.scratch_len(1),
            Body::Called(_) => 0,
        };
        self.points(at, 1, x, out, &mut vec![T::zero(); len]);
    }

    /// A noise at one point: where it is called, its derivatives are taken as zero, for its owner says what it depends on.
    pub fn noise<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        match &self.body {
            Body::Called(how) => call(how, self.what, at, 1, x, out, self.rows),
            Body::Program(_) => self.one(at, x, out),
        }
    }

    /// f(x), and J S with J = ∂f/∂x and `s` = S, n × n.
    pub fn linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let (n, d) = (x.len(), self.outputs);
        if let Some(jacobian) = &self.jacobian {
            self.points(at, 1, x, &mut *out.value, scratch);
            let mut slopes = vec![T::of(f64::NAN); d * n];
            if plain::<T>() {
                call(jacobian, "jacobian", at, 1, x, &mut slopes, d);
            }
            for i in 0..d {
                for j in 0..n {
                    let product = (0..n).map(|k| slopes[i * n + k] * s[k * n + j]);
                    out.image[i * out.stride + j] = product.fold(T::zero(), |sum, x| sum + x);
                }
            }
            return;
        }
        linear_by_duals(d, at, x, s, out, scratch, self);
    }
}

impl AtPoint for Part {
    #[inline(always)]
    fn at_point<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.one(at, x, out);
    }
}
