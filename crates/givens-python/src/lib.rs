//! The native half of the Python package `givens`; its Python half is `python/givens`.
// PyO3 hands arguments over by value
#![expect(clippy::needless_pass_by_value)]

mod graph;

use pyo3::prelude::*;

/// The native half of `givens`; import `givens` instead.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::graph::Graph;
}
