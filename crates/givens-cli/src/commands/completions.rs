//! `givens completions`.

use crate::args::Args;
use crate::message::Stop;
use crate::stdout;
use clap::CommandFactory;
use clap_complete::Shell;

/// Prints a completion script.
pub fn completions(shell: Shell) -> Result<(), Stop> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Args::command(), "givens", &mut script);
    stdout::write(|out| out.write_all(&script))
}
