//! The memory of a filter, of a length known before it starts.

use super::backward::accumulate_scratch;
use super::memory::larger;
use super::sizes::{Sizes, countable};
use super::update::update_scratch;
use crate::rule::Shape;

/// Where the arrays of a filter stand in its memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layout {
    pub sizes: Sizes,
    pub shape: Shape,
    /// Whether predictions leave what a smoother needs.
    pub smoothing: bool,
    /// Whether predictions leave a root of their own for the update.
    pub moved: bool,
    /// Scalars that predictions leave for the next one.
    pub kept: usize,
    /// All of the filter's scalars.
    pub len: usize,
}

impl Layout {
    /// That of any method, whose time update needs `predict` scalars of scratch.
    pub const fn new(sizes: Sizes, shape: Shape, smoothing: bool, predict: usize) -> Self {
        let Sizes { states: n, measures: d, measurement_noise: r, .. } = sizes;
        if !countable(sizes, shape) {
            return Self { sizes, shape, smoothing, moved: false, kept: 0, len: usize::MAX };
        }
        // mean, factor, covariance, the rounding in the factor, and what was known before an update; innovation (measured,
        // predicted, ν, factor, white, NIS, log-likelihood); gain and conditional root, twice where a gap of several steps
        // is chained, and what updates have learnt
        let belief = 4 * n + 2 * n * n;
        let innovation = 4 * d + d * d + 2;
        let back = if smoothing { 5 * n * n + n } else { 0 };
        let kept = shape.table + sizes.controls + sizes.parameters + belief + innovation + back;
        let predict = predict + if smoothing { accumulate_scratch(n) } else { 0 };
        let update = update_scratch(n, d, r, shape, sizes.model, smoothing);
        let work = larger(predict, update);
        Self { sizes, shape, smoothing, moved: false, kept: 0, len: kept + work }
    }

    /// The same with room for the root that a prediction leaves for the update.
    /// With so many scalars that predictions leave for the next one.
    pub const fn keeping(self, kept: usize) -> Self {
        Self { kept, len: self.len.saturating_add(kept), ..self }
    }

    pub const fn with_moved_root(self) -> Self {
        let moved = Self { moved: true, ..self };
        Self { len: self.len.saturating_add(moved.moved_len()), ..moved }
    }

    /// Scalars of that root.
    pub const fn moved_len(&self) -> usize {
        if self.moved { self.sizes.states * self.sizes.states } else { 0 }
    }
}
