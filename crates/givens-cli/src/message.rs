//! Words on stderr, and the reasons to stop.

use givens_io::{DestinationError, InputErrors};

/// Why the command stops, and its exit code.
#[derive(Debug)]
pub struct Stop {
    /// What to tell.
    pub message: String,
    /// 1: a filter failed; 2: bad input.
    pub code: u8,
}

impl Stop {
    /// Bad input: nothing was written.
    pub fn input(message: impl Into<String>) -> Self {
        Self { message: format!("error: {}", message.into()), code: 2 }
    }

    /// A filter failed: what was finished has been written.
    pub fn failed(message: impl Into<String>) -> Self {
        Self { message: format!("error: {}", message.into()), code: 1 }
    }
}

impl From<InputErrors> for Stop {
    fn from(errors: InputErrors) -> Self {
        let mut text: Vec<String> = errors.errors.iter().map(|error| format!("error: {error}")).collect();
        if errors.more > 0 {
            text.push(format!("and {} more of the kind", errors.more));
        }
        Self { message: text.join("\n"), code: 2 }
    }
}

impl From<DestinationError> for Stop {
    fn from(error: DestinationError) -> Self {
        Self::input(error.to_string())
    }
}

/// A line on stderr.
#[allow(clippy::print_stderr)]
pub fn say(text: &str) {
    eprintln!("{text}");
}
