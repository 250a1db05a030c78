//! The solvers that choose their steps by a tolerance.

use super::Solver;

/// A [`Solver`] that adapts its steps: for methods that are defined by it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AdaptiveSolver {
    /// Dormand and Prince's pair of orders 5 and 4.
    #[default]
    Dp5,
    /// Hairer and Wanner's Rosenbrock method of order 4, for stiff systems.
    Rodas4,
}

impl AdaptiveSolver {
    /// The same among all solvers.
    #[must_use]
    pub const fn solver(self) -> Solver {
        match self {
            AdaptiveSolver::Dp5 => Solver::Dp5,
            AdaptiveSolver::Rodas4 => Solver::Rodas4,
        }
    }
}
