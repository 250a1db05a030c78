//! Triangular matrices, what every filter and smoother is made of, and one general division. Slices in, caller's memory, no model.
//!
//! All matrices are stored row by row. A kernel never branches on one lane of a pack: it reports the lanes that
//! it could not serve as [`Health`].

mod cholesky;
mod cholesky_again;
mod downdate;
mod faint;
mod health;
mod lu;
mod outlined;
mod product;
mod rest;
mod rotations;
mod side_by_side;
mod sized;
mod solve;
mod sweep;
mod sweep_in_lanes;
mod tria;
mod tria_panels;
mod tria_wide;

pub use cholesky::{cholesky, cholesky_scaled};
pub use cholesky_again::{cholesky_again, kept_root};
pub use downdate::downdate;
pub use health::Health;
pub use lu::{lu, lu_order, lu_solve, lu_solve_transposed};
pub(crate) use outlined::outlined;
pub use product::{
    add_outer, copy_lower, dot, less_dot, plus_dot, plus_magnitudes, product_lower, square, square_lower,
    wild_row,
};
pub(crate) use sized::sized;
pub use solve::{divide_lower, divide_lower_transposed, solve_lower, solve_lower_rows};
pub use sweep::sweep;
pub use sweep_in_lanes::sweep_scratch;
pub use tria::tria;
