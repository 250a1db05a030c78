//! The χ² distribution, that NIS and NEES follow when a filter is right.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Beyond so many degrees of freedom no digit of a probability is left, and its series goes on without end.
const MANY: f64 = 1e10;

fn distribution(dof: f64) -> Option<ChiSquared> {
    ChiSquared::new(dof).ok().filter(|_| dof <= MANY)
}

/// The value that a χ² variable of `dof` degrees of freedom stays below with probability `p`.
///
/// NaN for no degrees of freedom, more than 10¹⁰ of them, or a probability outside [0, 1].
///
/// ```
/// assert!((givens::metrics::chi_squared_quantile(2.0, 0.95) - 5.991464547).abs() < 1e-8);
/// ```
pub fn chi_squared_quantile(dof: f64, p: f64) -> f64 {
    match distribution(dof) {
        Some(_) if p == 0.0 => 0.0,
        Some(_) if p == 1.0 => f64::INFINITY,
        Some(distribution) if (0.0..1.0).contains(&p) => bisect(&distribution, dof, p),
        _ => f64::NAN,
    }
}

/// The quantile between doubles next to each other: a generic inverse stops after a few digits, or runs below zero.
fn bisect(distribution: &ChiSquared, dof: f64, p: f64) -> f64 {
    let (mut low, mut high) = (0.0, dof.max(1.0));
    while distribution.cdf(high) < p && high.is_finite() {
        (low, high) = (high, 2.0 * high);
    }
    loop {
        let middle = low + (high - low) / 2.0;
        if middle <= low || middle >= high || high < f64::MIN_POSITIVE {
            return high;
        }
        if distribution.cdf(middle) < p { low = middle } else { high = middle }
    }
}

/// The probability that a χ² variable of `dof` degrees of freedom stays below `x`; NaN for no degrees of freedom, or more
/// than 10¹⁰, and for an `x` that is none.
pub fn chi_squared_cdf(dof: f64, x: f64) -> f64 {
    match distribution(dof) {
        // half of the smallest numbers is zero, which the library takes for no number of its range
        Some(_) if x < f64::MIN_POSITIVE => 0.0,
        Some(distribution) if !x.is_nan() => distribution.cdf(x),
        _ => f64::NAN,
    }
}

/// The central 95 % band of a χ² variable of `dof` degrees of freedom.
pub fn chi_squared_band(dof: f64) -> (f64, f64) {
    (chi_squared_quantile(dof, 0.025), chi_squared_quantile(dof, 0.975))
}

#[cfg(test)]
mod tests {
    use super::{chi_squared_band, chi_squared_cdf, chi_squared_quantile};

    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (dof, p, expected) in [
            (1.0, 0.025, 9.820_691_171_752_59e-4),
            (1.0, 0.975, 5.023_886_187_314_888),
            (2.0, 0.025, 0.050_635_615_968_579_75),
            (10.0, 0.975, 20.483_177_350_807_388),
        ] {
            let found = chi_squared_quantile(dof, p);
            assert!((found / expected - 1.0).abs() < 1e-9, "{dof} {p}: {found}");
        }
        assert_eq!(chi_squared_quantile(3.0, 0.0), 0.0);
        assert_eq!([5e-324, -1.0, f64::INFINITY].map(|x| chi_squared_cdf(2.0, x)), [0.0, 0.0, 1.0]);
        assert!(chi_squared_cdf(2.0, f64::NAN).is_nan());
        assert!(chi_squared_quantile(0.0, 0.5).is_nan() && chi_squared_quantile(1.0, 1.5).is_nan());
    }

    #[test]
    fn bands_exist_for_any_number_of_degrees() {
        for dof in (1..200).map(f64::from).chain([1e4, 1e6, 1e7]) {
            let (low, high) = chi_squared_band(dof);
            assert!(low < dof && dof < high, "{dof}: {low} {high}");
            assert!((chi_squared_cdf(dof, high) - 0.975).abs() < 1e-9, "{dof}");
        }
    }
}
