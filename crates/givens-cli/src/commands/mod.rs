//! The commands, one file each.

pub mod check;
pub mod compare;
pub mod completions;
pub mod filter;
pub mod methods;
pub mod reproduce;
pub mod simulate;
