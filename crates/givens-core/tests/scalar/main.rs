//! Derivatives carried by `Dual2`, and what the functions of `Real` make of numbers that are none.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod derivatives;
mod differences;
mod not_a_number;
