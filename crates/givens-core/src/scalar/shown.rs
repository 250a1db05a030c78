//! Numbers in messages.

use super::Real;
use core::fmt;

/// A number in words: its shortest digits that read back, with an exponent where they would be long.
///
/// ```
/// use givens_core::scalar::Shown;
/// assert_eq!(Shown(0.25).to_string(), "0.25");
/// assert_eq!(Shown(-1e300).to_string(), "-1e300");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = Real::abs(self.0);
        if size == 0.0 || !size.is_finite() || (1e-5..1e16).contains(&size) {
            fmt::Display::fmt(&self.0, f)
        } else {
            fmt::LowerExp::fmt(&self.0, f)
        }
    }
}
