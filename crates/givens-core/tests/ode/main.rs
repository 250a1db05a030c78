//! The solvers, through their public face.

mod adaptive;
mod orders;
mod problems;
mod stiff;
mod stops;
mod ways;
