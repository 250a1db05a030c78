//! The contestants' programs: built here, or found missing with a word on how to make them.

use super::options::Options;
use super::python;
use super::table::Contestant;
use crate::say;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where the programs are; for each that is not there, why.
pub struct Built {
    root: PathBuf,
    environments: PathBuf,
    ours: Result<PathBuf, String>,
    peers: Result<PathBuf, String>,
    cpp: Result<PathBuf, String>,
    python: Result<(), String>,
}

/// Builds what the options want.
pub fn all(root: &Path, target: &Path, options: &Options) -> Built {
    let environments = target.join("benchmarks");
    let left_out = || Err("left out (--no-peers)".to_owned());
    Built {
        root: root.to_owned(),
        ours: ours(root, target),
        peers: if options.peers { peers(root, &environments) } else { left_out() },
        cpp: if options.peers { cpp(root, &environments) } else { left_out() },
        python: if options.python { Ok(()) } else { Err("left out (--no-python)".to_owned()) },
        environments,
    }
}

/// Builds what the options want, makes the environments, and tells of each how that went.
pub fn prepare(root: &Path, target: &Path, options: &Options) -> Result<(), String> {
    let built = all(root, target, options);
    let programs =
        [("givens", &built.ours), ("the Rust peers", &built.peers), ("the C++ filters", &built.cpp)];
    let mut went: Vec<(String, Result<(), String>)> = Vec::new();
    for (name, program) in programs {
        went.push((name.to_owned(), program.as_ref().map(|_| ()).map_err(Clone::clone)));
    }
    for name in python::environments_of(root).iter().filter(|_| options.python) {
        say(&format!("the Python environment `{name}`"));
        let made = python::environment(root, &built.environments, name);
        went.push((format!("the Python environment `{name}`"), made));
    }
    let mut missing = 0;
    for (name, outcome) in &went {
        match outcome {
            Ok(()) => say(&format!("ready: {name}")),
            Err(reason) => {
                missing += 1;
                say(&format!("not there: {name}: {reason}"));
            }
        }
    }
    let word = "a race would go on without them, and name them on its page";
    if missing == 0 { Ok(()) } else { Err(format!("{missing} of {} are not there; {word}", went.len())) }
}

/// The cargo that called us.
pub fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Runs a command; in words why it failed.
pub fn done(command: &mut Command, what: &str) -> Result<(), String> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{what} failed: {status}")),
        Err(error) => Err(format!("{what}: {} cannot be run: {error}", command.get_program().display())),
    }
}

/// givens, in its release profile.
pub fn ours(root: &Path, target: &Path) -> Result<PathBuf, String> {
    ours_with(root, target, &[])
}

/// The same without what instructions are not counted of, which takes longest to compile.
pub fn ours_for_counting(root: &Path, target: &Path) -> Result<PathBuf, String> {
    ours_with(root, target, &["--no-default-features"])
}

/// The same with what the scaling study needs.
pub fn ours_for_scaling(root: &Path, target: &Path) -> Result<PathBuf, String> {
    ours_with(root, target, &["--no-default-features", "--features", "scaling"])
}

fn ours_with(root: &Path, target: &Path, words: &[&str]) -> Result<PathBuf, String> {
    let (package, mut build) = ("givens-benchmarks", cargo());
    build.current_dir(root).args(["build", "--release", "--quiet", "--package", package]).args(words);
    done(&mut build, "building givens")?;
    Ok(target.join("release").join(package))
}

/// The peers are a workspace of their own, built for this very machine.
pub fn peers(root: &Path, environments: &Path) -> Result<PathBuf, String> {
    let target = environments.join("peers");
    let mut build = cargo();
    build.current_dir(root.join("benchmarks/peers")).args(["build", "--release", "--quiet", "--locked"]);
    build.env("CARGO_TARGET_DIR", &target);
    done(&mut build, "building the Rust peers")?;
    Ok(target.join("release/peers"))
}

/// The filters in C++, one program, compiled again when one of its files is newer.
fn cpp(root: &Path, environments: &Path) -> Result<PathBuf, String> {
    let (sources, program) = (root.join("benchmarks/cpp"), environments.join("cpp"));
    let changed = |path: &Path| path.metadata().and_then(|data| data.modified()).ok();
    let files = std::fs::read_dir(&sources).map_err(|error| format!("{}: {error}", sources.display()))?;
    let newest = files.flatten().filter_map(|file| changed(&file.path())).max();
    if changed(&program) >= newest {
        return Ok(program);
    }
    std::fs::create_dir_all(environments).map_err(|error| error.to_string())?;
    let mut build = Command::new(std::env::var_os("CXX").unwrap_or_else(|| "c++".into()));
    build.args(["-std=c++17", "-O3", "-march=native", "-DNDEBUG", "-fno-math-errno"]);
    build.args(["-isystem", "/usr/include/eigen3", "-o"]).arg(&program).arg(sources.join("main.cpp"));
    done(&mut build, "compiling the C++ filters (a C++ compiler and Eigen 3.4, libeigen3-dev)")?;
    Ok(program)
}

impl Built {
    /// How a contestant is started, without the workload.
    pub fn command(&self, contestant: &Contestant) -> Result<Command, String> {
        let program = match contestant.program.as_str() {
            "ours" => &self.ours,
            "peers" => &self.peers,
            "cpp" => &self.cpp,
            script => return self.script(script, contestant),
        };
        let mut command = Command::new(program.as_ref().map_err(String::clone)?);
        command.arg(&contestant.word);
        Ok(command)
    }

    fn script(&self, script: &str, contestant: &Contestant) -> Result<Command, String> {
        self.python.clone()?;
        let interpreter = self.environments.join(&contestant.environment).join("bin/python");
        if !interpreter.exists() {
            let name = &contestant.environment;
            return Err(format!(
                "its environment `{name}` is not there; `cargo xtask bench --prepare` makes it, with network"
            ));
        }
        let mut command = Command::new(interpreter);
        command.arg(self.root.join("benchmarks/python").join(script)).arg(&contestant.word);
        // one thread, as the others
        for threads in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"] {
            command.env(threads, "1");
        }
        command.env("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1");
        command.env("JAX_PLATFORMS", "cpu").env("PYTHONDONTWRITEBYTECODE", "1");
        Ok(command)
    }
}
