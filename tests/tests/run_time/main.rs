//! What a front end of run time is promised, over the whole registry: filters stepped by hand, snapshots.

mod by_hand;
mod factors;
mod snapshots;
