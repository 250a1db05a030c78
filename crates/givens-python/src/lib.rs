//! The native half of the Python package `givens`; its Python half is `python/givens`.
// PyO3 hands arguments over by value
#![expect(clippy::needless_pass_by_value)]

mod arrow;
mod choice;
mod crowd;
mod doubts;
mod errors;
mod estimates;
mod failure;
mod filter;
mod fleet;
mod graph;
mod listed;
mod memory;
mod metrics;
mod model;
mod numbers;
mod packs;
mod rows;
mod run;
mod sample;
mod simulate;
mod snapshot;
mod table;
mod watch;

use pyo3::prelude::*;

/// The native half of `givens`; import `givens` instead.
#[pymodule]
mod _native {
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    use crate::arrow::{ArrowTable, arrow_stream};
    #[pymodule_export]
    use crate::choice::{Choice, methods, options};
    #[pymodule_export]
    use crate::doubts::looked_for;
    #[pymodule_export]
    use crate::estimates::Estimates;
    #[pymodule_export]
    use crate::filter::Filter;
    #[pymodule_export]
    use crate::fleet::TrackTable;
    #[pymodule_export]
    use crate::graph::Graph;
    #[pymodule_export]
    use crate::metrics::{accuracy, consistency};
    #[pymodule_export]
    use crate::model::{Function, Model};
    #[pymodule_export]
    use crate::run::{run, run_batch};
    #[pymodule_export]
    use crate::sample::sample;
    #[pymodule_export]
    use crate::simulate::simulate;
    #[pymodule_export]
    use crate::table::read_tracks;
}
