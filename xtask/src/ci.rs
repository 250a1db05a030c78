//! Everything that CI runs, one step after the other.

use crate::step::Step;
use crate::{say, tidy};
use core::time::Duration;
use std::path::Path;
use std::time::Instant;

/// All of them use one profile. Lints and documentation only check, and share what they check of the dependencies;
/// build, tests and the wheel share their build.
const STEPS: &[Step] = &[
    Step::cargo("format", "fmt --all --check"),
    Step::cargo("format of the peers", "fmt --manifest-path benchmarks/peers/Cargo.toml --check"),
    Step::cargo("format of the embedded example", "fmt --manifest-path examples/embedded/Cargo.toml --check"),
    Step::cargo(
        "lints",
        "clippy --workspace --all-targets --features givens-tests/reports,givens-benchmarks/scaling -- -D warnings",
    ),
    Step::cargo(
        "lints of the embedded example",
        "clippy --quiet --manifest-path examples/embedded/Cargo.toml --target-dir target/embedded --locked -- -D warnings",
    ),
    Step::cargo("documentation", "doc --workspace --no-deps").with_env(&[("RUSTDOCFLAGS", "-D warnings")]),
    Step::cargo("givens-core without std", "build -p givens-core --no-default-features"),
    Step::cargo("build", "test --workspace --no-run"),
    Step::cargo("tests", "test --workspace --no-fail-fast"),
    Step::cargo("dependencies", "xtask dependencies"),
    Step::cargo("embedded", "xtask embedded"),
    Step::cargo("instructions", "xtask instructions --where-valgrind-is"),
    Step::of("python: environment", "python3", "-m venv --clear target/python"),
    Step::python("python: what the checks need", "-m pip install -q -r python/requirements-ci.txt"),
    Step::python(
        "python: wheel",
        "-m maturin build -q --out target/python/wheels --interpreter target/python/bin/python",
    ),
    Step::python(
        "python: installation",
        "-m pip install -q --no-index --no-deps --find-links target/python/wheels givens",
    ),
    Step::python("python: lints", "-m ruff check python benchmarks/python"),
    Step::python("python: layout", "-m ruff format --check python benchmarks/python"),
    Step::python("python: types", "-m mypy --strict python/givens python/examples"),
    Step::python("python: stubs", "-m mypy.stubtest givens._native"),
    Step::python("python: tests", "-m pytest -q python/tests"),
    Step::python("python: documentation", "-m sphinx -q -W --keep-going python/docs target/python/docs"),
];

/// The peers' crates are not fetched for this: it is for where `cargo xtask bench --prepare` has built them.
const PEERS: Step = Step::cargo(
    "lints of the peers",
    "clippy --quiet --manifest-path benchmarks/peers/Cargo.toml --target-dir target/benchmarks/peers-lints --locked --offline -- -D warnings",
);

/// Runs every step, also after one that failed, and tells how each went; whether all went well.
pub fn run(root: &Path) -> bool {
    let mut done = Vec::new();
    done.push(timed("tidy", || tidy::run(root)));
    for step in STEPS {
        done.push(timed(step.title, || step.run(root)));
    }
    if root.join("target/benchmarks/peers").exists() {
        done.push(timed(PEERS.title, || PEERS.run(root)));
    }
    heading("ci");
    for (title, good, time) in &done {
        say(&format!("{:<6} {title} ({:.0} s)", if *good { "ok" } else { "FAILED" }, time.as_secs_f64()));
    }
    done.iter().all(|(_, good, _)| *good)
}

fn timed(title: &'static str, work: impl FnOnce() -> bool) -> (&'static str, bool, Duration) {
    heading(title);
    let begin = Instant::now();
    let good = work();
    (title, good, begin.elapsed())
}

fn heading(title: &str) {
    say(&format!("\n=== {title} {}", "=".repeat(70_usize.saturating_sub(title.len()))));
}
