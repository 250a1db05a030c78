//! The solvers, through their public face.
#![allow(clippy::unwrap_used)]

mod adaptive;
mod orders;
mod problems;
mod stiff;
mod stops;
mod ways;
