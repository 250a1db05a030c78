//! What may end a run before its time: an exception in a function of the user's, Ctrl-C, or another thread.
//!
//! A run stands on one thread, and what ends it is noted there. Whoever evaluates a model asks [`go_on`] first, and gives
//! not-a-number once it says no: the filter then stops at that step, and the run is thrown away.

use core::cell::{Cell, RefCell};
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::sync::Arc;
use std::time::Instant;

use pyo3::prelude::*;

/// Evaluations between two looks at the clock.
const OFTEN: u32 = 64;

/// Time between two looks at the signals.
pub const PATIENCE: Duration = Duration::from_millis(50);

#[derive(Default)]
struct Run {
    ended: Cell<bool>,
    evaluations: Cell<u32>,
    /// When signals were last looked at; none on a thread that does not.
    looked: Cell<Option<Instant>>,
    /// Tells a thread of several to stop.
    stop: RefCell<Option<Arc<AtomicBool>>>,
    raised: RefCell<Option<PyErr>>,
}

thread_local! {
    static RUN: Run = Run::default();
}

impl Run {
    /// Leaves what `other` held in this one, and the reverse.
    fn swap(&self, other: &Run) {
        self.ended.swap(&other.ended);
        self.evaluations.swap(&other.evaluations);
        self.looked.swap(&other.looked);
        self.stop.swap(&other.stop);
        self.raised.swap(&other.raised);
    }

    fn end(&self, error: Option<PyErr>) {
        self.ended.set(true);
        if let Some(error) = error {
            // the first is the cause of all others
            self.raised.borrow_mut().get_or_insert(error);
        }
    }

    fn look(&self) {
        if self.stop.borrow().as_ref().is_some_and(|stop| stop.load(Ordering::Relaxed)) {
            self.end(None);
        }
        let Some(last) = self.looked.get() else { return };
        if last.elapsed() >= PATIENCE {
            if let Err(error) = signals() {
                self.end(Some(error));
            }
            self.looked.set(Some(Instant::now()));
        }
    }
}

/// What a signal raises, if one has come.
#[expect(clippy::redundant_closure_for_method_calls)] // the method alone is not general enough
pub fn signals() -> PyResult<()> {
    Python::attach(|py| py.check_signals())
}

/// Whether the run on this thread goes on.
#[inline]
pub fn go_on() -> bool {
    RUN.with(|run| {
        let evaluations = run.evaluations.get().wrapping_add(1);
        run.evaluations.set(evaluations);
        if evaluations % OFTEN == 0 {
            run.look();
        }
        !run.ended.get()
    })
}

/// Ends the run on this thread by an exception.
pub fn raise(error: PyErr) {
    RUN.with(|run| run.end(Some(error)));
}

/// Ends at the first of `items` that comes when the run on this thread does not go on.
#[derive(Clone)]
pub struct Watched<I>(pub I);

impl<I: Iterator> Iterator for Watched<I> {
    type Item = I::Item;
    fn next(&mut self) -> Option<I::Item> {
        if go_on() { self.0.next() } else { None }
    }
}

/// Does `work` on this thread as a run of its own, which `stop` ends; the exception that did if one was.
pub fn alone<R>(
    stop: Option<Arc<AtomicBool>>,
    signals: bool,
    work: impl FnOnce() -> R,
) -> (R, Option<PyErr>) {
    let own = Run::default();
    own.looked.set(signals.then(Instant::now));
    own.stop.replace(stop);
    // a run may stand within another, in a function of the user's
    RUN.with(|run| run.swap(&own));
    let done = work();
    RUN.with(|run| run.swap(&own));
    (done, own.raised.take())
}

/// Does `work` on this thread without the interpreter, watching for signals; the exception that ended it if one did.
pub fn detached<R: Send>(py: Python<'_>, work: impl FnOnce() -> R + Send) -> (R, Option<PyErr>) {
    py.detach(|| alone(None, true, work))
}
