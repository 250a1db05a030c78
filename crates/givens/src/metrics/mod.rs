//! How good an estimate is: against a truth, and against itself.

mod accuracy;
mod chi_squared;
mod consistency;
mod innovations;

pub use accuracy::{Accuracy, AccuracySums, Truth, nees};
pub use chi_squared::{chi_squared_band, chi_squared_cdf, chi_squared_quantile};
pub use consistency::{Consistency, ConsistencySums, Verdict};
pub use innovations::{InnovationSums, MeasureVerdict, Outlier};
