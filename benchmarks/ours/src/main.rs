//! givens as a contestant: `givens-benchmarks CONTESTANT WORKLOAD INPUTS`, as `givens_contest` says.

mod batch;
mod models;
mod packs;
mod problem;
mod single;
mod smooth;
mod workloads;

use givens_contest::{Failure, called_with, serve};

/// This is what is measured: the version in the manifest; the runner adds the revision.
const VERSION: &str = concat!("givens ", env!("CARGO_PKG_VERSION"));

fn main() -> Result<(), Failure> {
    let (contestant, workload, inputs) = called_with()?;
    serve(workloads::offer(&contestant, &workload, &inputs)?)
}
