//! Two methods on the same runs.

use crate::estimate::{MANY, ONE, all};
use crate::statistics::{FEWEST, mean};
use crate::{Estimate, Verdict};

/// The mean square of each run; `None` where the method lost it.
pub(crate) type Squares = [Option<f64>];

/// The root-mean-square error of `a` over that of `b`, on the runs that both kept, with its standard error (that of the
/// logarithm, to first order).
pub(crate) fn ratio(a: &Squares, b: &Squares) -> Estimate {
    let both: Vec<(f64, f64)> = a.iter().zip(b).filter_map(|(a, b)| Some(((*a)?, (*b)?))).collect();
    let means = [mean(both.iter().map(|pair| pair.0)), mean(both.iter().map(|pair| pair.1))];
    let value = (means[0] / means[1]).sqrt();
    if both.len() < FEWEST {
        return Estimate { value, error: f64::NAN };
    }
    let count = both.len() as f64;
    let influence = |(a, b): &(f64, f64)| a / means[0] - b / means[1];
    let square = both.iter().map(influence).map(|x| x * x).sum::<f64>() / (count - 1.0);
    Estimate { value, error: 0.5 * value * (square / count).sqrt() }
}

/// By what share of the runs `a` loses more than `b`: from the runs that one of them loses alone, with one run more of either
/// kind (Bonett & Price), so that no loss at all is not taken for certainty.
pub(crate) fn more_lost(a: &Squares, b: &Squares) -> Estimate {
    let alone =
        |a: &Squares, b: &Squares| a.iter().zip(b).filter(|(a, b)| a.is_none() && b.is_some()).count();
    let (x, y, n) = (alone(a, b) as f64 + 1.0, alone(b, a) as f64 + 1.0, a.len().min(b.len()) as f64 + 2.0);
    let value = (x - y) / n;
    Estimate { value, error: ((x + y) / n - value * value).sqrt() / n.sqrt() }
}

/// Whether `a` is the better: it loses fewer runs or, if none is shown to lose more, errs less on those that both kept.
pub(crate) fn better(a: &Squares, b: &Squares, sigmas: f64) -> Verdict {
    match more_lost(b, a).above(0.0, sigmas) {
        Verdict::Undecided(_) => ratio(a, b).below(1.0, sigmas),
        shown => shown,
    }
}

/// Whether the errors are the same within a factor: several such comparisons.
pub(crate) fn alike(ratios: &[Estimate], factor: f64) -> Verdict {
    all(ratios.iter().map(|ratio| ratio.between([1.0 / factor, factor], MANY)))
}

/// The ratio that is farthest from one; the last of those that are none.
pub(crate) fn farthest(ratios: impl IntoIterator<Item = Estimate>) -> Option<Estimate> {
    let far = |ratio: &Estimate| ratio.value.ln().abs();
    ratios.into_iter().max_by(|a, b| far(a).total_cmp(&far(b)))
}

/// Whether one number of each run exceeds another on average.
pub(crate) fn exceeds(differences: impl IntoIterator<Item = f64>) -> Verdict {
    crate::statistics::mean_of(differences).above(0.0, ONE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::{FEW, NEAR, NOTHING};

    #[test]
    fn a_common_factor_has_no_spread() {
        let b: Vec<_> = (1..=20).map(|k| Some(f64::from(k))).collect();
        let a: Vec<_> = b.iter().map(|b| b.map(|b| 4.0 * b)).collect();
        let ratio = ratio(&a, &b);
        assert!((ratio.value - 2.0).abs() < 1e-15 && ratio.error < 1e-12);
        assert_eq!(alike(&[ratio], 1.1), Verdict::Fails);
    }

    #[test]
    fn runs_that_either_lost_are_left_out_of_both_errors() {
        let kept: Vec<_> = (0..12).map(|k| Some(1.0 + 0.01 * f64::from(k))).collect();
        let mut strayed = kept.clone();
        strayed.push(None);
        let with: Vec<_> = kept.iter().copied().chain([Some(1e9)]).collect();
        assert!((ratio(&with, &strayed).value - 1.0).abs() < 1e-15);
    }

    #[test]
    fn nothing_lost_is_no_difference() {
        let none = [Some(1.0); 100];
        assert_eq!(more_lost(&none, &none).above(0.0, ONE), Verdict::Undecided(NEAR));
        assert_eq!(more_lost(&none, &none).below(0.1, ONE), Verdict::Holds);
        assert_eq!(more_lost(&none[..5], &none[..5]).below(0.1, ONE), Verdict::Undecided(NEAR));
        let all = [None; 100];
        assert_eq!(better(&none, &all, ONE), Verdict::Holds);
        assert_eq!(better(&all, &none, ONE), Verdict::Fails);
        assert_eq!(better(&all, &all, ONE), Verdict::Undecided(NOTHING));
        assert_eq!(better(&none[..3], &none[..3], ONE), Verdict::Undecided(FEW));
    }

    #[test]
    fn one_lost_run_more_is_within_the_spread() {
        let mut one = vec![Some(1.0); 100];
        one[3] = None;
        assert_eq!(more_lost(&one, &[Some(1.0); 100]).above(0.0, ONE), Verdict::Undecided(NEAR));
    }
}
