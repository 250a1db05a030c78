//! What the user chooses of an integration, and its beginning.

use super::adaptive::{Bounds, adaptive};
use super::explicit::{Explicit, explicit_scratch};
use super::field::Field;
use super::fixed::Fixed;
use super::rosenbrock::{Rosenbrock, rosenbrock_scratch};
use super::segment::{Segment, Visit};
use super::tableau::{DP5, EULER, RK2, RK4, Tableau};
use super::{Stop, System, Tolerance, Why};
use crate::model::At;
use crate::rule::RuleError;
use crate::scalar::Real;

/// A method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// Euler's, of order 1.
    Euler,
    /// Heun's method, of order 2.
    Rk2,
    /// The classical Runge–Kutta method, of order 4.
    Rk4,
    /// Dormand and Prince's pair of orders 5 and 4, with steps as the tolerance asks.
    Dp5,
    /// Hairer and Wanner's Rosenbrock method of order 4, for stiff systems, with steps as the tolerance asks. A step
    /// costs a Jacobian of the whole state (N + 1 evaluations in duals) and an N × N division.
    Rodas4,
}

impl Solver {
    /// All of them.
    pub const ALL: [Solver; 5] = [Solver::Euler, Solver::Rk2, Solver::Rk4, Solver::Dp5, Solver::Rodas4];

    /// Its registry name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Solver::Euler => "euler",
            Solver::Rk2 => "rk2",
            Solver::Rk4 => "rk4",
            Solver::Dp5 => "dp5",
            Solver::Rodas4 => "rodas4",
        }
    }

    /// Whether it chooses its steps by the tolerance.
    #[must_use]
    pub const fn adaptive(self) -> bool {
        matches!(self, Solver::Dp5 | Solver::Rodas4)
    }

    /// Of an explicit method.
    const fn tableau(self) -> Option<&'static Tableau> {
        match self {
            Solver::Euler => Some(&EULER),
            Solver::Rk2 => Some(&RK2),
            Solver::Rk4 => Some(&RK4),
            Solver::Dp5 => Some(&DP5),
            Solver::Rodas4 => None,
        }
    }
}

/// How a gap is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steps {
    /// Into so many steps (`substeps`). Adaptive solvers do not read it.
    Count(usize),
    /// Into as many as keep each at most so long (`max_step`); a bound for adaptive solvers.
    Longest(f64),
}

/// The smallest tolerance of steps in `f32`.
const LEAST_IN_F32: f64 = 1e-6;

/// The options of an integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integrator {
    /// The method.
    pub solver: Solver,
    /// How a gap is divided.
    pub steps: Steps,
    /// What adaptive solvers keep the error of a step below.
    pub tolerance: Tolerance,
    /// Steps that one gap may take, rejected ones included.
    pub limit: usize,
}

impl Default for Integrator {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// What integrations have cost so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Work {
    /// Evaluations of the derivative.
    pub calls: usize,
    /// Evaluations of its Jacobian.
    pub jacobians: usize,
    /// Steps taken.
    pub accepted: usize,
    /// Steps tried and not taken.
    pub rejected: usize,
}

impl Integrator {
    /// The options that a user meets, as a constant.
    pub const DEFAULT: Self =
        Self { solver: Solver::Dp5, steps: Steps::Count(16), tolerance: Tolerance::DEFAULT, limit: 100_000 };

    /// Whether the options are in range.
    ///
    /// # Errors
    /// The first option out of its range, by its registry name.
    pub fn check(&self) -> Result<(), RuleError> {
        let wrong = |option, value, must| Err(RuleError { option, value, must });
        let Tolerance { rtol, atol } = self.tolerance;
        let range = |value: f64| value >= 0.0 && value.is_finite();
        match self.steps {
            Steps::Count(count) if !(1..=self.limit).contains(&count) => {
                wrong("substeps", count as f64, "must be at least 1, and at most the limit of steps of a gap")
            }
            Steps::Longest(longest) if !(longest > 0.0 && longest.is_finite()) => {
                wrong("max_step", longest, "must be a number above 0")
            }
            _ if !range(rtol) => wrong("rtol", rtol, "must be a number not below 0"),
            _ if !range(atol) => wrong("atol", atol, "must be a number not below 0"),
            _ if rtol == 0.0 && atol == 0.0 => wrong("rtol", rtol, "must be above 0, or atol must be"),
            _ if self.limit == 0 => wrong("limit", 0.0, "must be at least 1"),
            _ => Ok(()),
        }
    }

    /// Whether numbers of this relative spacing can keep the tolerance: there is always some rounding in the error of a step.
    ///
    /// # Errors
    /// A tolerance that is no more than the rounding of `f32`.
    pub fn resolves(&self, epsilon: f64) -> Result<(), RuleError> {
        let Tolerance { rtol, atol } = self.tolerance;
        if self.solver.adaptive() && epsilon > f64::EPSILON && atol == 0.0 && rtol < LEAST_IN_F32 {
            let must = "must be at least 1e-6 in f32, which rounds to 1e-7; or set precision = f64";
            return Err(RuleError { option: "rtol", value: rtol, must });
        }
        Ok(())
    }

