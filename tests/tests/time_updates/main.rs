//! What the time updates of continuous models have in common, and where they differ as theory says.

mod bent_diffusion;
mod drift;
mod level_set;
mod memory;
mod rules;
mod steps;
mod way_back;
