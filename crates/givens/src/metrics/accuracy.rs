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
}

impl Accuracy {
    /// Compares an estimate with the truth at its rows.
    pub fn of(est: &Estimates, truth: &Truth) -> Self {
        let n = est.states();
        let mut sums = vec![(0.0, 0usize, 0usize); n];
        let (mut nees_sum, mut dof_sum, mut count) = (0.0, 0usize, 0usize);
        for (row, truth) in truth.states.chunks_exact(n.max(1)).enumerate().take(est.len()) {
            let error: Vec<f64> = est.mean(row).iter().zip(truth).map(|(m, x)| m - x).collect();
            for (i, (sum, inside, rows)) in sums.iter_mut().enumerate() {
                if !error[i].is_nan() {
                    *sum += error[i] * error[i];
                    *inside += usize::from(error[i].abs() <= 2.0 * est.std(row, i));
                    *rows += 1;
                }
            }
            if let Some((value, dof)) = nees(&error, est.cov(row)) {
                nees_sum += value;
                dof_sum += dof;
                count += 1;
            }
        }
        let per = |total: f64, rows: usize| if rows == 0 { f64::NAN } else { total / rows as f64 };
        Self {
            rmse: sums.iter().map(|&(sum, _, rows)| per(sum, rows).sqrt()).collect(),
            coverage: sums.iter().map(|&(_, inside, rows)| per(inside as f64, rows)).collect(),
            rows: sums.iter().map(|&(.., rows)| rows).collect(),
            nees: per(nees_sum, count),
            nees_dof: per(dof_sum as f64, count),
        }
    }
}

/// eᵀ P⁻¹ e over the components of `error` that are not NaN, and its degrees of freedom: the rank of their
/// covariance. Infinite for an error in a direction without variance. `None` without any component, or when `cov`
/// is no covariance.
pub fn nees(error: &[f64], cov: &[f64]) -> Option<(f64, usize)> {
    let n = error.len();
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
