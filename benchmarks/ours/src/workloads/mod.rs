//! Who runs what.

mod plane;

use crate::Offer;
use givens_contest::{Failure, Inputs};

/// What a contestant has for a workload.
pub fn offer(contestant: &str, workload: &str, inputs: &Inputs) -> Result<Offer, Failure> {
    match workload {
        "W1" => plane::one(contestant, inputs),
        "W2" => plane::many(contestant, inputs),
        _ => Err(format!("no workload `{workload}`").into()),
    }
}

/// The contestants of a workload that it is not meant for.
pub fn unknown(contestant: &str) -> Result<Offer, Failure> {
    Err(format!("no contestant `{contestant}` for this workload").into())
}
