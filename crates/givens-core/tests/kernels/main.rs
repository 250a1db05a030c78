//! What the triangular kernels promise, on random matrices.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod cholesky;
mod cholesky_bounds;
mod downdate;
mod downdate_bounds;
mod faint;
mod matrix;
mod product;
mod solve;
mod sweep;
mod tria;