    fn bounds(&self) -> Bounds {
        let longest = match self.steps {
            Steps::Count(_) => f64::INFINITY,
            Steps::Longest(longest) => longest,
        };
        Bounds { tolerance: self.tolerance, longest, limit: self.limit, first: None }
    }

    /// Scalars of scratch of [`solve`](Self::solve): for a state of length `len`, a system that needs `system` of its
    /// own and has a table of length `table`, and `beside` controls and parameters together.
    #[must_use]
    pub const fn scratch(&self, len: usize, system: usize, beside: usize, table: usize) -> usize {
        let method = match self.solver.tableau() {
            Some(tableau) => explicit_scratch(tableau, len),
            None => rosenbrock_scratch(len, system, beside, table),
        };
        // the state at the end of a step, its error, dense output
        len.saturating_mul(5).saturating_add(system).saturating_add(method)
    }

    /// Whether several lanes may be integrated together: the number of steps depends on none of them.
    #[must_use]
    pub fn lockstep(&self) -> bool {
        !self.solver.adaptive() && matches!(self.steps, Steps::Count(_))
    }

    /// Moves `y` from time `at.t` over `at.dt`, which may be negative; `visit` sees every accepted step.
    ///
    /// `table` is the system's own data; `work` counts; `scratch` has [`scratch`](Self::scratch) scalars. Steps of
    /// equal length may run with several lanes, all with the number of steps of the first; adaptive ones are for one
    /// lane, and their lengths are constants, without derivative.
    ///
    /// # Errors
    /// Where and why the integration ended early; `y` is then the state at that time.
    pub fn solve<T: Real, S: System>(
        &self,
        system: &S,
        at: &At<T>,
        table: &[T],
        y: &mut [T],
        work: &mut Work,
        mut visit: impl FnMut(&Segment<T>),
        scratch: &mut [T],
    ) -> Result<(), Stop<S::Fault>> {
        self.run(system, at, table, y, work, Some(&mut visit), scratch)
    }

    /// [`solve`](Self::solve) without dense output: the same result, and one evaluation fewer for steps of equal length.
    ///
    /// # Errors
    /// As there.
    pub fn advance<T: Real, S: System>(
        &self,
        system: &S,
        at: &At<T>,
        table: &[T],
        y: &mut [T],
        work: &mut Work,
        scratch: &mut [T],
    ) -> Result<(), Stop<S::Fault>> {
        self.run(system, at, table, y, work, None, scratch)
    }

    fn run<T: Real, S: System>(
        &self,
        system: &S,
        at: &At<T>,
        table: &[T],
        y: &mut [T],
        work: &mut Work,
        visit: Visit<T>,
        scratch: &mut [T],
    ) -> Result<(), Stop<S::Fault>> {
        let (len, own) = (system.len(), system.scratch());
        debug_assert_eq!(y.len(), len, "length of the state");
        debug_assert!(
            scratch.len() >= self.scratch(len, own, at.u.len() + at.p.len(), table.len()),
            "length of the scratch"
        );
        let (time, gap) = (at.t.first(), at.dt.first());
        if !(time + gap).is_finite() {
            return Err(Stop { time, smallest: gap.abs(), why: Why::StepTooSmall });
        }
        if gap == 0.0 || len == 0 {
            return Ok(());
        }
        let (end, rest) = scratch.split_at_mut(len);
        let (error, rest) = rest.split_at_mut(len);
        let (curve, rest) = rest.split_at_mut(3 * len);
        let (own, rest) = rest.split_at_mut(own);
        let mut field = Field { system, u: at.u, p: at.p, table, scratch: own, calls: 0 };
        let bounds = self.bounds();
        let memory = (end, error, curve);
        let done = match self.solver.tableau() {
            None => {
                let mut method = Rosenbrock::new(system, at, table, rest);
                let done = adaptive(&mut method, &mut field, at, &bounds, y, visit, work, memory);
                work.jacobians = work.jacobians.saturating_add(method.jacobians);
                done
            }
            Some(tableau) => {
                let k = &mut rest[..explicit_scratch(tableau, len)];
                let mut method = Explicit { tableau, k, len };
                if self.solver.adaptive() {
                    adaptive(&mut method, &mut field, at, &bounds, y, visit, work, memory)
                } else {
                    let steps = (self.steps, self.limit);
                    let (end, _, curve) = memory;
                    T::within(Fixed {
                        method: &mut method,
                        field: &mut field,
                        at,
                        steps,
                        y,
                        visit,
                        work,
                        end,
                        curve,
                    })
                }
            }
        };
        work.calls = work.calls.saturating_add(field.calls);
        done
    }
}
