//! Estimates against a known truth.

use crate::Estimates;
use crate::kernels::{cholesky, solve_lower};

/// True states at some of the rows of an estimate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Truth {
    /// Rows × n; NaN where a state is not known.
    pub states: Vec<f64>,
}

/// Errors of an estimate against the truth, over the rows and states where that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// Root mean square error of each state; NaN where its truth is never known.
    pub rmse: Vec<f64>,
    /// Fraction of rows whose truth lies within 2σ, of each state.
    pub coverage: Vec<f64>,
    /// Number of compared rows, of each state.
    pub rows: Vec<usize>,
    /// Mean of eᵀ P⁻¹ e over the compared rows, of the states known there.
    pub nees: f64,
    /// Mean of the degrees of freedom of those: what `nees` should be.
    pub nees_dof: f64,
    /// Number of rows in these two means.
    pub nees_rows: usize,
}

impl Accuracy {
    /// Compares an estimate with the truth at its rows.
    pub fn of(est: &Estimates, truth: &Truth) -> Self {
        Self::of_rows(est.states(), &est.mean, &est.cov, &truth.states)
    }

    /// The same of plain numbers: rows × n means, rows × n × n covariances, and the true states, NaN where one is not
    /// known. Rows that one of them lacks are left out.
    pub fn of_rows(n: usize, mean: &[f64], cov: &[f64], truth: &[f64]) -> Self {
        let mut sums = AccuracySums::new(n);
        sums.add(mean, cov, truth);
        sums.accuracy()
    }

    /// The accuracy over all rows of several runs; `None` without any run.
    pub fn pooled(runs: impl IntoIterator<Item = Self>) -> Option<Self> {
        runs.into_iter().reduce(|a, b| {
            let mean = |a: (f64, usize), b: (f64, usize)| match (a.1, b.1) {
                (0, _) => b.0,
                (_, 0) => a.0,
                (m, n) => (a.0 * m as f64 + b.0 * n as f64) / (m + n) as f64,
            };
            let states = 0..a.rmse.len().min(b.rmse.len());
            let rows = |i: usize| (a.rows[i], b.rows[i]);
            let square = |i: usize| {
                let (m, n) = rows(i);
                mean((a.rmse[i] * a.rmse[i], m), (b.rmse[i] * b.rmse[i], n)).sqrt()
            };
            let covered = |i: usize| mean((a.coverage[i], rows(i).0), (b.coverage[i], rows(i).1));
            Self {
                rmse: states.clone().map(square).collect(),
                coverage: states.clone().map(covered).collect(),
                rows: states.map(|i| a.rows[i] + b.rows[i]).collect(),
                nees: mean((a.nees, a.nees_rows), (b.nees, b.nees_rows)),
                nees_dof: mean((a.nees_dof, a.nees_rows), (b.nees_dof, b.nees_rows)),
                nees_rows: a.nees_rows + b.nees_rows,
            }
        })
    }
}

/// The errors of a run whose rows come a few at a time.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AccuracySums {
    /// Of each state the sum of squares, the rows within 2σ, all rows.
    states: Vec<(f64, usize, usize)>,
    nees: f64,
    dof: usize,
    rows: usize,
}

impl AccuracySums {
    /// Nothing yet, of n `states`.
    pub fn new(states: usize) -> Self {
        Self { states: vec![(0.0, 0, 0); states], ..Self::default() }
    }

    /// Adds rows, as [`Accuracy::of_rows`] takes them.
    pub fn add(&mut self, mean: &[f64], cov: &[f64], truth: &[f64]) {
        let n = self.states.len();
        let rows = mean.chunks_exact(n.max(1)).zip(cov.chunks_exact((n * n).max(1)));
        for ((mean, cov), truth) in rows.zip(truth.chunks_exact(n.max(1))) {
            let error: Vec<f64> = mean.iter().zip(truth).map(|(m, x)| m - x).collect();
            for (i, (sum, inside, rows)) in self.states.iter_mut().enumerate() {
                if !error[i].is_nan() {
                    *sum += error[i] * error[i];
                    *inside += usize::from(error[i].abs() <= 2.0 * cov[i * n + i].max(0.0).sqrt());
                    *rows += 1;
                }
            }
            if let Some((value, dof)) = nees(&error, cov) {
                self.nees += value;
                self.dof += dof;
                self.rows += 1;
            }
        }
    }

    /// The accuracy over the rows so far.
    pub fn accuracy(&self) -> Accuracy {
        let per = |total: f64, rows: usize| if rows == 0 { f64::NAN } else { total / rows as f64 };
        let states = &self.states;
        Accuracy {
            rmse: states.iter().map(|&(sum, _, rows)| per(sum, rows).sqrt()).collect(),
            coverage: states.iter().map(|&(_, inside, rows)| per(inside as f64, rows)).collect(),
            rows: states.iter().map(|&(.., rows)| rows).collect(),
            nees: per(self.nees, self.rows),
            nees_dof: per(self.dof as f64, self.rows),
            nees_rows: self.rows,
        }
    }
}

/// eᵀ P⁻¹ e over the components of `error` that are not NaN, and its degrees of freedom: the rank of their
/// covariance. Infinite for an error in a direction without variance. `None` without any component, or when `cov`
/// is no covariance.
pub fn nees(error: &[f64], cov: &[f64]) -> Option<(f64, usize)> {
    let n = error.len();
    if cov.len() != n * n {
        return None;
    }
    let known: Vec<usize> = (0..n).filter(|&i| !error[i].is_nan()).collect();
    let k = known.len();
    let mut p: Vec<f64> = known.iter().flat_map(|&i| known.iter().map(move |&j| cov[i * n + j])).collect();
    let mut e: Vec<f64> = known.iter().map(|&i| error[i]).collect();
    if k == 0 || cholesky(&mut p, k).failed().is_some() {
        return None;
    }
    solve_lower(&p, k, &mut e);
    let rank = (0..k).filter(|&i| p[i * k + i] > 0.0).count();
    // what a deficient root cannot explain of the error has no variance
    for (row, &i) in known.iter().enumerate() {
        let explained: f64 = (0..=row).map(|j| p[row * k + j] * e[j]).sum();
        if (error[i] - explained).abs() > 1e-9 * error[i].abs() {
            return Some((f64::INFINITY, rank));
        }
    }
    Some((e.iter().map(|e| e * e).sum(), rank))
}

#[cfg(test)]
mod tests {
    use super::nees;

    #[test]
    fn an_error_without_variance_is_infinitely_improbable() {
        assert_eq!(nees(&[1.0, 0.0], &[4.0, 0.0, 0.0, 0.0]), Some((0.25, 1)));
        assert_eq!(nees(&[1.0, 0.5], &[4.0, 0.0, 0.0, 0.0]), Some((f64::INFINITY, 1)));
        assert_eq!(nees(&[f64::NAN, 3.0], &[4.0, 1.0, 1.0, 9.0]), Some((1.0, 1)));
        assert_eq!(nees(&[f64::NAN], &[4.0]), None);
    }
}
