//! Numbers in messages.

use super::Real;
use core::fmt;

/// A number in words: its shortest digits that read back, or as many as are asked for behind the point; with an
/// exponent where they would be long.
///
/// ```
/// use givens_core::scalar::Shown;
/// assert_eq!(Shown(0.25).to_string(), "0.25");
/// assert_eq!(Shown(-1e300).to_string(), "-1e300");
/// assert_eq!(format!("{:.2} {:.2}", Shown(1e-9), Shown(1e99)), "0.00 1.00e99");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = Real::abs(self.0);
        let least = if f.precision().is_some() { 0.0 } else { 1e-5 };
        if size == 0.0 || !size.is_finite() || (least..1e16).contains(&size) {
            fmt::Display::fmt(&self.0, f)
        } else {
            fmt::LowerExp::fmt(&self.0, f)
        }
    }
}
