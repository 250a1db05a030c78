//! Work shared out to threads.

use core::num::NonZeroUsize;
use core::sync::atomic::{AtomicUsize, Ordering};
use std::panic::resume_unwind;
use std::thread::{Builder, available_parallelism, scope};

/// `one(k)` for each k of `order`, which holds every number below its length once, on so many threads (all cores where it is
/// not said; fewer where the system gives no more). The answers stand at their k.
pub(super) fn each<T: Send>(
    order: &[usize],
    threads: Option<NonZeroUsize>,
    one: impl Fn(usize) -> Option<T> + Sync,
) -> Vec<Option<T>> {
    let cores = || available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let threads = threads.unwrap_or_else(cores).get().min(order.len());
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let Some(&k) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
            done.push((k, one(k)));
        }
        done
    };
    let mut all: Vec<Option<T>> = order.iter().map(|_| None).collect();
    scope(|scope| {
        let others: Vec<_> =
            (1..threads).map_while(|_| Builder::new().spawn_scoped(scope, work).ok()).collect();
        let own = work();
        // a panic can only be the caller's own: of a model
        let others =
            others.into_iter().map(|other| other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        for (k, answer) in core::iter::once(own).chain(others).flatten() {
            all[k] = answer;
        }
    });
    all
}
