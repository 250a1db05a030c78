//! The `givens` command. stdout is data; all else goes to stderr. Exit codes: 0 done, 2 bad input (nothing written),
//! 1 a filter failed (what was finished is written).

mod args;
mod checkpoint;
mod columns;
mod commands;
mod doubts;
mod failure;
mod figure;
mod files;
mod gaps;
mod instants;
mod judgement;
mod message;
mod method;
mod numbers;
mod paths;
mod plan;
mod portion;
mod progress;
mod report;
mod session;
mod stdout;
mod streaming;
mod sums;
mod thin;
mod timetable;
mod trajectory;
mod truth;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let command = match args::Args::try_parse() {
        Ok(args) => args.command,
        Err(error) => return misused(&error),
    };
    let done = match command {
        args::Command::Filter(args) => commands::filter::filter(&args),
        args::Command::Smooth(args) => commands::filter::smooth(&args),
        args::Command::Simulate(args) => commands::simulate::simulate(&args),
        args::Command::Compare(args) => commands::compare::compare(&args),
        args::Command::Partition(args) => commands::partition::partition(&args),
        args::Command::Methods => commands::methods::methods(),
        args::Command::Reproduce(args) => commands::reproduce::reproduce(&args),
        args::Command::Check(args) => commands::check::check(&args),
        args::Command::Completions { shell } => commands::completions::completions(shell),
    };
    done.map_or_else(|stop| told(&stop), |()| ExitCode::SUCCESS)
}

fn told(stop: &message::Stop) -> ExitCode {
    message::say(&stop.message);
    ExitCode::from(stop.code)
}

/// Arguments that cannot be understood, or a question for help.
fn misused(error: &clap::Error) -> ExitCode {
    if let Some(stop) = args::of_smooth(error) {
        return told(&stop);
    }
    // what clap exits with: 0 for help and version, 2 for errors
    let code = u8::try_from(error.exit_code()).unwrap_or(2);
    let _ = error.print();
    ExitCode::from(code)
}
