//! givens as a contestant: `givens-benchmarks CONTESTANT WORKLOAD INPUTS`, as `givens_contest` says.

mod models;
mod packs;
mod problem;
mod single;
mod workloads;

use givens_contest::{Entry, Failure, called_with, lacks, serve};

/// What a contestant has for a workload.
enum Offer {
    Runs(Entry<'static>),
    Lacks(&'static str),
}

/// This is what is measured: the version in the manifest; the runner adds the revision.
const VERSION: &str = concat!("givens ", env!("CARGO_PKG_VERSION"));

fn main() -> Result<(), Failure> {
    let (contestant, workload, inputs) = called_with()?;
    match workloads::offer(&contestant, &workload, &inputs)? {
        Offer::Runs(entry) => serve(entry),
        Offer::Lacks(reason) => lacks(reason),
    }
}
