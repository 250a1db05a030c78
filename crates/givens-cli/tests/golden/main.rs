//! Every golden scenario through the command: all rules, in both forms, as a filter and as each smoother.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../common/mod.rs"]
mod common;
mod compare;
mod continuous;
mod discrete;
mod scenario;

use common::{Folder, golden};
use scenario::Scenario;

macro_rules! scenarios {
    ($($name:ident),* $(,)?) => {
        /// A test each.
        const SCENARIOS: &[&str] = &[$(stringify!($name)),*];
        $(
            #[test]
            fn $name() {
                Scenario::read(stringify!($name)).check();
            }
        )*
    };
}

scenarios!(
    missing,
    crossing,
    degrees,
    three_d,
    driven,
    fixed_step,
    known_state,
    duplicated_state,
    no_noise,
    growing_rank,
    contracting,
    reentry,
    prediction_rows,
    one_time,
    innovation_fails,
    posterior_fails,
    predicted_fails,
    conditional_fails,
);

#[test]
fn no_scenario_is_left_out() {
    let folders = std::fs::read_dir(golden()).unwrap().map(|entry| entry.unwrap());
    let named = folders.filter(|entry| entry.path().join("expected.json").exists());
    for entry in named {
        let name = entry.file_name().into_string().unwrap();
        assert!(SCENARIOS.contains(&name.as_str()), "`{name}` has no test");
    }
}

/// Arguments that run a scenario: `command MODEL DATA --format jsonl` and what stands in `more`.
fn arguments(command: &str, name: &str, data: &str, more: &[String]) -> Vec<String> {
    let model = golden().join(name).join("model.toml").to_str().unwrap().to_owned();
    let mut args =
        vec![command.to_owned(), model, data.to_owned(), "--format".to_owned(), "jsonl".to_owned()];
    args.extend_from_slice(more);
    args
}

fn run(folder: &Folder, args: &[String]) -> common::Run {
    folder.run_args(&args.iter().map(String::as_str).collect::<Vec<_>>())
}

/// The forms of a filter, as settings.
const FORMS: [&[&str]; 3] =
    [&["form=covariance"], &["form=square-root"], &["form=square-root", "update=separate"]];

/// Settings as arguments.
fn set(settings: impl IntoIterator<Item = String>) -> Vec<String> {
    settings.into_iter().flat_map(|setting| ["--set".to_owned(), setting]).collect()
}
