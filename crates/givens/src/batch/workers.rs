//! Work shared out to threads.

use core::num::NonZeroUsize;
use core::sync::atomic::{AtomicUsize, Ordering};
use std::panic::resume_unwind;
use std::thread::{Builder, available_parallelism, scope};

/// `one` of each item, begun in their order, on so many threads (all cores where it is not said; fewer where the system gives
/// no more). The answers stand in the order of the items.
pub(crate) fn each<I: Sync, T: Send>(
    items: &[I],
    threads: Option<NonZeroUsize>,
    one: impl Fn(&I) -> T + Sync,
) -> Vec<T> {
    let cores = || available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let threads = threads.unwrap_or_else(cores).get().min(items.len());
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(k) else { return done };
            done.push((k, one(item)));
        }
    };
    let mut all = scope(|scope| {
        let others: Vec<_> =
            (1..threads).map_while(|_| Builder::new().spawn_scoped(scope, work).ok()).collect();
        let mut all = work();
        for other in others {
            // a panic can only be the caller's own: of a model
            all.extend(other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        all
    });
    all.sort_unstable_by_key(|&(k, _)| k);
    all.into_iter().map(|(_, answer)| answer).collect()
}
