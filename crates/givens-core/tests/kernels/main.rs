//! What the triangular kernels promise, on random matrices.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod cholesky;
mod downdate;
mod faint;
mod matrix;
mod product;
mod solve;
mod sweep;
mod tria;
