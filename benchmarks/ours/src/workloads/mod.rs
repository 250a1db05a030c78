//! Who runs what.

mod circle;
pub mod plane;
pub mod space;

use crate::kernels;
use givens_contest::{Entry, Failure, Inputs};

/// What a contestant has for a workload.
pub fn offer(contestant: &str, workload: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    #[cfg(feature = "file")]
    if contestant.starts_with("file") {
        return crate::file::offer(contestant, workload, inputs);
    }
    match workload {
        "W1" => plane::one(contestant, inputs),
        "W2" => plane::many(contestant, inputs),
        "W3a" => space::moments(contestant, inputs),
        "W3b" => space::discrete(contestant, inputs),
        "W4" => plane::smoothed(contestant, inputs),
        "kernel" => kernels::offer(contestant),
        "P1" => space::ito_taylor(contestant, inputs),
        "P2" => space::updates(contestant, inputs),
        _ => match workload.strip_prefix("W5-") {
            Some(n) => circle::states(n, contestant, inputs),
            None => Err(format!("no workload `{workload}`").into()),
        },
    }
}

/// A contestant that a workload is not meant for.
pub fn unknown(contestant: &str) -> Result<Entry<'static>, Failure> {
    Err(format!("no contestant `{contestant}` for this workload").into())
}
