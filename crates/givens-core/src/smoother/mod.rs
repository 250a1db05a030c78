//! Smoothers: backward passes over what a filter recorded (docs/algorithms.md §6).
//!
//! A [`History`] records the time updates of a filter, all of them or the last L; [`History::smooth`] goes back over
//! them (fixed interval, and fixed lag over a ring). [`FixedPoint`] carries one past state forward instead;
//! [`History::sample`] draws whole trajectories.

mod back;
mod fixed_point;
mod history;
mod lockstep;
mod rotated;
mod sample;
mod way_back;

pub use fixed_point::FixedPoint;
pub use history::History;
pub use way_back::{Answer, Smoothed};
