//! Three trackers for a microcontroller, to be copied: no `std`, no allocator, single precision, all memory of a length
//! known when the program is built.
//!
//! [`plane`] and [`space`] are models, written out; [`PlaneFilter`], [`SpaceFilter`] and [`PlaneSmoother`] run them.
#![no_std]
#![forbid(unsafe_code)]

pub mod plane;
mod plane_filter;
mod plane_smoother;
pub mod space;
mod space_filter;

pub use plane_filter::{PlaneFilter, PlaneMemory};
pub use plane_smoother::{LagMemory, PlaneSmoother};
pub use space_filter::{SpaceFilter, SpaceMemory};

/// A matrix n × n with these on its diagonal, row by row: a factor of the covariance of states that know nothing of each
/// other. NN is n².
const fn diagonal<const N: usize, const NN: usize>(values: [f64; N]) -> [f64; NN] {
    assert!(N * N == NN, "NN must be the square of N");
    let (mut matrix, mut i) = ([0.0; NN], 0);
    while i < N {
        matrix[i * (N + 1)] = values[i];
        i += 1;
    }
    matrix
}
