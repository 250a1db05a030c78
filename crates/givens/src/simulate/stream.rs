//! Random numbers.

use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// A stream of independent standard normal numbers, keyed by seed, track and run: the same for any partition of the
/// work, on one machine and instruction set.
#[derive(Clone, Debug)]
pub struct Stream(ChaCha12Rng);

impl Stream {
    /// The stream of one run of one track.
    ///
    /// ```
    /// use givens::simulate::Stream;
    /// let draw = |run| Stream::new(7, 0, run).normal();
    /// assert_eq!(draw(1), draw(1));
    /// assert_ne!(draw(1), draw(2));
    /// ```
    pub fn new(seed: u64, track: u32, run: u32) -> Self {
        let mut rng = ChaCha12Rng::seed_from_u64(seed);
        rng.set_stream(u64::from(track) << 32 | u64::from(run));
        Self(rng)
    }

    /// The same stream in a part of it that [`new`](Self::new) never comes to: states are drawn from it that must not share
    /// the noise of a simulation with the same key.
    pub(crate) fn beyond(seed: u64, track: u32, run: u32) -> Self {
        let mut stream = Self::new(seed, track, run);
        stream.0.set_word_pos(1 << 60);
        stream
    }

    /// The next number.
    pub fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }

    /// Adds B w to `x`, w standard normal, B `x.len()` rows of `columns`.
    pub(super) fn add_noise(&mut self, x: &mut [f64], root: &[f64], columns: usize, w: &mut [f64]) {
        w[..columns].fill_with(|| self.normal());
        for (x, row) in x.iter_mut().zip(root.chunks_exact(columns.max(1))) {
            *x += row.iter().zip(&*w).map(|(b, w)| b * w).sum::<f64>();
        }
    }
}
