//! The workloads' models, in the same formulas as those of the other contestants; no component is declared an angle, as the
//! others know none and the measurements stay away from ±π.

mod circle;
mod plane;
mod space;

pub use circle::{Circle, Every};
pub use plane::{PlaneRadar, PlaneTurn};
pub use space::{SpaceRadar, SpaceStep, SpaceTurn};
