//! A step of CI: a program and its words.

use crate::say;
use std::path::Path;
use std::process::Command;

/// A call of a program at the root of the repository.
pub struct Step {
    pub title: &'static str,
    program: &'static str,
    /// What follows the program's name, separated by single spaces.
    words: &'static str,
    env: &'static [(&'static str, &'static str)],
}

impl Step {
    pub const fn of(title: &'static str, program: &'static str, words: &'static str) -> Self {
        Self { title, program, words, env: &[] }
    }

    pub const fn cargo(title: &'static str, words: &'static str) -> Self {
        Self::of(title, "cargo", words)
    }

    /// The Python of the environment that CI makes for itself.
    pub const fn python(title: &'static str, words: &'static str) -> Self {
        Self::of(title, "target/python/bin/python", words)
    }

    pub const fn with_env(self, env: &'static [(&'static str, &'static str)]) -> Self {
        Self { env, ..self }
    }

    /// Whether the program ran and succeeded.
    pub fn run(&self, root: &Path) -> bool {
        say(&format!("{} {}", self.program, self.words));
        let mut command = match self.program {
            // the cargo that called us
            "cargo" => Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())),
            own if own.contains('/') => Command::new(root.join(own)),
            other => Command::new(other),
        };
        command.current_dir(root).args(self.words.split(' ')).envs(self.env.iter().copied());
        match command.status() {
            Ok(status) => status.success(),
            Err(error) => {
                say(&format!("{} could not be run: {error}", self.program));
                false
            }
        }
    }
}
