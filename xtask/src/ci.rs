//! Everything that CI runs, one step after the other.

use crate::{say, tidy};
use core::time::Duration;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// A step that is a call of cargo.
struct Step {
    title: &'static str,
    /// The words after `cargo`.
    words: &'static str,
    /// Flags for rustdoc.
    rustdoc: Option<&'static str>,
}

const fn cargo(title: &'static str, words: &'static str) -> Step {
    Step { title, words, rustdoc: None }
}

/// All of them use one profile. Lints and documentation only check, and share what they check of the dependencies;
/// the last two steps share their build.
const STEPS: &[Step] = &[
    cargo("format", "fmt --all --check"),
    cargo("lints", "clippy --workspace --all-targets -- -D warnings"),
    Step { rustdoc: Some("-D warnings"), ..cargo("documentation", "doc --workspace --no-deps") },
    cargo("givens-core without std", "build -p givens-core --no-default-features"),
    cargo("build", "test --workspace --no-run"),
    cargo("tests", "test --workspace --no-fail-fast"),
];

/// Runs every step, also after one that failed, and tells how each went; whether all went well.
pub fn run(root: &Path) -> bool {
    let mut done = Vec::new();
    done.push(step("tidy", || tidy::run(root)));
    for call in STEPS {
        done.push(step(call.title, || call.run(root)));
    }
    heading("ci");
    for (title, good, time) in &done {
        say(&format!("{:<6} {title} ({:.0} s)", if *good { "ok" } else { "FAILED" }, time.as_secs_f64()));
    }
    done.iter().all(|(_, good, _)| *good)
}

fn step(title: &'static str, work: impl FnOnce() -> bool) -> (&'static str, bool, Duration) {
    heading(title);
    let begin = Instant::now();
    let good = work();
    (title, good, begin.elapsed())
}

fn heading(title: &str) {
    say(&format!("\n=== {title} {}", "=".repeat(70_usize.saturating_sub(title.len()))));
}

impl Step {
    /// Calls the cargo that called us; whether it succeeded.
    fn run(&self, root: &Path) -> bool {
        let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        say(&format!("cargo {}", self.words));
        let mut command = Command::new(program);
        command.current_dir(root).args(self.words.split(' '));
        command.envs(self.rustdoc.map(|flags| ("RUSTDOCFLAGS", flags)));
        match command.status() {
            Ok(status) => status.success(),
            Err(error) => {
                say(&format!("cargo could not be run: {error}"));
                false
            }
        }
    }
}
