//! What a front end of run time is promised, over the whole registry: filters stepped by hand, snapshots, factors, joint draws, batches.

mod batches;
mod by_hand;
mod factors;
mod samples;
mod snapshots;
