//! givens as a contestant: `givens-benchmarks CONTESTANT WORKLOAD INPUTS`, as `givens_contest` says; with the feature `scaling`, also what `cargo xtask
//! bench --scaling` measures.

mod batch;
#[cfg(feature = "file")]
mod file;
mod kernels;
mod models;
mod packs;
mod problem;
#[cfg(feature = "scaling")]
mod scaling;
mod single;
mod smooth;
mod workloads;

use givens_contest::{Failure, called_with, counted_repetition, serve};

/// This is what is measured: the version in the manifest; the runner adds the revision.
const VERSION: &str = concat!("givens ", env!("CARGO_PKG_VERSION"));

fn main() -> Result<(), Failure> {
    let (contestant, workload, inputs) = called_with()?;
    #[cfg(feature = "scaling")]
    if let Some(wanted) = contestant.strip_prefix("scaling ") {
        return scaling::run(wanted, &inputs, std::path::Path::new(&workload));
    }
    // `cargo xtask instructions` asks for one repetition
    let (contestant, once) = match contestant.strip_prefix("count ") {
        Some(contestant) => (contestant.to_owned(), true),
        None => (contestant, false),
    };
    let mut entry = workloads::offer(&contestant, &workload, &inputs)?;
    if once {
        core::hint::black_box(counted_repetition(&mut entry)?);
        return Ok(());
    }
    serve(entry)
}
