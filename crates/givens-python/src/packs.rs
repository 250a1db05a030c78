//! Many runs at once in packs, without the interpreter.

use core::num::NonZeroUsize;
use core::sync::atomic::{AtomicBool, Ordering};
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;

use givens::Outcome;
use givens::batch::{Batch, Track};
use pyo3::prelude::*;

use crate::errors::Input;
use crate::model::{Continuous, Discrete, Moves, Sensing};
use crate::run::Job;
use crate::watch::{PATIENCE, signals};

/// Whether these runs may share packs: by one method, after one thing, over models of one kind that are made of graphs alone.
pub fn alike(jobs: &[Job]) -> bool {
    let Some(first) = jobs.first() else { return false };
    let graphs = |job: &Job| {
        let moves = match &job.model.moves {
            Moves::Discrete(model) => model.functions().is_none(),
            Moves::Continuous(model) => model.functions().is_none(),
        };
        moves && job.model.sensing.functions().is_none()
    };
    jobs.iter().all(|job| (job.choice, job.goal) == (first.choice, first.goal) && graphs(job))
        && (jobs.iter().all(|job| matches!(job.model.moves, Moves::Discrete(_)))
            || jobs.iter().all(|job| matches!(job.model.moves, Moves::Continuous(_))))
}

/// Runs jobs that are [`alike`]; a signal cancels them.
pub fn run(py: Python<'_>, jobs: &[Job], threads: usize) -> PyResult<Vec<Outcome>> {
    let stop = Arc::new(AtomicBool::new(false));
    let done = py.detach(|| {
        let (send, receive) = mpsc::channel();
        thread::scope(|scope| {
            let (stop, work) = (&stop, move |stop: &Arc<AtomicBool>| all(jobs, threads, stop));
            // nobody listens after a signal
            let spawned = thread::Builder::new().spawn_scoped(scope, move || drop(send.send(work(stop))));
            spawned.map_err(|error| Input::plain(format!("no thread could be started: {error}")))?;
            loop {
                match receive.recv_timeout(PATIENCE) {
                    Ok(done) => return Ok(done),
                    Err(RecvTimeoutError::Timeout) => {
                        if let Err(error) = signals() {
                            stop.store(true, Ordering::Relaxed);
                            return Err(error);
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(
                            Input::plain("the threads of the runs have ended without an answer").into()
                        );
                    }
                }
            }
        })
    })?;
    let whole: Option<Vec<Outcome>> = done.into_iter().collect();
    whole.ok_or_else(|| Input::plain("the runs were cancelled").into())
}

/// What comes of each; nothing of those that were not done when they were stopped.
fn all(jobs: &[Job], threads: usize, stop: &Arc<AtomicBool>) -> Vec<Option<Outcome>> {
    let Some(first) = jobs.first() else { return Vec::new() };
    let batch = Batch {
        goal: first.goal,
        threads: NonZeroUsize::new(threads),
        cancel: Some(stop),
        ..Batch::default()
    };
    match &first.model.moves {
        Moves::Discrete(_) => {
            let models = jobs.iter().filter_map(|job| match &job.model.moves {
                Moves::Discrete(model) => Some(model),
                Moves::Continuous(_) => None,
            });
            let (of, models) = in_common(models, Discrete::origin);
            let models: Vec<_> = models.into_iter().map(|model| model.until(stop)).collect();
            first.choice.run_batch(&tracks(jobs, &of, &models), &batch)
        }
        Moves::Continuous(_) => {
            let models = jobs.iter().filter_map(|job| match &job.model.moves {
                Moves::Continuous(model) => Some(model),
                Moves::Discrete(_) => None,
            });
            let (of, models) = in_common(models, Continuous::origin);
            let models: Vec<_> = models.into_iter().map(|model| model.until(stop)).collect();
            first.choice.run_batch_continuous(&tracks(jobs, &of, &models), &batch)
        }
    }
}

/// The models of different graphs, and which of them each one is: those with other parameters go with it.
fn in_common<'m, M>(
    models: impl Iterator<Item = &'m M>,
    origin: impl Fn(&M) -> usize,
) -> (Vec<usize>, Vec<&'m M>) {
    let (mut seen, mut all) = (HashMap::new(), Vec::new());
    let which = |model: &'m M| {
        *seen.entry(origin(model)).or_insert_with(|| {
            all.push(model);
            all.len() - 1
        })
    };
    let of = models.map(which).collect();
    (of, all)
}

fn tracks<'j, M>(jobs: &'j [Job], of: &[usize], models: &'j [M]) -> Vec<Track<'j, M, Sensing>> {
    let (of_sensors, sensors) = in_common(jobs.iter().map(|job| &job.model.sensing), Sensing::origin);
    let track = |((job, &model), &sensor): ((&'j Job, &usize), &usize)| Track {
        model: &models[model],
        sensors: sensors[sensor],
        data: &job.data,
        prior: &job.prior,
        parameters: job.model.parameters(),
        at: job.at.as_deref().unwrap_or_default(),
    };
    jobs.iter().zip(of).zip(&of_sensors).map(track).collect()
}
