//! What a contestant of the benchmark says to the runner, and how it reads the inputs.
//!
//! A contestant is a program called with the name of a contestant, of a workload, and the folder of the inputs. It prepares,
//! and prints lines `word<TAB>value`: `version`, `steps` (filter steps in one repetition), `result` (numbers separated by
//! spaces) and `ready`; or `lacks` with the reason why it does not take part. Then, for each line on its standard input, it
//! runs the workload once and prints the time that its thread has used and the time that has passed, in nanoseconds.

mod clock;
mod inputs;
mod rows;
mod spread;

pub use clock::Stopwatch;
pub use inputs::{Inputs, Table};
pub use rows::Rows;
pub use spread::{Spread, duration};

use std::io::{BufRead, Write, stdin, stdout};

/// Anything that may go wrong in a contestant; the runner shows it.
pub type Failure = Box<dyn core::error::Error>;

/// A contestant that is ready to run.
pub struct Entry<'a> {
    /// Name and version of the library, or how it was built.
    pub version: String,
    /// Filter steps in one repetition.
    pub steps: usize,
    /// What the runner compares: for each reported row, means, then variances.
    pub result: Vec<f64>,
    /// One repetition, from the prior to the last estimate; what it gives back is only kept from being optimised away.
    pub go: Box<dyn FnMut() -> Result<f64, Failure> + 'a>,
}

/// Speaks to the runner until it closes the line.
///
/// # Errors
/// A repetition that fails, or a line that is broken.
pub fn serve(mut entry: Entry) -> Result<(), Failure> {
    let mut out = stdout().lock();
    writeln!(out, "version\t{}\nsteps\t{}", entry.version, entry.steps)?;
    let numbers: Vec<String> = entry.result.iter().map(|x| format!("{x:e}")).collect();
    writeln!(out, "result\t{}\nready\t", numbers.join(" "))?;
    out.flush()?;
    for line in stdin().lock().lines() {
        line?;
        let watch = Stopwatch::start();
        core::hint::black_box((entry.go)()?);
        let (thread, wall) = watch.nanoseconds();
        writeln!(out, "{thread} {wall}")?;
        out.flush()?;
    }
    Ok(())
}

/// Tells the runner that this contestant does not take part, and why.
///
/// # Errors
/// A line that is broken.
pub fn lacks(reason: &str) -> Result<(), Failure> {
    Ok(writeln!(stdout(), "lacks\t{reason}")?)
}

/// The words that a contestant is called with: its name, the workload's, and the inputs.
///
/// # Errors
/// Other words.
pub fn called_with() -> Result<(String, String, Inputs), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match <[String; 3]>::try_from(words) {
        Ok([contestant, workload, folder]) => Ok((contestant, workload, Inputs::in_folder(&folder))),
        Err(_) => Err("usage: CONTESTANT WORKLOAD INPUTS".into()),
    }
}

/// One repetition, in a function of its own by which an instruction counter knows what to count.
///
/// # Errors
/// A repetition that fails.
#[inline(never)]
pub fn counted_repetition(entry: &mut Entry) -> Result<f64, Failure> {
    (entry.go)()
}
