//! How often, from which seed, and who is told how far it is.

use rayon::prelude::*;

/// Is told how the work goes on.
pub trait Progress: Sync {
    /// So many more units of work are known of.
    fn expect(&self, units: usize);
    /// One of them is done.
    fn done(&self);
}

/// Tells nobody.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quiet;

impl Progress for Quiet {
    fn expect(&self, _: usize) {}
    fn done(&self) {}
}

/// A request for an experiment.
#[derive(Clone, Copy)]
pub struct Plan<'a> {
    /// Monte-Carlo runs of each setting; `None`: the paper's own number.
    pub runs: Option<usize>,
    /// Of all random numbers.
    pub seed: u64,
    /// Is told how far it is.
    pub progress: &'a dyn Progress,
}

impl Plan<'_> {
    /// The number of runs, where the paper made `own`.
    pub fn runs(&self, own: usize) -> usize {
        self.runs.unwrap_or(own)
    }

    /// `one(k)` for k = 0, 1, … `count` − 1, on all cores; the answers in order, whatever the number of threads.
    pub fn each<R: Send>(&self, count: usize, one: impl Fn(u32) -> R + Sync) -> Vec<R> {
        self.progress.expect(count);
        let run = |k: usize| {
            let answer = one(k as u32);
            self.progress.done();
            answer
        };
        (0..count).into_par_iter().map(run).collect()
    }
}
