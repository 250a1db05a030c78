//! The `givens` command. stdout is data; all else goes to stderr. Exit codes: 0 done, 2 bad input (nothing written),
//! 1 a filter failed (what was finished is written).

mod args;
mod commands;
mod failure;
mod figure;
mod files;
mod message;
mod method;
mod plan;
mod progress;
mod report;
mod session;
mod stdout;
mod timetable;
mod truth;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let done = match args::Args::parse().command {
        args::Command::Filter(args) => commands::filter::filter(&args),
        args::Command::Smooth(args) => commands::filter::smooth(&args),
        args::Command::Simulate(args) => commands::simulate::simulate(&args),
        args::Command::Compare(args) => commands::compare::compare(&args),
        args::Command::Methods => commands::methods::methods(),
        args::Command::Check(args) => commands::check::check(&args),
        args::Command::Completions { shell } => commands::completions::completions(shell),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(stop) => {
            message::say(&stop.message);
            ExitCode::from(stop.code)
        }
    }
}
