//! The recorded rows, and the textbook's answers: `data/make.py` writes both.
#![allow(clippy::unreadable_literal, clippy::excessive_precision)]

/// Range (m) and bearing (rad), every second.
pub static PLANE: [[f32; 2]; 100] = include!("../../data/plane_rows.array");
/// Means and standard deviations at every row.
pub static PLANE_FILTERED: [[f64; 10]; 100] = include!("../../data/plane_filtered.array");
/// The same of the state ten rows ago, from the eleventh row on.
pub static PLANE_LAGGED: [[f64; 10]; 90] = include!("../../data/plane_lagged.array");
/// Range (m), azimuth and elevation (rad), every second.
pub static SPACE: [[f32; 3]; 100] = include!("../../data/space_fast_rows.array");
/// Means and standard deviations at every row.
pub static SPACE_FILTERED: [[f64; 14]; 100] = include!("../../data/space_filtered.array");
