//! The initial belief.

use crate::kernels::cholesky;
use crate::scalar::Real;

/// Why a matrix is no covariance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InvalidCovariance {
    /// An element is not a finite number.
    NotFinite {
        /// Its row.
        row: usize,
        /// Its column.
        column: usize,
    },
    /// Two mirrored elements differ by more than rounding.
    Asymmetric {
        /// Row of the lower one.
        row: usize,
        /// Column of the lower one.
        column: usize,
    },
    /// A pivot is negative, or zero above a column that is not.
    Indefinite {
        /// The pivot, from zero.
        pivot: usize,
    },
    /// Its length is not the square of the state's.
    Length {
        /// The length it must have.
        expected: usize,
        /// The length it has.
        found: usize,
    },
}

impl core::fmt::Display for InvalidCovariance {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::NotFinite { row, column } => {
                write!(f, "element ({}, {}) is not a finite number", row + 1, column + 1)
            }
            Self::Asymmetric { row, column } => write!(
                f,
                "elements ({}, {}) and ({}, {}) differ: a covariance is symmetric",
                row + 1,
                column + 1,
                column + 1,
                row + 1
            ),
            Self::Indefinite { pivot } => {
                write!(f, "not positive semidefinite (pivot {})", pivot + 1)
            }
            Self::Length { expected, found } => write!(f, "expected {expected} elements, found {found}"),
        }
    }
}

impl core::error::Error for InvalidCovariance {}

/// The lower-triangular root of a given covariance, n × n, checked; semidefinite ones are legal. Elements above the diagonal
/// may differ from those below by 4096 ε of the standard deviations, about 1e-12: those below count.
///
/// # Errors
/// What makes it no covariance, and where.
pub fn factor_of_covariance<T: Real>(cov: &[T], n: usize, factor: &mut [T]) -> Result<(), InvalidCovariance> {
    let expected = n.saturating_mul(n);
    for found in [cov.len(), factor.len()] {
        if found != expected {
            return Err(InvalidCovariance::Length { expected, found });
        }
    }
    for row in 0..n {
        for column in 0..n {
            let (x, y) = (cov[row * n + column].first(), cov[column * n + row].first());
            if !x.is_finite() {
                return Err(InvalidCovariance::NotFinite { row, column });
            }
            let sigmas = cov[row * n + row].first() * cov[column * n + column].first();
            let size = Real::max(Real::max(Real::abs(x), Real::abs(y)), Real::sqrt(Real::abs(sigmas)));
            // products of matrices leave as much
            if column < row && Real::abs(x - y) > 4096.0 * T::EPSILON * size {
                return Err(InvalidCovariance::Asymmetric { row, column });
            }
        }
    }
    factor.copy_from_slice(cov);
    match cholesky(factor, n).failed() {
        Some(pivot) => Err(InvalidCovariance::Indefinite { pivot }),
        None => Ok(()),
    }
}

#[cfg(feature = "alloc")]
pub use owned::Gaussian;

#[cfg(feature = "alloc")]
mod owned {
    use super::{InvalidCovariance, factor_of_covariance};
    use alloc::vec;
    use alloc::vec::Vec;

    /// N(m, P), checked when made.
    ///
    /// ```
    /// use givens_core::filter::Gaussian;
    /// let prior = Gaussian::from_std(&[0.0, 1.0], &[10.0, 0.0])?;   // the second state is known exactly
    /// assert_eq!(prior.cov(), [100.0, 0.0, 0.0, 0.0]);
    /// assert!(Gaussian::from_cov(&[0.0, 0.0], &[1.0, 2.0, 2.0, 1.0]).is_err());
    /// # Ok::<(), givens_core::filter::InvalidCovariance>(())
    /// ```
    #[derive(Clone, Debug, PartialEq)]
    pub struct Gaussian {
        mean: Vec<f64>,
        cov: Vec<f64>,
        factor: Vec<f64>,
    }

    impl Gaussian {
        /// Independent components with these standard deviations (zero: known exactly).
        ///
        /// # Errors
        /// A mean or standard deviation that is not finite, a negative one, or lengths that differ.
        pub fn from_std(mean: &[f64], std: &[f64]) -> Result<Self, InvalidCovariance> {
            let n = mean.len();
            if std.len() != n {
                return Err(InvalidCovariance::Length { expected: n, found: std.len() });
            }
            if let Some(pivot) = std.iter().position(|s| *s < 0.0) {
                return Err(InvalidCovariance::Indefinite { pivot });
            }
            let mut cov = vec![0.0; n * n];
            let mut factor = vec![0.0; n * n];
            for (i, &s) in std.iter().enumerate() {
                cov[i * n + i] = s * s;
                factor[i * n + i] = s;
            }
            let exact = Self::from_cov(mean, &cov)?;
            Ok(Self { factor, ..exact })
        }

        /// A full covariance, n × n row by row; it may be semidefinite.
        ///
        /// # Errors
        /// What makes it no covariance, and where; a mean that is not finite counts as its diagonal element.
        pub fn from_cov(mean: &[f64], cov: &[f64]) -> Result<Self, InvalidCovariance> {
            let n = mean.len();
            if let Some(i) = mean.iter().position(|m| !m.is_finite()) {
                return Err(InvalidCovariance::NotFinite { row: i, column: i });
            }
            let mut factor = vec![0.0; n * n];
            factor_of_covariance(cov, n, &mut factor)?;
            Ok(Self { mean: mean.to_vec(), cov: cov.to_vec(), factor })
        }

        /// The mean, length n.
        pub fn mean(&self) -> &[f64] {
            &self.mean
        }
        /// The covariance, n × n.
        pub fn cov(&self) -> &[f64] {
            &self.cov
        }
        /// The lower-triangular root of the covariance, n × n.
        pub fn factor(&self) -> &[f64] {
            &self.factor
        }
    }
}
