//! Which rows of a run are reported.

/// Gathers means and variances of every `every`-th row.
pub struct Rows {
    every: usize,
    seen: usize,
    /// What has been gathered: for each reported row, means, then variances.
    pub numbers: Vec<f64>,
}

impl Rows {
    /// Nothing gathered yet.
    #[must_use]
    pub fn every(every: usize) -> Self {
        Self { every, seen: 0, numbers: Vec::new() }
    }

    /// The next row: its mean, and its variances, which are asked for only if it is reported.
    pub fn next(&mut self, mean: impl IntoIterator<Item = f64>, variance: impl FnMut(usize) -> f64) {
        self.seen += 1;
        if self.seen.is_multiple_of(self.every) {
            let before = self.numbers.len();
            self.numbers.extend(mean);
            let n = self.numbers.len() - before;
            self.numbers.extend((0..n).map(variance));
        }
    }
}
