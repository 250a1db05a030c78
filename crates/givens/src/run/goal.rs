//! What a run is after, and what comes of it.

use super::Failure;
use crate::Estimates;
use crate::filter::StepError;

/// What the estimate of a row is given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Goal {
    /// The rows up to itself.
    #[default]
    Filter,
    /// All rows: the fixed-interval smoother.
    Interval,
    /// The rows up to this many after it: the fixed-lag smoother.
    Lag(usize),
    /// The state at this one time, given the rows up to each: the fixed-point smoother. It must be the time of the
    /// initial belief or of a row; rows before it give no estimate.
    Point(f64),
}

/// The estimates of a run, and the failure that ended it if one did.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The finished rows.
    pub estimates: Estimates,
    /// The row that failed, and why.
    pub failure: Option<(usize, StepError)>,
    /// The states at the times asked for; see [`run_at`](crate::run_at). Of a filter that fails, up to the row at fault; of a
    /// smoother, up to the row before.
    pub at: Estimates,
    /// The log-likelihood of all measurements that were taken in, also of those whose row gives no estimate.
    pub log_likelihood: f64,
    /// The mean from which the failed step set out, length n; empty if none failed, or none began.
    pub failed_at: Vec<f64>,
}

impl Outcome {
    pub(crate) fn new(states: usize, measures: usize, goal: Goal) -> Self {
        Self {
            estimates: Estimates::new(states, measures, goal != Goal::Filter),
            failure: None,
            log_likelihood: 0.0,
            failed_at: Vec::new(),
            at: Estimates::default(),
        }
    }

    /// The estimates of all rows.
    ///
    /// # Errors
    /// The failure, with the rows that were finished.
    pub fn into_result(self) -> Result<Estimates, Failure> {
        match self.failure {
            None => Ok(self.estimates),
            Some((row, error)) => {
                Err(Failure { row, error, mean: self.failed_at, finished: Box::new(self.estimates) })
            }
        }
    }
}
