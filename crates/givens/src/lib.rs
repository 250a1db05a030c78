//! Nonlinear Gaussian state estimation: cubature, unscented, Gauss–Hermite, central-difference and Taylor filters and
//! smoothers, in covariance and in square-root form.
//!
//! The mathematics is [`givens_core`], re-exported here; this crate adds whole trajectories: [`filter()`] and
//! [`smooth()`] over [`Data`], their [`Estimates`], joint draws by [`sample()`], many tracks at once by [`batch`],
//! [`simulate`](mod@simulate), [`metrics`], and the [`registry`] of all methods by name.
//!
//! ```
//! use givens::filter::{Gaussian, SrCkf};
//! use givens::model::zoo::{CoordinatedTurn, RangeBearing};
//! use givens::Data;
//!
//! let mut data = Data::new(2).starting_at(0.0);
//! data.push(1.0, &[1640.0, 0.65])?;
//! data.push(2.0, &[1890.0, f64::NAN])?; // the bearing is missing
//! let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
//! let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
//! let est = givens::smooth(&SrCkf::default(), &turn, &radar, &data, &prior)?;
//! assert_eq!(est.len(), 2);
//! assert!(est.cov(0)[0] <= est.filtered_cov(0)[0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use givens_core::{filter, kernels, model, ode, rule, scalar, smoother};

pub mod batch;
mod data;
mod doubt;
mod estimates;
pub mod explain;
mod gate;
pub mod metrics;
mod precision;
pub mod registry;
mod run;
pub mod simulate;
mod stream;

pub use data::{Data, DataError, Row};
pub use doubt::{Doubt, Doubtful, Doubts, Gap};
pub use estimates::Estimates;
pub use gate::Gated;
pub use precision::{Computes, Single};
pub use run::{Draws, Failure, Goal, Outcome, Samples, filter, run, run_at, sample, smooth};
pub use stream::{Ended, Finished, Mark, Sink, Source, Stream, Stretch};
