//! Many runs at once, on threads without the interpreter.

use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use pyo3::prelude::*;

use crate::errors::{Input, Result};
use crate::watch::{PATIENCE, alone, detached, signals};

/// The number of threads: as many as the machine has where none is said.
pub fn threads(asked: Option<usize>) -> Result<usize> {
    match asked {
        Some(0) => Err(Input::new("threads", "`threads` is 0: at least one thread does the work").into()),
        Some(threads) => Ok(threads),
        None => Ok(thread::available_parallelism().map_or(1, usize::from)),
    }
}

/// An exception that has ended all jobs: in one of them, with what came of that, or a signal.
pub struct Ended<R> {
    pub raised: PyErr,
    pub job: Option<(usize, R)>,
}

/// Does the jobs 0 … count − 1, each as a run of its own, and gives what comes of them in order.
pub fn each<R: Send>(
    py: Python<'_>,
    count: usize,
    threads: usize,
    job: impl Fn(usize) -> R + Sync,
) -> core::result::Result<Vec<R>, Ended<R>> {
    if count.min(threads) <= 1 {
        let mut done = Vec::with_capacity(count);
        for k in 0..count {
            let (result, raised) = detached(py, || job(k));
            if let Some(raised) = raised {
                return Err(Ended { raised, job: Some((k, result)) });
            }
            done.push(result);
        }
        return Ok(done);
    }
    let (stop, next) = (Arc::new(AtomicBool::new(false)), AtomicUsize::new(0));
    let ended: Mutex<Option<Ended<R>>> = Mutex::new(None);
    let note = |raised: PyErr, job: Option<(usize, R)>| {
        stop.store(true, Ordering::Relaxed);
        ended.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(Ended { raised, job });
    };
    let mut done: Vec<Option<R>> = py.detach(|| {
        let (send, receive) = mpsc::channel();
        thread::scope(|scope| {
            for _ in 0..threads.min(count) {
                let (send, stop, next, job, note) = (send.clone(), &stop, &next, &job, &note);
                scope.spawn(move || {
                    loop {
                        let k = next.fetch_add(1, Ordering::Relaxed);
                        if k >= count || stop.load(Ordering::Relaxed) {
                            return;
                        }
                        let (result, raised) = alone(Some(Arc::clone(stop)), false, || job(k));
                        match raised {
                            Some(raised) => note(raised, Some((k, result))),
                            None if send.send((k, result)).is_err() => return,
                            None => {}
                        }
                    }
                });
            }
            drop(send);
            let mut done: Vec<Option<R>> = (0..count).map(|_| None).collect();
            loop {
                match receive.recv_timeout(PATIENCE) {
                    Ok((k, result)) => done[k] = Some(result),
                    Err(RecvTimeoutError::Timeout) => {
                        if let Err(error) = signals() {
                            note(error, None);
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => break done,
                }
            }
        })
    });
    match ended.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(ended) => Err(ended),
        None => Ok(done.drain(..).flatten().collect()),
    }
}

/// Does one long job on a thread of its own, which is left behind when a signal comes: it then ends by itself soon.
pub fn aside<R: Send + 'static>(
    py: Python<'_>,
    job: impl FnOnce() -> R + Send + 'static,
) -> core::result::Result<R, PyErr> {
    let stop = Arc::new(AtomicBool::new(false));
    let (send, receive) = mpsc::channel();
    let told = Arc::clone(&stop);
    let spawned = thread::Builder::new().spawn(move || {
        // nobody listens after a signal
        let _ = send.send(alone(Some(told), false, job));
    });
    spawned.map_err(|error| Input::plain(format!("no thread could be started: {error}")))?;
    py.detach(move || {
        loop {
            match receive.recv_timeout(PATIENCE) {
                Ok((result, None)) => return Ok(result),
                Ok((_, Some(raised))) => return Err(raised),
                Err(RecvTimeoutError::Timeout) => {
                    if let Err(error) = signals() {
                        stop.store(true, Ordering::Relaxed);
                        return Err(error);
                    }
                }
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(Input::plain("the thread of the run has ended without an answer").into());
                }
            }
        }
    })
}
