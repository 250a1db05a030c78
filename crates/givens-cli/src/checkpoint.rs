//! What a run keeps of itself, so that it may be broken off and gone on with: `--resume`.

use crate::args::FilterArgs;
use crate::files;
use crate::message::{Stop, say};
use crate::plan::Plan;
use core::time::Duration;
use givens::batch::InstructionSet;
use givens::registry::Choice;
use givens_io::{Format, Identity, Journal, Model};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The checkpoint of a run, which lies beside its output.
pub struct Checkpoint {
    journal: Journal,
    identity: Identity,
    every: Duration,
    last: Instant,
}

impl Checkpoint {
    /// Where it lies.
    pub fn path(output: &Path) -> PathBuf {
        let mut path = output.to_owned().into_os_string();
        path.push(".checkpoint");
        PathBuf::from(path)
    }

    /// Refuses an output that cannot be gone on with; without `--resume`, one that another run may go on with.
    pub fn check(output: Option<&Path>, resumable: bool) -> Result<(), Stop> {
        let Some(output) = output.filter(|output| !files::is_standard(output)) else {
            return if resumable && output.is_some() {
                Err(Stop::input("-o -: standard output cannot be gone on with")
                    .help("name a file, or leave --resume out"))
            } else {
                Ok(())
            };
        };
        if resumable && output.exists() && !output.is_file() {
            let message = format!("-o {}: it is no file, and cannot be gone on with", output.display());
            return Err(Stop::input(message).help("name a file, or leave --resume out"));
        }
        let path = Self::path(output);
        if !resumable && path.is_file() {
            let message = format!("{}: a run was broken off that may be gone on with", path.display());
            return Err(Stop::input(message).help("add --resume, or remove the file"));
        }
        Ok(())
    }

    /// Opens it, and reads what a run that was broken off has left there.
    pub fn open<T: DeserializeOwned>(
        output: &Path,
        identity: Identity,
        every: Duration,
    ) -> Result<(Self, Vec<T>), Stop> {
        let opened = Journal::open(&Self::path(output), &identity);
        let (journal, left) = opened.map_err(|error| Stop::input(error.to_string()).help(&error.help))?;
        Ok((Self { journal, identity, every, last: Instant::now() }, left))
    }

    /// Whether it is time to write it again.
    pub fn is_due(&self) -> bool {
        self.last.elapsed() >= self.every
    }

    /// Adds what was done since.
    pub fn append<T: Serialize>(&mut self, done: &T) -> io::Result<()> {
        let done = self.journal.append(done).and_then(|()| self.journal.settle());
        done.map_err(|error| self.told(&error))?;
        self.last = Instant::now();
        Ok(())
    }

    /// Writes where the run stands, in place of what was written before.
    pub fn replace<T: Serialize>(&mut self, stand: &T) -> io::Result<()> {
        let done = self.journal.replace(&self.identity, stand);
        done.map_err(|error| self.told(&error))?;
        self.last = Instant::now();
        Ok(())
    }

    fn told(&self, error: &io::Error) -> io::Error {
        io::Error::new(error.kind(), format!("its checkpoint {}: {error}", self.journal.path().display()))
    }

    /// Removes it: the output is whole.
    pub fn remove(self) {
        if let Err(error) = self.journal.remove() {
            say(&format!("the checkpoint, which is not needed any more, could not be removed: {error}"));
        }
    }
}

/// Everything on which the numbers of a run over many files depend, but for the files.
pub fn of_files(args: &FilterArgs, model: &Model, choice: &Choice, task: &str) -> Identity {
    let of = [
        ("version of givens", env!("CARGO_PKG_VERSION").to_owned()),
        ("machine", format!("{:?}", InstructionSet::best())),
        ("model file", model.fingerprint()),
        ("parameters", args.model.params.join(" ")),
        ("method", format!("{choice:?}")),
        ("data", args.data.clone()),
        ("task", format!("{task} {:?}", args.at)),
        ("format", format!("{:?} {:?}", args.format, args.layout)),
    ];
    of.map(|(name, value)| (name.to_owned(), value)).into()
}

/// Everything on which the numbers of a run depend; `task` is what it is to find out.
pub fn identity(args: &FilterArgs, plan: &Plan, task: &str, format: Format) -> Identity {
    let truth = plan.truth.as_ref().map_or("none", |truth| truth.fingerprint.as_str());
    let of = [
        ("version of givens", env!("CARGO_PKG_VERSION").to_owned()),
        ("machine", format!("{:?}", InstructionSet::best())),
        ("model file", plan.model.fingerprint()),
        ("parameters", args.model.params.join(" ")),
        ("method", format!("{:?}", plan.choice)),
        ("table of measurements", plan.tracks.fingerprint.clone()),
        ("truth", truth.to_owned()),
        ("task", format!("{task} {:?}", args.at)),
        ("format", format!("{format:?}")),
        ("report or figure", format!("{} {}", args.report.is_some(), args.plots.is_empty())),
    ];
    of.map(|(name, value)| (name.to_owned(), value)).into()
}
