//! The experiments of five papers, run again: what each claims, the published numbers, and ours beside them.
//!
//! A [`Paper`] is a folder with one file for each of its tables and figures; [`PAPERS`] lists them. An [`Experiment`]
//! draws its runs in parallel, from streams keyed by seed and run, so that the numbers are the same for any number of
//! threads, and answers with a [`Page`]: tables, figures, and every published number [judged](Verdict). Nothing here
//! opens a file or prints.

mod claim;
mod drawing;
mod estimate;
mod expected;
mod failures;
mod page;
mod paired;
mod paper;
mod plan;
mod radar;
mod statistics;

pub mod arasaratnam2009cubature;
pub mod arasaratnam2010continuous;
pub mod arasaratnam2011smoothers;
pub mod sarkka2012continuous;
pub mod wang2021levelset;

pub use claim::{Claim, Verdict};
pub use estimate::Estimate;
pub use expected::{Expected, ExpectedError};
pub use failures::Failures;
pub use page::{Cell, File, Page, Table, index};
pub use paper::{Experiment, PAPERS, Paper, Refused, Trouble, find};
pub use plan::{Plan, Progress, Quiet};
