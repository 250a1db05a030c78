//! Words on stderr, and the reasons to stop.

use givens_io::InputErrors;
use std::io::{self, Write};

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

    /// Several filters failed, each in a message of its own.
    pub fn failures(messages: &[String]) -> Self {
        Self::failed(messages.join("\nerror: "))
    }

    /// The same with a remedy.
    pub fn help(self, help: impl AsRef<str>) -> Self {
        Self { message: format!("{}\n  help: {}", self.message, help.as_ref()), ..self }
    }
}

impl From<io::Error> for Stop {
    fn from(error: io::Error) -> Self {
        Self::failed(error.to_string())
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

/// A line on stderr. If nobody reads it, the work goes on.
pub fn say(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Lines about answers that may be wrong.
pub fn doubt(texts: &[String]) {
    for text in texts {
        say(&format!("doubt: {text}"));
    }
}

/// `1 row`, `2 rows`.
pub fn count(number: usize, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}s") }
}

/// A number with five digits; a dash if it is none.
pub fn digits(x: f64) -> String {
    match x.abs() {
        size if size.is_nan() => "-".to_owned(),
        size if size != 0.0 && !(1e-3..1e6).contains(&size) => format!("{x:.4e}"),
        0.0 => "0".to_owned(),
        size => format!("{x:.*}", (4 - size.log10().floor() as i32).max(0) as usize),
    }
}
