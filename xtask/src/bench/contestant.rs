//! A contestant at work: a process that prepares, and runs the workload once for each line that it is sent.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A process that is ready.
pub struct Process {
    child: Child,
    say: Option<ChildStdin>,
    hear: BufReader<ChildStdout>,
    /// What it told about itself.
    pub told: Told,
}

/// What a contestant tells before it runs.
#[derive(Debug, Default, PartialEq)]
pub struct Told {
    pub version: String,
    /// Filter steps in one repetition.
    pub steps: f64,
    pub result: Vec<f64>,
}

/// Nanoseconds of one repetition.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Of the processor.
    pub cpu: f64,
    /// That have passed.
    pub wall: f64,
}

impl Process {
    /// Starts a command and waits until it is ready. In words why it does not run.
    pub fn start(mut command: Command) -> Result<Self, String> {
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().map_err(|error| error.to_string())?;
        let (say, hear) = (child.stdin.take(), child.stdout.take());
        let mut hear = BufReader::new(hear.ok_or("no standard output")?);
        match Told::read(&mut hear) {
            Ok(told) => Ok(Self { child, say, hear, told }),
            Err(Some(reason)) => {
                drop(say);
                let _ = child.wait();
                Err(reason)
            }
            Err(None) => {
                drop(say);
                let out = child.wait_with_output().map_err(|error| error.to_string())?;
                let words = String::from_utf8_lossy(&out.stderr);
                let last = words.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("no word");
                Err(format!("ended before it was ready ({}): {last}", out.status))
            }
        }
    }

    /// One repetition.
    pub fn repetition(&mut self) -> Result<Sample, String> {
        let say = self.say.as_mut().ok_or("closed")?;
        say.write_all(b"\n").and_then(|()| say.flush()).map_err(|error| error.to_string())?;
        let mut line = String::new();
        self.hear.read_line(&mut line).map_err(|error| error.to_string())?;
        let mut numbers = line.split_whitespace().filter_map(|word| word.parse().ok());
        match (numbers.next(), numbers.next()) {
            (Some(cpu), Some(wall)) => Ok(Sample { cpu, wall }),
            _ => Err("ended in a repetition".to_owned()),
        }
    }

    /// Ends it.
    pub fn end(mut self) {
        drop(self.say.take());
        let _ = self.child.wait();
    }
}

impl Told {
    /// Reads until `ready`; the reason if it lacks the workload, nothing if it ended.
    fn read(lines: &mut impl BufRead) -> Result<Self, Option<String>> {
        let mut told = Self::default();
        for line in lines.lines() {
            let line = line.map_err(|error| Some(error.to_string()))?;
            match line.split_once('\t') {
                Some(("version", version)) => version.clone_into(&mut told.version),
                Some(("steps", steps)) => told.steps = steps.parse().map_err(|_| None)?,
                Some(("result", numbers)) => {
                    let numbers = numbers.split(' ').map(str::parse).collect::<Result<_, _>>();
                    told.result = numbers
                        .map_err(|error| Some(format!("its result is no list of numbers: {error}")))?;
                }
                Some(("lacks", reason)) => return Err(Some(reason.to_owned())),
                Some(("ready", _)) => return Ok(told),
                // a library that greets
                _ => {}
            }
        }
        Err(None)
    }
}

#[cfg(test)]
mod tests {
    use super::Told;

    #[test]
    fn a_contestant_tells_its_version_its_steps_and_its_result() {
        let told =
            Told::read(&mut "hello\nversion\tx 1\nsteps\t10\nresult\t1 2e3\nready\t\n".as_bytes()).unwrap();
        assert_eq!(told, Told { version: "x 1".to_owned(), steps: 10.0, result: vec![1.0, 2000.0] });
    }

    #[test]
    fn one_that_lacks_the_workload_says_why_and_one_that_ends_says_nothing() {
        assert_eq!(Told::read(&mut "lacks\tno smoother\n".as_bytes()), Err(Some("no smoother".to_owned())));
        assert_eq!(Told::read(&mut "version\t1\n".as_bytes()), Err(None));
    }
}
