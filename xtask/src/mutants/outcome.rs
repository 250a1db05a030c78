//! What became of mutants, kept in a file as it is known.

use super::list::Mutant;
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It does not compile.
    Unviable,
    /// It is in a constant, which cannot be switched.
    Constant,
    /// A program failed.
    Fell(String),
    /// A program did not end.
    Endless(String),
    /// No program of this stage failed; those of the next ones are to be asked.
    Passed(usize),
    /// No test of the programs runs its function.
    NotAsked,
    Survives,
}

impl Outcome {
    fn word(&self) -> String {
        match self {
            Self::Unviable => "unviable".to_owned(),
            Self::Constant => "constant".to_owned(),
            Self::Fell(program) => format!("fell:{program}"),
            Self::Endless(program) => format!("endless:{program}"),
            Self::Passed(stage) => format!("passed:{stage}"),
            Self::NotAsked => "not-asked".to_owned(),
            Self::Survives => "survives".to_owned(),
        }
    }

    fn of(word: &str) -> Option<Self> {
        Some(match word.split_once(':') {
            Some(("fell", program)) => Self::Fell(program.to_owned()),
            Some(("endless", program)) => Self::Endless(program.to_owned()),
            Some(("passed", stage)) => Self::Passed(stage.parse().ok()?),
            _ => match word {
                "unviable" => Self::Unviable,
                "constant" => Self::Constant,
                "not-asked" => Self::NotAsked,
                "survives" => Self::Survives,
                _ => return None,
            },
        })
    }

    /// Whether no test saw it.
    pub fn unseen(&self) -> bool {
        matches!(self, Self::Survives | Self::NotAsked)
    }
}

/// The outcomes of a group, one a line, by the mutants' names.
#[derive(Debug)]
pub struct Record {
    path: PathBuf,
    file: Option<File>,
    pub outcomes: BTreeMap<String, Outcome>,
}

impl Record {
    /// What is known; `again` forgets who survived.
    pub fn open(path: &Path, again: bool) -> Self {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let line = |line: &str| {
            let (word, name) = line.split_once(' ')?;
            Some((name.to_owned(), Outcome::of(word)?))
        };
        let mut outcomes: BTreeMap<String, Outcome> = text.lines().filter_map(line).collect();
        if again {
            outcomes.retain(|_, outcome| !outcome.unseen());
        }
        Self { path: path.to_path_buf(), file: None, outcomes }
    }

    /// Whether a stage of tests is to be asked about a mutant.
    pub fn is_open(&self, mutant: &Mutant, stage: usize) -> bool {
        match self.outcomes.get(&mutant.name) {
            None => true,
            Some(&Outcome::Passed(passed)) => passed < stage,
            Some(_) => false,
        }
    }

    pub fn add(&mut self, mutant: &Mutant, outcome: &Outcome) -> Result<(), String> {
        let told = |error: std::io::Error| format!("{}: {error}", self.path.display());
        if self.file.is_none() {
            self.file = Some(OpenOptions::new().append(true).create(true).open(&self.path).map_err(told)?);
        }
        if let Some(file) = &mut self.file {
            writeln!(file, "{} {}", outcome.word(), mutant.name).map_err(told)?;
        }
        self.outcomes.insert(mutant.name.clone(), outcome.clone());
        Ok(())
    }
}
