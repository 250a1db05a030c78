//! What an answer is worth: right, refused, doubted, not a number, or wrong and told as right.

use super::{Answer, Moments};
use crate::{cov_error, mean_error};

/// An error below this many standard deviations is nobody's loss.
const FLOOR: f64 = 1e-3;
/// A filter rounds more than its inputs: so many times what rounding those costs.
const TIMES: f64 = 10.0;

/// From this cost on, in standard deviations, an answer is not determined by what a filter is told.
const UNDETERMINED: f64 = 1e-2;

/// How a filter asks the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asks {
    /// For matrices, or for derivatives.
    Slopes,
    /// For what it says at points, which are rounded, as what it says is.
    Points,
}

/// What a filter gave: the rows before it stopped, and why it did.
#[derive(Clone, Debug, Default)]
pub struct Answered {
    /// Mean and covariance after each row.
    pub rows: Vec<Moments>,
    /// Its error, if it had one.
    pub refused: Option<String>,
}

/// The worth of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Every row within the bound; the largest error, in standard deviations.
    Right(f64),
    /// It stopped, and what it had answered before is right.
    Said(String),
    /// It gave numbers that are none, which a reader may or may not notice.
    NotANumber,
    /// A wrong answer about which there is a doubt; the largest error.
    Doubted(f64),
    /// A wrong answer told as right; the largest error.
    Wrong(f64),
}

impl Answer {
    /// The error above which an answer is wrong: a thousandth of a standard deviation, or ten times what the rounding of all that
    /// the filter is told costs; none if that does not determine the answer.
    #[must_use]
    pub fn bound(&self, asks: Asks) -> Option<f64> {
        let cost = if asks == Asks::Slopes { self.cost } else { self.points };
        (cost <= UNDETERMINED).then(|| FLOOR.max(TIMES * cost))
    }
}

/// Compares what a filter gave with what it should have. Errors are in standard deviations of the exact answer, of each state
/// and each pair of states. None where nothing is determined.
///
/// # Panics
/// If rows are missing without a reason.
#[must_use]
pub fn judge(answer: &Answer, asks: Asks, given: &Answered) -> Option<Verdict> {
    let bound = answer.bound(asks)?;
    assert!(given.rows.len() == answer.rows.len() || given.refused.is_some(), "rows are missing");
    let mut worst = 0.0f64;
    for ((mean, cov), (exact_mean, exact_cov)) in given.rows.iter().zip(&answer.rows) {
        if mean.iter().chain(cov).any(|x| !x.is_finite()) {
            return Some(if worst > bound { Verdict::Wrong(worst) } else { Verdict::NotANumber });
        }
        let n = mean.len();
        worst = worst.max(mean_error(mean, exact_mean, exact_cov)).max(cov_error(cov, exact_cov, n));
    }
    Some(match &given.refused {
        _ if worst > bound => Verdict::Wrong(worst),
        Some(why) => Verdict::Said(why.clone()),
        None => Verdict::Right(worst),
    })
}
