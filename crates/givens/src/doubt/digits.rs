//! Digits that a covariance, or a root of it, has lost.

use super::Doubt;
use crate::registry::{Choice, FormName};

/// What is less than so many ε of a standard deviation in a root, or of a variance, is wrong by a share that matters when the
/// rounding of it is left in.
const SHRUNK: f64 = 150.0;
/// The same of a variance given other states, times their number, whose rounding they add to.
const BOUND: f64 = 1e3;

/// What of a row's covariances is rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Digits {
    epsilon: f64,
    /// Whether the filter keeps a covariance, and no root of it.
    covariance: bool,
}

impl Digits {
    pub fn of(choice: &Choice) -> Self {
        Self { epsilon: choice.precision.epsilon(), covariance: choice.form == FormName::Covariance }
    }

    /// The doubts about a row, from its covariances before and after the update.
    pub fn lost(self, predicted: &[f64], filtered: &[f64]) -> impl Iterator<Item = Doubt> {
        let shrunk = self.shrunk(predicted, filtered).map(|component| Doubt::Shrunk { component });
        let bound = if self.covariance { self.bound(filtered) } else { None };
        shrunk.into_iter().chain(bound.map(|component| Doubt::Bound { component }))
    }

    /// The first state whose variance is a rounding of what it was before the update.
    fn shrunk(self, predicted: &[f64], filtered: &[f64]) -> Option<usize> {
        let n = states(filtered);
        let share = SHRUNK * self.epsilon;
        let share = if self.covariance { share } else { share * share };
        (0..n).map(|i| i * n + i).position(|at| filtered[at] < share * predicted[at])
    }

    /// The first state whose variance given those before it is a rounding of its variance: a pivot of the correlations.
    fn bound(self, cov: &[f64]) -> Option<usize> {
        let n = states(cov);
        let least = BOUND * n as f64 * self.epsilon;
        let mut root = vec![0.0; n * n];
        for i in 0..n {
            let own = cov[i * n + i];
            if own <= 0.0 {
                continue;
            }
            for j in 0..i {
                let (done, rest) = root.split_at(i * n);
                let pivot = done[j * n + j];
                let both = rest[..j].iter().zip(&done[j * n..]).map(|(x, y)| x * y).sum::<f64>();
                root[i * n + j] = if pivot > 0.0 { (cov[i * n + j] - both) / pivot } else { 0.0 };
            }
            let known: f64 = root[i * n..i * n + i].iter().map(|x| x * x).sum();
            let left = own - known;
            if left < least * own {
                return Some(i);
            }
            root[i * n + i] = left.sqrt();
        }
        None
    }
}

fn states(cov: &[f64]) -> usize {
    cov.len().isqrt()
}
