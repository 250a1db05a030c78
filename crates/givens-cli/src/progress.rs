//! Progress on stderr, of work that takes longer than a second.

use core::sync::atomic::{AtomicUsize, Ordering};
use core::time::Duration;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread::{Builder, scope};
use std::time::Instant;

/// A bar over the rows of all tracks. On anything but a terminal it is silent.
pub struct Progress {
    bar: ProgressBar,
}

/// How long nothing is shown, and how often the bar moves then.
const QUIET: Duration = Duration::from_secs(1);
const OFTEN: Duration = Duration::from_millis(200);

impl Progress {
    pub fn new(rows: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(rows as u64), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} rows, {eta} left") {
            bar.set_style(style);
        }
        Self { bar }
    }

    /// The same over files.
    pub fn of_files(files: usize) -> Self {
        let new = Self::new(files);
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} files, {eta} left")
        {
            new.bar.set_style(style);
        }
        new
    }

    /// Does work that counts its rows, and shows how many there are while it takes long.
    pub fn during<T>(&self, work: impl FnOnce(&AtomicUsize) -> T) -> T {
        let (bar, rows) = (&self.bar, &AtomicUsize::new(0));
        let (working, ended) = mpsc::channel::<()>();
        let show = move || {
            let mut wait = QUIET;
            // the end of the work closes the channel
            while ended.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                if bar.is_hidden() {
                    bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(5));
                }
                bar.set_position(rows.load(Ordering::Relaxed) as u64);
                wait = OFTEN;
            }
            bar.finish_and_clear();
        };
        scope(|scope| {
            // without a thread to spare nothing is shown
            let shown = Builder::new().spawn_scoped(scope, show);
            let done = work(rows);
            drop((working, shown));
            done
        })
    }
}

/// A bar over the runs of an experiment. On anything but a terminal it is silent.
pub struct Bar {
    bar: ProgressBar,
    since: Instant,
}

impl Bar {
    pub fn new(name: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::hidden());
        if let Ok(style) =
            ProgressStyle::with_template("{msg} {bar:40} {human_pos}/{human_len} runs, {eta} left")
        {
            bar.set_style(style);
        }
        bar.set_message(name.to_owned());
        Self { bar, since: Instant::now() }
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl givens_papers::Progress for Bar {
    fn expect(&self, units: usize) {
        self.bar.inc_length(units as u64);
    }

    fn done(&self) {
        self.bar.inc(1);
        if self.bar.is_hidden() && self.since.elapsed() > Duration::from_secs(1) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(5));
        }
    }
}
