//! The race: one repetition of each contestant, many times, so that all of them meet the same machine.

use super::agreement::{Distance, reference};
use super::contestant::{Process, Sample};
use super::table::{Contestant, Workload};
use crate::say;
use core::time::Duration;
use std::path::Path;
use std::process::Command;

/// How a workload is run.
pub struct Runner<'t> {
    pub workload: &'t Workload,
    pub inputs: &'t Path,
    pub rounds: usize,
    pub budget: Duration,
}

/// A contestant that is ready.
pub struct Ready<'t> {
    contestant: &'t Contestant,
    process: Process,
    distance: Distance,
}

/// What a contestant has reached.
pub struct Standing<'t> {
    pub contestant: &'t Contestant,
    pub version: String,
    pub distance: Distance,
    /// Whether it computes what the workload asks for.
    pub agrees: bool,
    /// Nanoseconds for each step, one sample a round.
    pub samples: Vec<Sample>,
}

/// Rounds that even a slow contestant runs.
const FEWEST: usize = 3;

impl<'t> Runner<'t> {
    /// Starts a contestant, and compares its result with the reference.
    pub fn start(&self, contestant: &'t Contestant, mut command: Command) -> Result<Ready<'t>, String> {
        let (right, states) = reference(self.inputs, &self.workload.name)?;
        command.arg(&self.workload.name).arg(self.inputs);
        let process = Process::start(command)?;
        let distance = Distance::of(&process.told.result, &right, states)?;
        say(&format!("  {}: {:.1e} σ from the reference", contestant.name, distance.worst()));
        Ok(Ready { contestant, process, distance })
    }

    /// Lets all of them take turns. Who breaks down is put to the absent.
    pub fn race(
        &self,
        mut running: Vec<Ready<'t>>,
        absent: &mut Vec<(&'t Contestant, String)>,
    ) -> Vec<Standing<'t>> {
        let mut samples: Vec<Vec<Sample>> = running.iter().map(|_| Vec::new()).collect();
        let mut spent = vec![Duration::ZERO; running.len()];
        let mut broken: Vec<Option<String>> = running.iter().map(|_| None).collect();
        // the first round warms up
        for round in 0..=self.rounds {
            for (k, one) in running.iter_mut().enumerate() {
                let tired = spent[k] > self.budget && samples[k].len() >= FEWEST;
                if broken[k].is_some() || tired {
                    continue;
                }
                match one.process.repetition() {
                    Ok(sample) => {
                        spent[k] += Duration::from_nanos(sample.wall as u64);
                        let steps = one.process.told.steps;
                        if round > 0 {
                            samples[k].push(Sample { cpu: sample.cpu / steps, wall: sample.wall / steps });
                        }
                    }
                    Err(reason) => broken[k] = Some(reason),
                }
            }
        }
        let mut standings = Vec::new();
        for ((one, samples), broken) in running.into_iter().zip(samples).zip(broken) {
            let Ready { contestant, process, distance } = one;
            match broken {
                Some(reason) => absent.push((contestant, reason)),
                None => standings.push(Standing {
                    contestant,
                    version: process.told.version.clone(),
                    distance,
                    agrees: distance.worst() <= contestant.tolerance.unwrap_or(self.workload.tolerance),
                    samples,
                }),
            }
            process.end();
        }
        standings
    }
}
