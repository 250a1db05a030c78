//! One filter over all trajectories, one after the other.

use givens_contest::{Entry, Failure, Rows, Table};

/// A peer's filter in motion.
pub trait Peer {
    /// Predicts by one step, and updates.
    fn step(&mut self, z: &[f64]) -> Result<(), Failure>;
    /// The mean and the variances, for the report.
    fn belief(&self) -> (Vec<f64>, Vec<f64>);
    /// A number of the belief, so that nothing is optimised away.
    fn first(&self) -> f64;
}

/// The contestant that `start` begins each trajectory of.
pub fn entry<P: Peer>(
    version: &str,
    start: impl Fn() -> P + 'static,
    rows: Table,
    steps: usize,
    every: usize,
) -> Result<Entry<'static>, Failure> {
    let mut told = Rows::every(every);
    for track in 0..rows.rows() / steps {
        let mut peer = start();
        for k in 0..steps {
            peer.step(rows.row(track * steps + k))?;
            let (mean, variances) = peer.belief();
            told.next(mean, |i| variances[i]);
        }
    }
    Ok(Entry {
        version: version.to_owned(),
        steps: rows.rows(),
        result: told.numbers,
        go: Box::new(move || {
            let mut last = 0.0;
            for track in 0..rows.rows() / steps {
                let mut peer = start();
                for k in 0..steps {
                    peer.step(rows.row(track * steps + k))?;
                }
                last = peer.first();
            }
            Ok(last)
        }),
    })
}
