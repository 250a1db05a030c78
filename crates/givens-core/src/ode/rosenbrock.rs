//! A step of a Rosenbrock method: a linear system per stage, no iteration (docs/algorithms.md O5).

use super::System;
use super::field::{Failed, Field, Method, finite};
use super::rodas4::{A, ALPHA, C, DENSE, GAMMA, STAGES, TIME};
use super::tableau::combine;
use crate::kernels::{lu, lu_order, lu_solve};
use crate::model::At;
use crate::scalar::{Dual2, Mask, Real, as_duals};

/// Scalars of memory: N = `len`, `system` of the system's scratch, `beside` controls and parameters, its `table`.
pub(super) const fn rosenbrock_scratch(len: usize, system: usize, beside: usize, table: usize) -> usize {
    let vectors = len.saturating_mul(STAGES + 10).saturating_add(lu_order(len));
    let matrices = len.saturating_mul(len).saturating_mul(2);
    let beside = system.saturating_add(beside).saturating_add(table).saturating_mul(3);
    vectors.saturating_add(matrices).saturating_add(beside)
}

/// The method, with the exact Jacobian.
pub(super) struct Rosenbrock<'a, S, T> {
    /// U_i, the increments of the stages, one behind the other.
    stages: &'a mut [T],
    /// f at the start and at the end of the step.
    slopes: &'a mut [T],
    /// ∂f/∂t at the start.
    f_t: &'a mut [T],
    /// What a stage draws from those before it.
    drawn: &'a mut [T],
    /// ∂f/∂y at the start, N × N.
    jacobian: &'a mut [T],
    /// Both belong to the present start.
    fresh: bool,
    /// I/(γ h) − ∂f/∂y, factorised.
    matrix: &'a mut [T],
    order: &'a mut [T],
    /// The system with derivatives, its state and its slope.
    dual: Field<'a, S, Dual2<T>>,
    y: &'a mut [Dual2<T>],
    dy: &'a mut [Dual2<T>],
    /// Jacobians so far.
    pub jacobians: usize,
}

impl<'a, S: System, T: Real> Rosenbrock<'a, S, T> {
    /// `memory` has [`rosenbrock_scratch`] scalars; controls, parameters and the table are lifted here, once a gap.
    pub fn new(system: &'a S, at: &At<T>, table: &[T], memory: &'a mut [T]) -> Self {
        let len = system.len();
        let (stages, rest) = memory.split_at_mut(STAGES * len);
        let (slopes, rest) = rest.split_at_mut(2 * len);
        let (f_t, rest) = rest.split_at_mut(len);
        let (drawn, rest) = rest.split_at_mut(len);
        let (jacobian, rest) = rest.split_at_mut(len * len);
        let (matrix, rest) = rest.split_at_mut(len * len);
        let (order, rest) = rest.split_at_mut(lu_order(len));
        let (y, rest) = as_duals(rest).split_at_mut(len);
        let (dy, rest) = rest.split_at_mut(len);
        let (u, rest) = lift(at.u, rest);
        let (p, rest) = lift(at.p, rest);
        let (table, scratch) = lift(table, rest);
        let dual = Field { system, u, p, table, scratch, calls: 0 };
        Self { stages, slopes, f_t, drawn, jacobian, fresh: false, matrix, order, dual, y, dy, jacobians: 0 }
    }

    /// ∂f/∂y and ∂f/∂t at (t, y), a direction at a time.
    fn differentiate(&mut self, t: T, y: &[T]) -> Result<(), Failed<S::Fault>> {
        self.jacobians += 1;
        let len = y.len();
        for (dual, &y) in self.y.iter_mut().zip(y) {
            *dual = Dual2::constant(y);
        }
        for j in 0..len {
            self.y[j] = Dual2::variable(y[j]);
            self.dual.slope(Dual2::constant(t), self.y, self.dy)?;
            self.y[j] = Dual2::constant(y[j]);
            for (row, dy) in self.jacobian.chunks_exact_mut(len).zip(&*self.dy) {
                row[j] = dy.d;
            }
        }
        self.dual.slope(Dual2::variable(t), self.y, self.dy)?;
        for (f_t, dy) in self.f_t.iter_mut().zip(&*self.dy) {
            *f_t = dy.d;
        }
        finite(self.f_t)?;
        for (component, row) in self.jacobian.chunks_exact(len).enumerate() {
            finite(row).map_err(|_: Failed<S::Fault>| Failed::NotFinite(component))?;
        }
        self.fresh = true;
        Ok(())
    }
}

/// `values` as duals that do not move, and what is left of the memory.
fn lift<'a, T: Real>(values: &[T], memory: &'a mut [Dual2<T>]) -> (&'a [Dual2<T>], &'a mut [Dual2<T>]) {
    let (lifted, rest) = memory.split_at_mut(values.len());
    for (dual, &value) in lifted.iter_mut().zip(values) {
        *dual = Dual2::constant(value);
    }
    (lifted, rest)
}

