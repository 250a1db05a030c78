//! The commands, one file each.

pub mod check;
pub mod compare;
pub mod completions;
pub mod filter;
pub mod folder;
pub mod methods;
pub mod partition;
pub mod reproduce;
pub mod simulate;
mod written;
