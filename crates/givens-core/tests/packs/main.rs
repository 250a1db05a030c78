//! What the packs of every instruction set promise; a set that this machine lacks is skipped, and says so.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a test may stop at what it did not expect, and say what it did"
)]

mod accuracy;
mod every_set;
mod kernels;
mod lanes;
mod limits;
mod operations;
mod reference;
mod with_derivatives;