/// Row `i` of a triangle stored below its diagonal, row by row.
const fn row(i: usize) -> usize {
    i * i.saturating_sub(1) / 2
}

impl<S: System, T: Real> Method<T, S> for Rosenbrock<'_, S, T> {
    const ERROR_ORDER: i32 = 4;

    fn start(&mut self, field: &mut Field<S, T>, t: T, y: &[T]) -> Result<(), Failed<S::Fault>> {
        field.slope(t, y, &mut self.slopes[..y.len()])
    }

    fn step(
        &mut self,
        field: &mut Field<S, T>,
        t: T,
        h: T,
        y: &[T],
        end: &mut [T],
    ) -> Result<(), Failed<S::Fault>> {
        let len = y.len();
        if !self.fresh {
            self.differentiate(t, y)?;
        }
        let inverse = h.recip();
        for (matrix, &jacobian) in self.matrix.iter_mut().zip(&*self.jacobian) {
            *matrix = -jacobian;
        }
        for i in 0..len {
            self.matrix[i * len + i] += inverse * T::of(1.0 / GAMMA);
        }
        if lu(self.matrix, len, self.order).sick.any() {
            return Err(Failed::Singular);
        }
        for i in 0..STAGES {
            let (before, rest) = self.stages.split_at_mut(i * len);
            let stage = &mut rest[..len];
            if i == 0 {
                stage.copy_from_slice(&self.slopes[..len]);
            } else {
                combine(&A[row(i)..][..i], before, end);
                for (end, &y) in end.iter_mut().zip(y) {
                    *end += y;
                }
                field.slope(T::of(ALPHA[i]).mul_add(h, t), end, stage)?;
            }
            combine(&C[row(i)..][..i], before, self.drawn);
            let time = T::of(TIME[i]) * h;
            for r in 0..len {
                stage[r] = time.mul_add(self.f_t[r], self.drawn[r].mul_add(inverse, stage[r]));
            }
            lu_solve(self.matrix, len, self.order, stage);
        }
        for (end, &last) in end.iter_mut().zip(&self.stages[(STAGES - 1) * len..]) {
            *end += last;
        }
        Ok(())
    }

    fn finish(&mut self, field: &mut Field<S, T>, t: T, end: &[T]) -> Result<(), Failed<S::Fault>> {
        field.slope(t, end, &mut self.slopes[end.len()..])
    }

    fn slopes(&self) -> (&[T], &[T]) {
        self.slopes.split_at(self.slopes.len() / 2)
    }

    fn error(&self, _: T, error: &mut [T]) {
        error.copy_from_slice(&self.stages[(STAGES - 1) * error.len()..]);
    }

    fn curve(&self, _: T, y: &[T], _: &[T], _: bool, curve: &mut [T]) {
        let len = y.len();
        curve.fill(T::zero());
        for (weights, curve) in DENSE.iter().zip(curve.chunks_exact_mut(len)) {
            combine(weights, self.stages, curve);
        }
    }

    fn accept(&mut self) {
        let len = self.slopes.len() / 2;
        self.slopes.copy_within(len.., 0);
        self.fresh = false;
    }
}

#[cfg(test)]
mod tests {
    use super::{Failed, Field, Method, Rosenbrock, rosenbrock_scratch};
    use crate::model::At;
    use crate::ode::{System, Tolerance};
    use crate::scalar::Real;

    /// y' = 4 y: I/(γ h) is the Jacobian at h = 1.
    struct Growth;

    impl System for Growth {
        type Fault = ();
        fn len(&self) -> usize {
            1
        }
        fn scratch(&self) -> usize {
            0
        }
        fn derivative<T: Real>(
            &self,
            _: &At<T>,
            _: &[T],
            y: &[T],
            dy: &mut [T],
            _: &mut [T],
        ) -> Result<(), ()> {
            dy[0] = T::of(4.0) * y[0];
            Ok(())
        }
        fn error<T: Real>(&self, _: Tolerance, _: &[T], _: &[T], error: &[T]) -> f64 {
            error[0].first()
        }
    }

    #[test]
    fn a_step_without_a_solution_is_told_and_keeps_the_jacobian_for_the_next_try() {
        let mut memory = [0.0; rosenbrock_scratch(1, 0, 0, 0)];
        let at = At { t: 0.0, dt: 1.0, u: &[], p: &[] };
        let mut method = Rosenbrock::new(&Growth, &at, &[], &mut memory);
        let mut field = Field { system: &Growth, u: &[], p: &[], table: &[], scratch: &mut [], calls: 0 };
        let (y, mut end) = ([1.0], [0.0]);
        method.start(&mut field, 0.0, &y).unwrap();
        assert!(matches!(method.step(&mut field, 0.0, 1.0, &y, &mut end), Err(Failed::Singular)));
        method.step(&mut field, 0.0, 0.01, &y, &mut end).unwrap();
        assert!((end[0] - 0.04_f64.exp()).abs() < 1e-9, "{end:?}");
        assert_eq!(method.jacobians, 1);
    }
}
