//! What a sample says, and how far two samples may be apart.

use givens::simulate::Stream;
use statrs::distribution::{ContinuousCDF, Discrete, Hypergeometric, Normal};

/// √(Σ x / len), the root of the mean of squares that are given.
pub(crate) fn root_mean(squares: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0usize);
    for square in squares {
        sum += square;
        count += 1;
    }
    (sum / count as f64).sqrt()
}

/// The standard deviation of a statistic of `runs` over samples of their own size, by the bootstrap.
pub(crate) fn spread(runs: &[f64], statistic: impl Fn(&mut dyn Iterator<Item = f64>) -> f64) -> f64 {
    const AGAIN: u32 = 200;
    let draw = |again: u32| {
        let mut stream = Stream::new(0xb007, 0, again);
        let mut uniform = || Normal::standard().cdf(stream.normal());
        let one = |_| runs[((uniform() * runs.len() as f64) as usize).min(runs.len() - 1)];
        statistic(&mut (0..runs.len()).map(one))
    };
    if runs.len() < 2 {
        return f64::NAN;
    }
    let all: Vec<f64> = (0..AGAIN).map(draw).filter(|x| x.is_finite()).collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    (all.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (all.len() as f64 - 1.0)).sqrt()
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
        let mean = |sample: &mut dyn Iterator<Item = f64>| {
            let (sum, count) = sample.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
            sum / count
        };
        let found = spread(&runs, mean) * 4000f64.sqrt();
        assert!((found - 1.0).abs() < 0.2, "{found}");
    }

    #[test]
    fn fishers_test_is_that_of_the_tea() {
        // the lady who tastes tea: 3 and 1 of 4 and 4; scipy.stats.fisher_exact gives 0.4857142857
        assert!((fisher([3, 1], [1, 3]) - 0.485_714_285_7).abs() < 1e-9);
        assert!((fisher([0, 100], [0, 100]) - 1.0).abs() < 1e-9);
        assert!((fisher([0, 2100], [0, 420]) - 1.0).abs() < 1e-9);
    }
}
