//! Progress on stderr, of work that takes longer than a second.

use core::time::Duration;
use givens::Row;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::Instant;

/// A bar over the rows of all tracks. On anything but a terminal it is silent.
#[derive(Clone)]
pub struct Progress {
    bar: ProgressBar,
    since: Instant,
}

impl Progress {
    pub fn new(rows: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(rows as u64), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} rows, {eta} left") {
            bar.set_style(style);
        }
        Self { bar, since: Instant::now() }
    }

    fn tick(&self, rows: u64) {
        self.bar.inc(rows);
        if self.bar.is_hidden() && self.since.elapsed() > Duration::from_secs(1) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(5));
        }
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    /// The same rows, each of them counted when it is taken.
    pub fn counting<'a, I>(&self, rows: I) -> Counting<I>
    where
        I: Iterator<Item = Row<'a>> + Clone,
    {
        Counting { rows, taken: 0, progress: self.clone() }
    }
}

/// Rows that move the bar. Every so many rows: looking at the clock costs more than a row.
#[derive(Clone)]
pub struct Counting<I> {
    rows: I,
    taken: u64,
    progress: Progress,
}

const STRIDE: u64 = 1024;

impl<'a, I: Iterator<Item = Row<'a>> + Clone> Iterator for Counting<I> {
    type Item = Row<'a>;

    fn next(&mut self) -> Option<Row<'a>> {
        let row = self.rows.next();
        if row.is_some() {
            self.taken += 1;
            if self.taken.is_multiple_of(STRIDE) {
                self.progress.tick(STRIDE);
            }
        }
        row
    }

    /// Counting ahead is no progress.
    fn count(self) -> usize {
        self.rows.count()
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
