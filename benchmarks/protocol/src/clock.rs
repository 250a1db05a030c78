//! Time that a thread has used, and time that has passed.

use rustix::time::{ClockId, clock_gettime};
use std::time::Instant;

/// Both clocks, from a moment on.
pub struct Stopwatch {
    thread: u64,
    wall: Instant,
}

fn thread_ns() -> u64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec.unsigned_abs() * 1_000_000_000 + now.tv_nsec.unsigned_abs()
}

impl Stopwatch {
    /// From now on.
    #[must_use]
    pub fn start() -> Self {
        let wall = Instant::now();
        Self { thread: thread_ns(), wall }
    }

    /// What this thread has used of the processor, and what has passed, in nanoseconds.
    #[must_use]
    pub fn nanoseconds(&self) -> (u64, u64) {
        let thread = thread_ns();
        (thread - self.thread, u64::try_from(self.wall.elapsed().as_nanos()).unwrap_or(u64::MAX))
    }
}
