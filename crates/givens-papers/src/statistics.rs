//! What a sample says, and how far two samples may be apart.

use crate::Estimate;
use givens::simulate::Stream;
use statrs::distribution::{Binomial, ContinuousCDF, Discrete, DiscreteCDF, Hypergeometric, Normal};

/// Fewer runs tell no spread.
pub(crate) const FEWEST: usize = 10;

/// √(Σ x / len), the root of the mean of squares that are given.
pub(crate) fn root_mean(squares: impl IntoIterator<Item = f64>) -> f64 {
    mean(squares).sqrt()
}

/// Σ x / len.
pub(crate) fn mean(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0usize);
    for x in numbers {
        sum += x;
        count += 1;
    }
    sum / count as f64
}

/// The standard deviation of a statistic of `runs` over samples of their own size, by the bootstrap; not a number for fewer
/// than [`FEWEST`].
pub(crate) fn spread<T>(runs: &[T], statistic: impl Fn(&mut dyn Iterator<Item = &T>) -> f64) -> f64 {
    const AGAIN: u32 = 200;
    if runs.len() < FEWEST {
        return f64::NAN;
    }
    let draw = |again: u32| {
        let mut stream = Stream::new(0xb007, 0, again);
        let mut uniform = || Normal::standard().cdf(stream.normal());
        let one = |_| &runs[((uniform() * runs.len() as f64) as usize).min(runs.len() - 1)];
        statistic(&mut (0..runs.len()).map(one))
    };
    let all: Vec<f64> = (0..AGAIN).map(draw).filter(|x| x.is_finite()).collect();
    // the samples vary about their own mean, which is too little by this
    let few = runs.len() as f64 / (runs.len() as f64 - 1.0);
    deviation(&all) * few.sqrt()
}

/// The standard deviation of a sample.
fn deviation(sample: &[f64]) -> f64 {
    let middle = mean(sample.iter().copied());
    (sample.iter().map(|x| (x - middle).powi(2)).sum::<f64>() / (sample.len() as f64 - 1.0)).sqrt()
}

/// The root of the mean of squares, and the standard deviation of one such replication.
pub(crate) fn root_of(squares: impl IntoIterator<Item = f64>) -> Estimate {
    let squares: Vec<f64> = squares.into_iter().collect();
    let value = root_mean(squares.iter().copied());
    Estimate { value, error: spread(&squares, |sample| root_mean(sample.copied())) }
}

/// The mean and its standard error.
pub(crate) fn mean_of(numbers: impl IntoIterator<Item = f64>) -> Estimate {
    let all: Vec<f64> = numbers.into_iter().collect();
    let error = if all.len() < FEWEST { f64::NAN } else { deviation(&all) / (all.len() as f64).sqrt() };
    Estimate { value: mean(all.iter().copied()), error }
}

/// √(p (1 − p) / n), the binomial standard error of the share of `hits` among `of`.
pub(crate) fn share_error(hits: usize, of: usize) -> f64 {
    let share = hits as f64 / of as f64;
    (share * (1.0 - share) / of as f64).sqrt()
}

/// How far a count lies from what a rate makes likely, in standard deviations of a normal with the same exact binomial
/// probability: above zero where there are more.
pub(crate) fn binomial_z(hits: usize, of: usize, rate: f64) -> f64 {
    let Ok(chances) = Binomial::new(rate, of as u64) else { return f64::NAN };
    let up_to = chances.cdf(hits as u64);
    let from = hits.checked_sub(1).map_or(1.0, |fewer| chances.sf(fewer as u64));
    let z = |tail: f64| -Normal::standard().inverse_cdf(tail.clamp(1e-300, 0.5));
    if from < up_to { z(from) } else { -z(up_to) }
}

/// The probability, if both have the same rate, of two counts at least as unlikely as these [hits, misses]: Fisher's exact
/// test, two-sided.
pub(crate) fn fisher(a: [usize; 2], b: [usize; 2]) -> f64 {
    let (hits, of_a, all) = (a[0] + b[0], a[0] + a[1], a[0] + a[1] + b[0] + b[1]);
    let Ok(chances) = Hypergeometric::new(all as u64, hits as u64, of_a as u64) else { return 1.0 };
    // by logarithms: the binomial coefficients of some thousand runs overflow
    let chance = |k: usize| chances.ln_pmf(k as u64).exp();
    let seen = chance(a[0]);
    let least = (hits + of_a).saturating_sub(all);
    let unlikely = (least..=hits.min(of_a)).map(chance).filter(|&p| p <= seen * (1.0 + 1e-9));
    unlikely.sum::<f64>().min(1.0)
}

/// The distance, in standard deviations of a normal, that is exceeded on either side with this probability.
pub(crate) fn z_of(p: f64) -> f64 {
    if p >= 1.0 { 0.0 } else { -Normal::standard().inverse_cdf((p / 2.0).max(1e-300)) }
}

/// The probability of more than z standard deviations on either side.
#[cfg(test)]
pub(crate) fn normal_two_sided(z: f64) -> f64 {
    2.0 * Normal::standard().cdf(-z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bootstrap_finds_the_spread_of_a_mean() {
        let mut stream = Stream::new(1, 0, 0);
        let runs: Vec<f64> = (0..4000).map(|_| stream.normal()).collect();
        let found = spread(&runs, |sample| mean(sample.copied())) * 4000f64.sqrt();
        assert!((found - 1.0).abs() < 0.2, "{found}");
    }

    #[test]
    fn of_few_runs_too_the_bootstrap_finds_the_standard_error_on_average() {
        // without √(n/(n−1)) it would be 5 % low; 400 samples of 10, each known to some 25 %
        let one = |seed: u64| {
            let mut stream = Stream::new(seed, 1, 0);
            let runs: Vec<f64> = (0..10).map(|_| stream.normal()).collect();
            spread(&runs, |sample| mean(sample.copied())).powi(2)
        };
        let found = mean((0..400).map(one)) * 10.0;
        assert!((found - 1.0).abs() < 0.1, "{found}");
        assert!(spread(&[1.0; 9], |sample| mean(sample.copied())).is_nan());
    }

    #[test]
    fn a_binomial_count_is_as_far_off_as_its_tail_is_small() {
        // P(X ≥ 55) of 100 at one half is 0.1841, which a normal exceeds beyond 0.9
        assert!((binomial_z(55, 100, 0.5) - 0.9).abs() < 0.01);
        assert!((binomial_z(45, 100, 0.5) + 0.9).abs() < 0.01);
        assert!(binomial_z(450, 1000, 0.5) < -3.0);
        assert!(binomial_z(2, 2, 0.5) < 1.0, "two of two decide nothing");
        assert!(binomial_z(0, 0, 0.5).abs() < 1e-9);
        assert!((share_error(50, 100) - 0.05).abs() < 1e-15);
    }

    #[test]
    fn fishers_test_is_that_of_the_tea() {
        // the lady who tastes tea: 3 and 1 of 4 and 4; scipy.stats.fisher_exact gives 0.4857142857
        assert!((fisher([3, 1], [1, 3]) - 0.485_714_285_7).abs() < 1e-9);
        assert!((fisher([0, 100], [0, 100]) - 1.0).abs() < 1e-9);
        assert!((fisher([0, 2100], [0, 420]) - 1.0).abs() < 1e-9);
    }
}
