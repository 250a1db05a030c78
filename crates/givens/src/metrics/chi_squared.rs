//! The χ² distribution, that NIS and NEES follow when a filter is right.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// The value that a χ² variable of `dof` degrees of freedom stays below with probability `p`.
///
/// NaN for no degrees of freedom or a probability outside [0, 1].
///
/// ```
/// assert!((givens::metrics::chi_squared_quantile(2.0, 0.95) - 5.991464547).abs() < 1e-8);
/// ```
pub fn chi_squared_quantile(dof: f64, p: f64) -> f64 {
    match ChiSquared::new(dof) {
        Ok(distribution) if (0.0..=1.0).contains(&p) => polish(&distribution, distribution.inverse_cdf(p), p),
        _ => f64::NAN,
    }
}

/// Newton steps on a quantile: a generic inverse stops after a few digits.
fn polish(distribution: &ChiSquared, start: f64, p: f64) -> f64 {
    use statrs::distribution::Continuous;
    let mut x = start;
    for _ in 0..4 {
        let slope = distribution.pdf(x);
        let next = x - (distribution.cdf(x) - p) / slope;
        if slope > 0.0 && next.is_finite() && next > 0.0 {
            x = next;
        }
    }
    x
}

/// The probability that a χ² variable of `dof` degrees of freedom stays below `x`; NaN for no degrees of freedom.
pub fn chi_squared_cdf(dof: f64, x: f64) -> f64 {
    ChiSquared::new(dof).map_or(f64::NAN, |distribution| distribution.cdf(x.max(0.0)))
}

/// The central 95 % band of a χ² variable of `dof` degrees of freedom.
pub fn chi_squared_band(dof: f64) -> (f64, f64) {
    (chi_squared_quantile(dof, 0.025), chi_squared_quantile(dof, 0.975))
}
