//! Numbers among the arguments, and the words for those that are none.

use core::num::{IntErrorKind, NonZeroUsize, ParseIntError};
use core::time::Duration;

/// A whole number.
pub fn whole(text: &str) -> Result<usize, String> {
    text.parse()
        .map_err(|error| too_large(&error).unwrap_or("must be a whole number, zero or above").to_owned())
}

/// A number of runs.
pub fn runs(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(runs) if runs > 0 => Ok(runs),
        Err(error) if too_large(&error).is_some() => Err("is too large a number of runs".to_owned()),
        _ => Err("must be a whole number above zero".to_owned()),
    }
}

/// A number of threads.
pub fn threads(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|error| {
        too_large(&error).unwrap_or("must be a whole number above zero; left out, all cores").to_owned()
    })
}

/// The words for a whole number that cannot be held.
fn too_large(error: &ParseIntError) -> Option<&'static str> {
    (*error.kind() == IntErrorKind::PosOverflow).then_some("is too large a number")
}

/// A seed.
pub fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "must be a whole number from 0 to 2^64 - 1".to_owned())
}

/// A time to wait.
pub fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds.ok_or_else(|| "must be a number of seconds, zero or above".to_owned())
}

/// A number.
pub fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "must be a number".to_owned())
}
