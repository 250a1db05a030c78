//! The mathematics of givens: Gaussian filters and smoothers for nonlinear systems, `no_std`, without allocation in a
//! step, generic over the scalar.
//!
//! Modules in the order in which they may use each other: [`scalar`], [`kernels`], [`model`], [`rule`], [`ode`], [`filter`],
//! [`smoother`].
#![cfg_attr(not(any(feature = "std", test)), no_std)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod filter;
pub mod kernels;
pub mod model;
pub mod ode;
pub mod rule;
pub mod scalar;
pub mod smoother;
