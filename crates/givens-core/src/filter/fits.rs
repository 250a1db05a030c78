//! Whether the numbers that a filter is given can be kept in numbers of its own kind.

use super::error::Fault;
use super::quantity::Quantity;
use crate::kernels::dot;
use crate::scalar::{Mask, Real};

/// Fails at the first number that is finite, and not so in `T`.
pub(super) fn fits<T: Real>(values: &[f64], quantity: Quantity) -> Result<(), Fault> {
    match values.iter().position(|x| x.is_finite() && !T::of(*x).finite().all()) {
        None => Ok(()),
        Some(component) => Err(Fault::Unrepresentable { quantity, component, value: values[component] }),
    }
}

/// Fails at the first component whose variance, from the covariance if there is one, is so large or so small that `T` has
/// not all of its digits.
pub(super) fn variances_fit<T: Real>(factor: &[f64], cov: &[f64]) -> Result<(), Fault> {
    let n = factor.len().isqrt();
    for component in 0..n {
        let row = &factor[component * n..][..=component];
        let value = cov.get(component * n + component).copied().unwrap_or_else(|| dot(row, row));
        let kept = T::of(value).first();
        if value.is_finite() && Real::abs(kept - value) > T::EPSILON * Real::abs(value) {
            return Err(Fault::Unrepresentable { quantity: Quantity::Variance, component, value });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_f32_cannot_keep_is_told() {
        let beyond = |quantity, component, value| Err(Fault::Unrepresentable { quantity, component, value });
        assert_eq!(fits::<f32>(&[1.0, -1e39], Quantity::Control), beyond(Quantity::Control, 1, -1e39));
        assert_eq!(fits::<f32>(&[f64::NAN, 3e38, 1e-60], Quantity::Control), Ok(()));
        assert_eq!(variances_fit::<f32>(&[1e-30], &[]), beyond(Quantity::Variance, 0, 1e-30 * 1e-30));
        assert_eq!(
            variances_fit::<f32>(&[0.0, 0.0, 0.0, 1e20], &[]),
            beyond(Quantity::Variance, 1, 1e20 * 1e20)
        );
        assert_eq!(variances_fit::<f32>(&[1.0], &[1e-40]), beyond(Quantity::Variance, 0, 1e-40));
        assert_eq!(variances_fit::<f32>(&[0.0, 0.0, 1.0, 1e-18], &[]), Ok(()));
    }

    #[test]
    fn all_fits_into_f64() {
        let most = f64::MAX;
        assert_eq!(fits::<f64>(&[most, f64::NAN, f64::INFINITY], Quantity::Estimate), Ok(()));
        assert_eq!(variances_fit::<f64>(&[1.0], &[5e-324]), Ok(()));
        assert_eq!(variances_fit::<f64>(&[1e200], &[]), Ok(()));
    }
}
