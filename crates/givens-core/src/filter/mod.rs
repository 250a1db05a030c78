//! Filters: a rule, a time update and a measurement update, stepped through time.

mod acd_ekf;
pub(crate) mod backward;
mod constants;
mod continuous;
mod distinct;
mod error;
mod fits;
mod form;
mod gate;
mod gaussian;
mod inside;
mod known;
pub(crate) mod lanes;
mod layout;
mod lockstep;
pub(crate) mod memory;
mod methods;
pub mod predict;
mod quantity;
mod sizes;
mod snapshot;
mod start;
mod stepper;
mod steps;
pub mod update;

pub use acd_ekf::{AcdEkf, SrAcdEkf};
pub use backward::Backward;
pub use continuous::{
    CdCkf, CdCkf1, CdCkf2, CdEkf, CdGhkf1, CdGhkf2, CdUkf, CdUkf1, Lskf, SrCdCkf, SrCdCkf1, SrCdCkf2,
    SrCdEkf, SrCdGhkf1, SrCdGhkf2, SrCdUkf, SrCdUkf1,
};
pub use error::{Fault, Halt, Matrix, StepError};
pub use form::{Belief, Covariance, Form, SquareRoot};
#[cfg(feature = "alloc")]
pub use gaussian::Gaussian;
pub use gaussian::{InvalidCovariance, factor_of_covariance};
pub use methods::{Cdkf, Ckf, Ckf5, Ekf, Method, Over, Qkf, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf, SrUkf, Ukf};
pub use quantity::Quantity;
pub use sizes::Sizes;
pub use snapshot::Carried;
#[cfg(feature = "alloc")]
pub use snapshot::Snapshot;
pub use start::Prior;
pub use stepper::Filter;
pub use steps::Grow;
pub use update::{Block, Innovation, Learnt};
