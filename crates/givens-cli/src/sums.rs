//! What the rows of a run add up to, as they are finished.

use crate::doubts;
use crate::plan::Plan;
use crate::report::{Gated, Summary};
use givens::metrics::{
    AccuracySums, ConsistencySums, InnovationSums, Truth, chi_squared_cdf, chi_squared_quantile,
};
use givens::registry::Choice;
use givens::{Doubts, Estimates, Goal};
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
    doubts: Doubts,
    /// Rows with a measure that was taken in.
    taken: usize,
}

impl Sums {
    /// Of no rows by this method; `judged` if a report is made of them.
    pub fn new(plan: &Plan, choice: &Choice, judged: bool) -> Self {
        let accuracy = plan.truth.as_ref().map(|_| AccuracySums::new(plan.model.states.len()));
        let innovations = judged.then(|| InnovationSums::new(plan.model.measures()));
        Self { accuracy, innovations, doubts: Doubts::new(choice), ..Self::default() }
    }

    /// Adds rows of track `i`, the first of which is its row `from`, and states `at` other times. Those of one track follow each other. The truth of each, if
    /// there is one.
    pub fn add(
        &mut self,
        plan: &Plan,
        choice: &Choice,
        (i, from): (usize, usize),
        goal: Goal,
        est: &Estimates,
        at: &Estimates,
    ) -> Option<Truth> {
        self.rows += est.len();
        est.log_likelihood.iter().for_each(|x| self.log_likelihood += x);
        self.consistency.add(est);
        self.taken += est.nis_dof.iter().zip(&est.gated).filter(|(dof, gated)| **dof > 0 && !**gated).count();
        if let Some(sums) = &mut self.innovations {
            sums.add(i, from, est);
        }
        self.gated.add(i, from, est);
        doubts::add(&mut self.doubts, plan, choice, (i, from), est, at);
        let truth = plan.truth_at(i, goal, est.time.iter().copied());
        if let (Some(sums), Some(truth)) = (&mut self.accuracy, &truth) {
            sums.add(&est.mean, &est.cov, &truth.states);
        }
        truth
    }

    /// All of it, by a method with this gate.
    pub fn summary(&self, gate: Option<f64>) -> Summary {
        let mut consistency = self.consistency.consistency();
        let usual = usual(gate, consistency.dof as f64 / self.taken.max(1) as f64);
        consistency.band = (usual * consistency.band.0, usual * consistency.band.1);
        Summary {
            rows: self.rows,
            log_likelihood: self.log_likelihood,
            consistency,
            gated: self.gated.clone(),
            doubts: self.doubts.found().copied().collect(),
            accuracy: self.accuracy.as_ref().map(AccuracySums::accuracy),
        }
    }
}

/// The mean NIS per degree of freedom of a right model, of rows with so many degrees: less than one where a gate keeps the largest
/// out.
fn usual(gate: Option<f64>, dof: f64) -> f64 {
    match gate {
        Some(p) if dof > 0.0 => chi_squared_cdf(dof + 2.0, chi_squared_quantile(dof, p)) / p,
        _ => 1.0,
    }
}
