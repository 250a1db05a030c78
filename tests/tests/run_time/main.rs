//! What a front end of run time is promised, over the whole registry: filters stepped by hand, snapshots, factors, joint draws, batches, packs, streams, the gate.

mod batches;
mod by_hand;
mod factors;
mod gate;
mod gate_limits;
mod packs;
mod samples;
mod single;
mod snapshots;
mod streams;
