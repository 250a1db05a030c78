//! What the rows of a run add up to, as they are finished.

use crate::plan::Plan;
use crate::report::{Gated, Summary};
use givens::metrics::{AccuracySums, ConsistencySums, InnovationSums, Truth};
use givens::{Estimates, Goal};
use serde::{Deserialize, Serialize};

/// Of all rows so far.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Sums {
    pub rows: usize,
    log_likelihood: f64,
    consistency: ConsistencySums,
    accuracy: Option<AccuracySums>,
    /// For a report, if one is made.
    pub innovations: Option<InnovationSums>,
    gated: Gated,
}

impl Sums {
    /// Of no rows; `judged` if a report is made of them.
    pub fn new(plan: &Plan, judged: bool) -> Self {
        let accuracy = plan.truth.as_ref().map(|_| AccuracySums::new(plan.model.states.len()));
        let innovations = judged.then(|| InnovationSums::new(plan.model.measures()));
        Self { accuracy, innovations, ..Self::default() }
    }

    /// Adds rows of track `i`, the first of which is its row `from`. Those of one track follow each other. The truth of each, if
    /// there is one.
    pub fn add(&mut self, plan: &Plan, i: usize, from: usize, goal: Goal, est: &Estimates) -> Option<Truth> {
        self.rows += est.len();
        est.log_likelihood.iter().for_each(|x| self.log_likelihood += x);
        self.consistency.add(est);
        if let Some(sums) = &mut self.innovations {
            sums.add(i, from, est);
        }
        self.gated.add(i, from, est);
        let truth = plan.truth_at(i, goal, est.time.iter().copied());
        if let (Some(sums), Some(truth)) = (&mut self.accuracy, &truth) {
            sums.add(&est.mean, &est.cov, &truth.states);
        }
        truth
    }

    /// All of it.
    pub fn summary(&self) -> Summary {
        Summary {
            rows: self.rows,
            log_likelihood: self.log_likelihood,
            consistency: self.consistency.consistency(),
            gated: self.gated.clone(),
            accuracy: self.accuracy.as_ref().map(AccuracySums::accuracy),
        }
    }
}
